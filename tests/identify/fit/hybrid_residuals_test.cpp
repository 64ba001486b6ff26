#include "dashpot/identify/fit/hybrid_residuals.h"

#include "dashpot/damper/registry.h"
#include "support.h"

using namespace dashpot;

namespace {

FreeRunRecord sine(double drive_swing) {
  FreeRunRecord record;
  for (int k = 0; k < 200; ++k) {
    const double t = 0.005 * k;
    record.time.push_back(t);
    record.inputs.push_back(
        {0.02 * std::sin(9 * t), 0.18 * std::cos(9 * t), 1 + drive_swing * std::sin(5 * t)});
    record.force.push_back(1500 * std::tanh(30 * record.inputs.back().velocity));
  }
  return record;
}

GatedNetwork network_of(const SignalRows& rows) {
  GatedNetwork network;
  network.signals.resize(rows.motions());
  network.signals.resize(rows.width, {.scale = 2});
  network.currents = rows.currents;
  network.initialise(2, 3);
  for (double& gate : network.gates) gate = 0.1;
  network.output_scale = 100;
  return network;
}

}  // namespace

TEST_CASE("the joint Jacobian is that of the residuals, by the law's unknowns and by the weights") {
  const std::vector<FreeRunRecord> records = {sine(0.5), sine(0.7)};
  const Law& law = find_law("modified_bouc_wen");
  DataScale scale{.force = 1500, .stroke = 0.02, .speed = 0.18};
  scale.drive = {.low = 0.3, .high = 1.7, .varies = true, .levels = 0};
  const LawUnknowns unknowns(law, scale, DriveUnit::Ampere, OffsetMode::Record);
  const HybridData data{unknowns, {{200}, {60}, {40}}, records, OffsetMode::Record};
  const HybridResiduals residuals(data, {{0, 20, 200}, {1, 50, 150}}, 3);
  CHECK(residuals.size() == 60 + 34);

  const SignalRows rows = residuals.signals(unknowns.start());
  const SignalMixing mixing = mixing_of(rows);
  const HybridResiduals::Network network{mixing, network_of(rows), 4};
  const LeastSquaresProblem problem = residuals.problem(network, unknowns.start(), 0, 1);
  std::vector<double> x = unknowns.start();
  x.insert(x.end(), network.start.neurons.begin(), network.start.neurons.end());
  x.insert(x.end(), network.start.gates.begin(), network.start.gates.end());
  REQUIRE(problem.lower.size() == x.size());
  REQUIRE(problem.residuals == residuals.size() + x.size());

  std::vector<double> here(problem.residuals), up(here), down(here),
      jacobian(here.size() * x.size());
  std::vector<double*> columns;
  for (std::size_t k = 0; k < x.size(); ++k) columns.push_back(&jacobian[k * here.size()]);
  REQUIRE(problem.jacobian(x, here, columns));
  for (std::size_t k = 0; k < x.size(); ++k) {
    CAPTURE(k);
    const double step = 1e-5 * std::max(1.0, std::abs(x[k]));
    std::vector<double> moved = x;
    moved[k] = x[k] + step;
    REQUIRE(problem.residual(moved, up));
    moved[k] = x[k] - step;
    REQUIRE(problem.residual(moved, down));
    double worst = 0, size = 0;
    for (std::size_t r = 0; r < here.size(); ++r) {
      const double slope = (up[r] - down[r]) / (2 * step);
      worst = std::max(worst, std::abs(columns[k][r] - slope));
      size = std::max(size, std::abs(slope));
    }
    CHECK(worst <= 1e-3 * size + 1e-6);  // the law's slopes are one-sided differences
  }
}

TEST_CASE(
    "mixed signals have mean 0, deviation 1 and nothing in common; what tells nothing new is "
    "silent") {
  SignalRows rows{4, 1, 2, {}};
  for (int k = 0; k < 100; ++k) {
    const double a = std::sin(0.3 * k), b = std::cos(0.7 * k);
    rows.values.insert(rows.values.end(), {5 + a, 3 * a + 0.01 * b, 2 * a - 7, 1.5});
  }
  const SignalMixing mixing = mixing_of(rows);
  double mean[3] = {}, products[3][3] = {};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    double mixed[3];
    mixing.apply(rows.row(k), mixed);
    for (int i = 0; i < 3; ++i) {
      mean[i] += mixed[i] / 100;
      for (int j = 0; j < 3; ++j) products[i][j] += mixed[i] * mixed[j] / 100;
    }
  }
  for (int i = 0; i < 3; ++i) {
    CHECK_CLOSE(mean[i], 0, 0, 1e-10);
    for (int j = 0; j < 3; ++j) CHECK_CLOSE(products[i][j], i == j && i < 2, 0, 1e-8);
  }
}
