#include "dashpot/suspension/dampers/law_loop.h"

#include <algorithm>
#include <array>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/laws/large_scale_bouc_wen.h"
#include "dashpot/damper/laws/modified_bouc_wen.h"
#include "dashpot/damper/laws/viscous_dahl.h"

namespace dashpot {
namespace {

template <class P>
LoopShape<double> shape_of(const P& p) {
  const double z_max = bouc_wen_z_max(p.A, p.gamma, p.beta, p.n);
  return {z_max, p.A / z_max, p.gamma / (p.gamma + p.beta), p.n};
}
LoopShape<double> shape_of(const NormalisedBoucWen& p) { return {1, p.rho, p.sigma, p.n}; }

// Dahl's w' = rho (v - |v| w) is a normalised Bouc-Wen's with n = 1 and sigma = 1.
LoopShape<double> shape_of(const Dahl& p) { return {1, p.rho, 1, 1}; }
LoopShape<double> shape_of(const ViscousDahl& p) { return {1, p.rho, 1, 1}; }

/// The loop of a law with parameters P, in table order.
template <class P>
LoopShape<double> shape_from(const double* parameters) {
  return shape_of(detail::from_array<P>(parameters));
}

/// A law with a loop: where its state z stands, and which parameters give the loop its shape.
struct KnownLoop {
  std::string_view law;
  std::size_t state;
  bool in_series;
  std::array<std::string_view, 4> shaped_by;
  LoopShape<double> (*shape)(const double* parameters);
};

constexpr KnownLoop kLoops[] = {
    {"bouc_wen", 0, false, {"A", "gamma", "beta", "n"}, shape_from<BoucWen>},
    {"dahl", 0, false, {"rho"}, shape_from<Dahl>},
    {"large_scale_bouc_wen", 0, false, {"A", "gamma", "beta", "n"}, shape_from<LargeScaleBoucWen>},
    {"modified_bouc_wen", 1, true, {"A", "gamma", "beta", "n"}, shape_from<ModifiedBoucWen>},
    {"normalised_bouc_wen", 0, false, {"rho", "sigma", "n"}, shape_from<NormalisedBoucWen>},
    {"viscous_dahl", 0, false, {"rho"}, shape_from<ViscousDahl>},
};

bool follows_current(const Dependence& parameters, std::size_t k) {
  const std::vector<double>& c = parameters.coefficients[k];
  if (parameters.forms[k] == Form::Exponential) return c[0] != c[1] && c[2] != 0;
  return std::any_of(c.begin() + 1, c.end(), [](double coefficient) { return coefficient != 0; });
}

}  // namespace

std::optional<LawLoop> loop_of(const DamperModel& model) {
  const auto* law = model_as<LawModel>(model);
  if (!law || law->law().text) return {};
  const auto* loop = std::ranges::find(kLoops, law->law().name, &KnownLoop::law);
  if (loop == std::end(kLoops)) return {};

  const auto& rows = law->law().params;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (std::ranges::count(loop->shaped_by, rows[k].name) && follows_current(law->parameters(), k))
      return {};

  std::array<double, kMaxParams> parameters;
  law->parameters_at(0, parameters.data());
  return LawLoop{loop->state, loop->in_series, loop->shape(parameters.data())};
}

}  // namespace dashpot
