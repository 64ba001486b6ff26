#include "dashpot/suspension/control/regulator.h"

#include "dashpot/numerics/linear_algebra.h"
#include "dashpot/suspension/control/damping_law.h"
#include "dashpot/suspension/plants/linear.h"

namespace dashpot {

// clang-format off: the texts are taken in
#include "dashpot/suspension/control/c_text/control_clipped_lqr.h"
#include "dashpot/suspension/control/c_text/control_clipped_optimal.h"
// clang-format on

extern const ControlLaw kClippedLqr, kClippedOptimal;

namespace {

/// An output y = c x + d u whose square has a weight in the cost.
struct Output {
  std::vector<double> c, d;
  double weight;
};

/// The sum over all rows i of factor_i times the row, of a matrix with so many columns.
std::vector<double> sum_of_rows(const std::vector<double>& factors, const double* rows,
                                std::size_t columns) {
  std::vector<double> sum(columns);
  for (const double factor : factors)
    for (double& value : sum) value += factor * *rows++;
  return sum;
}

/// matrix += weight a' b.
void add_product(std::vector<double>& matrix, double weight, const std::vector<double>& a,
                 const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) matrix[i * b.size() + j] += weight * a[i] * b[j];
}

struct RegulatorParameters {
  double deflection, tyre_deflection, force, top_acceleration;
};

/// Demand: its C text, (wanted force, limits, s). Without the plant's state the wanted force is 0.
template <const ControlLaw& kLaw, auto Demand>
class ClippedRegulator final : public Controller {
 public:
  ClippedRegulator(std::vector<double> gain, const ControlContext& context)
      : gain_(std::move(gain)), limits_(context.limits), states_(2 * context.plant.size()) {}
  void step(std::span<const StrutSignals> struts, std::span<const double> x, std::span<double>,
            std::span<DamperDemand> demands) const noexcept override {
    const int known = static_cast<int>(x.size());
    for (std::size_t k = 0; k < struts.size(); ++k)
      demands[k] =
          Demand(regulator_force(&gain_[k * states_], x.data(), known), &limits_, &struts[k]);
  }
  ControlDescription description() const override {
    return {.law = std::string(kLaw.name), .parameters = {}, .gain = gain_};
  }

 private:
  std::vector<double> gain_;
  ControlLimits limits_;
  std::size_t states_;
};

template <const ControlLaw& kLaw, auto Demand>
ControllerPointer make(std::span<const double> values, const ControlContext& context) {
  const auto p = values_as<RegulatorParameters>(values);
  return std::make_unique<ClippedRegulator<kLaw, Demand>>(
      regulator_of(context.plant, {p.deflection, p.tyre_deflection, p.force, p.top_acceleration}),
      context);
}

const std::vector<ParameterRow> kWeights{
    {"deflection", "1/s^4", 1e3, 0, 1e12,
     "weight of a strut's deflection squared, where that of body acceleration is 1"},
    {"tyre_deflection", "1/s^4", 1e4, 0, 1e12, "weight of a tyre's deflection squared"},
    {"force", "1/kg^2", 0, 0, 1e6,
     "weight of a damper's force squared; needed where forces move no body"},
    {"top_acceleration", "1", 0, 0, 1e12,
     "weight of the last coordinate's acceleration squared: a building's top floor"}};

}  // namespace

std::vector<double> regulator_of(const Plant& plant, const RegulatorWeights& weights) {
  // The plant as x' = a x + b u, with x = [q, q'] and u the forces up on the bodies.
  const LinearPlant linear = linear_plant(plant);
  const std::size_t n = plant.size(), states = 2 * n, m = plant.struts.size();
  const std::vector<double> inverse = dashpot::inverse(linear.mass, n),
                            by_q = product(inverse, linear.stiffness, n),
                            by_v = product(inverse, linear.damping, n);
  std::vector<double> a(states * states), b(states * m);
  for (std::size_t i = 0; i < n; ++i) {
    a[i * states + n + i] = 1;
    for (std::size_t j = 0; j < n; ++j) {
      a[(n + i) * states + j] = -by_q[i * n + j];
      a[(n + i) * states + n + j] = -by_v[i * n + j];
    }
  }
  for (std::size_t k = 0; k < m; ++k) {
    const std::vector<double> by_force = product(inverse, plant.struts[k].row, n);
    for (std::size_t i = 0; i < n; ++i) b[(n + i) * m + k] = by_force[i];
  }

  // The outputs y = c x + d u whose squares count, each with its weight.
  std::vector<Output> outputs;
  const auto of_heights = [&](const std::vector<double>& row, double weight) {
    Output output{row, std::vector<double>(m), weight};
    output.c.resize(states);
    outputs.push_back(std::move(output));
  };
  for (const Strut& strut : plant.struts) {
    outputs.push_back({sum_of_rows(strut.body_row, &a[n * states], states),
                       sum_of_rows(strut.body_row, &b[n * m], m), 1});
    of_heights(strut.row, weights.deflection);
  }
  for (const Tyre& tyre : plant.tyres) of_heights(tyre.row, weights.tyre_deflection);
  outputs.push_back(
      {{a.end() - states, a.end()}, {b.end() - m, b.end()}, weights.top_acceleration});

  // Their sum as x' q x + 2 x' cross u + u' r u, and the regulator for it.
  std::vector<double> q(states * states), cross(states * m), r(m * m);
  for (std::size_t k = 0; k < m; ++k) r[k * m + k] = weights.force;
  for (const Output& y : outputs) {
    add_product(q, y.weight, y.c, y.c);
    add_product(cross, y.weight, y.c, y.d);
    add_product(r, y.weight, y.d, y.d);
  }
  return regulator_gain(
      {states, m, std::move(a), std::move(b), std::move(q), std::move(cross), std::move(r)});
}

const ControlLaw kClippedLqr{.name = "clipped_lqr",
                             .title = "Clipped linear-quadratic regulator",
                             .equation =
                                 "F = K [q, q'], within c_min d ... c_max d;  K minimises the "
                                 "integral of z''^2 + weighted squares",
                             .source = "textbook; clipping as in semi-active practice",
                             .remarks = "Needs the whole state of the plant.",
                             .parameters = kWeights,
                             .needs_plant_state = true,
                             .make = make<kClippedLqr, clipped_lqr_demand>};
const ControlLaw kClippedOptimal{
    .name = "clipped_optimal",
    .title = "Clipped-optimal control",
    .equation = "i = i_max where (F_wanted - F) F > 0, else i_min;  F_wanted = K [q, q']",
    .source =
        "Dyke, Spencer, Sain and Carlson, Smart Mater. Struct. 5 (1996) 565; their regulator is an "
        "LQG on accelerations",
    .remarks = "Needs the measured force and the whole state. At a force of 0 it stays off.",
    .parameters = kWeights,
    .needs_plant_state = true,
    .make = make<kClippedOptimal, clipped_optimal_demand>};

}  // namespace dashpot
