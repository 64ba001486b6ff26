#include "dashpot/suspension/control/regulator.h"

#include <Eigen/Dense>

#include "dashpot/numerics/riccati.h"
#include "dashpot/suspension/control/damping_law.h"
#include "dashpot/suspension/plants/linear.h"

namespace dashpot {

// clang-format off: the texts are taken in
#include "dashpot/suspension/control/c_text/control_clipped_lqr.h"
#include "dashpot/suspension/control/c_text/control_clipped_optimal.h"
// clang-format on

extern const ControlLaw kClippedLqr, kClippedOptimal;

namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Matrix matrix_of(const std::vector<double>& values, Eigen::Index n) {
  return Eigen::Map<const Matrix>(values.data(), n, n);
}
Eigen::RowVectorXd row_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::RowVectorXd>(values.data(),
                                              static_cast<Eigen::Index>(values.size()));
}
std::vector<double> values_of(const Matrix& matrix) {
  return {matrix.data(), matrix.data() + matrix.size()};
}

/// An output y = c x + d u whose square has a weight in the cost.
struct Output {
  Eigen::RowVectorXd c, d;
  double weight;
};

struct Parameters {
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
  const auto p = values_as<Parameters>(values);
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
  const auto n = static_cast<Eigen::Index>(plant.size()),
             m = static_cast<Eigen::Index>(plant.struts.size());
  const Matrix inverse = matrix_of(linear.mass, n).inverse();
  Matrix a = Matrix::Zero(2 * n, 2 * n), b = Matrix::Zero(2 * n, m);
  a.topRightCorner(n, n).setIdentity();
  a.bottomLeftCorner(n, n) = -inverse * matrix_of(linear.stiffness, n);
  a.bottomRightCorner(n, n) = -inverse * matrix_of(linear.damping, n);
  for (Eigen::Index k = 0; k < m; ++k)
    b.col(k).tail(n) = inverse * row_of(plant.struts[static_cast<std::size_t>(k)].row).transpose();

  // The outputs y = c x + d u whose squares count, each with its weight.
  std::vector<Output> outputs;
  const auto of_heights = [&](const std::vector<double>& row, double weight) {
    Output output{Eigen::RowVectorXd::Zero(2 * n), Eigen::RowVectorXd::Zero(m), weight};
    output.c.head(n) = row_of(row);
    outputs.push_back(output);
  };
  for (const Strut& strut : plant.struts) {
    outputs.push_back(
        {row_of(strut.body_row) * a.bottomRows(n), row_of(strut.body_row) * b.bottomRows(n), 1});
    of_heights(strut.row, weights.deflection);
  }
  for (const Tyre& tyre : plant.tyres) of_heights(tyre.row, weights.tyre_deflection);
  outputs.push_back({a.row(2 * n - 1), b.row(2 * n - 1), weights.top_acceleration});

  // Their sum as x' q x + 2 x' cross u + u' r u, and the regulator for it.
  Matrix q = Matrix::Zero(2 * n, 2 * n), cross = Matrix::Zero(2 * n, m),
         r = weights.force * Matrix::Identity(m, m);
  for (const Output& y : outputs) {
    q += y.weight * y.c.transpose() * y.c;
    cross += y.weight * y.c.transpose() * y.d;
    r += y.weight * y.d.transpose() * y.d;
  }
  return regulator_gain({static_cast<std::size_t>(2 * n), plant.struts.size(), values_of(a),
                         values_of(b), values_of(q), values_of(cross), values_of(r)});
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
        "LQG on "
        "accelerations",
    .remarks = "Needs the measured force and the whole state. At a force of 0 it stays off.",
    .parameters = kWeights,
    .needs_plant_state = true,
    .make = make<kClippedOptimal, clipped_optimal_demand>};

}  // namespace dashpot
