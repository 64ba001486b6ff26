#include "dashpot/suspension/dampers/law_loop.h"

#include <array>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/laws/large_scale_bouc_wen.h"
#include "dashpot/damper/laws/modified_bouc_wen.h"

namespace dashpot {
namespace {

LoopShape<double> bouc_wen_shape(double A, double gamma, double beta, double n) {
  const double z_max = bouc_wen_z_max(A, gamma, beta, n);
  return {z_max, A / z_max, gamma / (gamma + beta), n};
}
template <class P>
LoopShape<double> shape_of(const P& p) {
  return bouc_wen_shape(p.A, p.gamma, p.beta, p.n);
}
LoopShape<double> shape_of(const NormalisedBoucWen& p) { return {1, p.rho, p.sigma, p.n}; }

/// The loop of a law with parameters P, whose state z is number `state`.
template <class P>
LawLoop loop_with(const double* parameters, std::size_t state, bool in_series = false) {
  return {state, in_series, shape_of(detail::from_array<P>(parameters))};
}

/// The laws that have one, by name; `p` at some current.
std::optional<LawLoop> loop_at(std::string_view law, const double* p) {
  if (law == "bouc_wen") return loop_with<BoucWen>(p, 0);
  if (law == "large_scale_bouc_wen") return loop_with<LargeScaleBoucWen>(p, 0);
  if (law == "modified_bouc_wen") return loop_with<ModifiedBoucWen>(p, 1, true);
  if (law == "normalised_bouc_wen") return loop_with<NormalisedBoucWen>(p, 0);
  return {};
}

}  // namespace

std::optional<LawLoop> loop_of(const DamperModel& model) {
  const auto* law = model_as<LawModel>(model);
  if (!law || law->law().text) return {};

  // At a few currents: a shape that changes between them is none.
  std::optional<LawLoop> loop;
  for (const double current : {0.0, 0.37, 1.0}) {
    std::array<double, kMaxParams> p;
    law->parameters_at(current, p.data());
    const auto here = loop_at(law->law().name, p.data());
    if (!here) return {};
    if (loop && (here->shape.z_max != loop->shape.z_max || here->shape.rate != loop->shape.rate ||
                 here->shape.sigma != loop->shape.sigma || here->shape.n != loop->shape.n))
      return {};
    loop = here;
  }
  return loop;
}

}  // namespace dashpot
