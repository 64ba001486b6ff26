#include "dashpot/machine/plant_start.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/error.h"
#include "dashpot/numerics/filter.h"
#include "dashpot/numerics/linear_algebra.h"
#include "dashpot/numerics/spectrum.h"

namespace dashpot {
namespace {

double half_span(std::span<const double> samples) {
  const auto [low, high] = std::ranges::minmax(samples);
  return (high - low) / 2;
}

/// The frequency below which all but a thousandth of a signal's power lies.
double highest_of(std::span<const double> samples, double sample_time) {
  constexpr double kLeft = 1e-3;
  const PowerSpectrum spectrum = mean_power_spectrum(samples, sample_time);
  double total = 0, sum = 0;
  for (const double power : spectrum.power) total += power;
  for (std::size_t k = 0; k < spectrum.power.size(); ++k) {
    sum += spectrum.power[k];
    if (sum >= (1 - kLeft) * total) return spectrum.spacing_hz * static_cast<double>(k);
  }
  return 0.5 / sample_time;
}

/// Mass, damping and stiffness of an oscillator under a measured force whose displacement is
/// measured, damper and all: force = m a + c v + k x + a constant, by least squares over filtered
/// samples. Noise draws the mass down; a start needs no more.
std::vector<double> oscillator_regression(const PlantCase& one, std::size_t input,
                                          std::size_t sensor) {
  constexpr int kOrder = 4;
  constexpr double kAbove = 1.5, kBelowNyquist = 0.45;

  // The same low-pass on both sides leaves the equation as it is.
  const double dt = one.driving.sample_time;
  const std::size_t count = one.training, stride = one.driving.stride();
  const std::span<const double> shown(one.measured[sensor].data(), count);
  std::vector<double> pushed(count);
  for (std::size_t k = 0; k < count; ++k) pushed[k] = one.driving.value[input][k * stride];
  const double cutoff = std::min(kAbove * highest_of(shown, dt), kBelowNyquist / dt);
  const auto sections = butterworth_lowpass(kOrder, cutoff, dt);
  const std::vector<double> x = filter_zero_phase(sections, shown);
  const std::vector<double> u = filter_zero_phase(sections, pushed);

  // Normal equations of (m, c, k, constant).
  std::vector<double> normal(16), right(4), solution(4);
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const double row[] = {(x[k + 1] - 2 * x[k] + x[k - 1]) / (dt * dt),
                          (x[k + 1] - x[k - 1]) / (2 * dt), x[k], 1};
    for (std::size_t i = 0; i < 4; ++i) {
      right[i] += row[i] * u[k];
      for (std::size_t j = 0; j < 4; ++j) normal[4 * i + j] += row[i] * row[j];
    }
  }
  std::vector<double> size(4);
  for (std::size_t i = 0; i < 4; ++i) size[i] = std::sqrt(normal[5 * i]);
  for (std::size_t i = 0; i < 4; ++i) {
    right[i] /= size[i];
    for (std::size_t j = 0; j < 4; ++j) normal[4 * i + j] /= size[i] * size[j];
  }
  if (!solve_positive_definite(normal, right, solution)) return {};
  for (std::size_t i = 0; i < 4; ++i) solution[i] /= size[i];
  return solution;
}

/// An oscillator under a force tells its numbers by a regression; empty where it is none.
std::vector<double> regression_of(const InPlantSetup& setup, const PlantCases& cases) {
  std::vector<double> regression;
  if (setup.model->name == "oscillator" && setup.inputs.size() == 1 &&
      setup.inputs[0].place.kind == PlantInput::Force)
    for (std::size_t s = 0; s < setup.sensors.size() && regression.empty(); ++s)
      if (setup.sensors[s].place.quantity == PlantQuantity::Displacement)
        regression = oscillator_regression(cases.all.front(), 0, s);
  return regression;
}

/// The spring and dashpot that stands in for the damper at first.
DamperUnknowns spring_and_dashpot(const InPlantSetup& setup, const DataScale& scale, bool spring) {
  std::vector<ParameterChoice> choices;
  for (const ParamInfo& row : find_law("bouc_wen").params) {
    ParameterChoice choice{.law = {}, .parameter = std::string(row.name)};
    choice.form = Form::Constant;
    if (row.name == "alpha" || (row.name == "k0" && !spring)) choice.fixed = 0;
    if (row.name == "gamma" || row.name == "beta") choice.fixed = row.value;
    choices.push_back(choice);
  }
  return {{find_law("bouc_wen"), scale, DriveUnit::None, OffsetMode::Record, choices}, setup.kinds};
}

/// Twice the steps until half a step changes no sensor by more than a thousandth of what it shows.
void choose_steps(const InPlantSetup& setup, const std::vector<PlantRecording>& recordings,
                  PlantCases& cases, const PlantResiduals& residuals, const std::vector<double>& x,
                  int threads) {
  constexpr double kSmall = 1e-3;
  constexpr std::size_t kMost = 8;
  while (cases.steps < kMost) {
    std::vector<SensorFigures> figures;
    std::vector<InPlantTrace> traces;
    residuals.describe(x, figures, traces, threads);
    double share = 0;
    for (const SensorFigures& figure : figures)
      share = std::max(share, figure.training / figure.rms);
    if (std::isfinite(share) && residuals.step_error(x, recordings, threads) * share <= kSmall)
      return;
    cases = make_cases(setup, recordings, 2 * cases.steps);
  }
}

}  // namespace

std::vector<double> first_numbers(const InPlantSetup& setup, const std::vector<double>& regression,
                                  std::vector<std::string>& warnings) {
  std::vector<double> plant;
  const auto& rows = setup.model->parameters;
  for (const PlantUnknown& unknown : setup.unknown) {
    const std::size_t row = row_named(rows, unknown.name, setup.model->name, "plant");
    double value = rows[row].value;
    if (unknown.about) {
      value = *unknown.about;
    } else if (!regression.empty()) {
      value = regression[row];  // mass, damping, stiffness, in the order of the table
    } else if (unknown.lower > 0 && unknown.upper < rows[row].upper) {
      value = std::sqrt(unknown.lower * unknown.upper);
    } else {
      warnings.push_back(unknown.name + ": the search starts at the example value " +
                         format_number(value) + " " + std::string(rows[row].unit) +
                         "; 'about' says where it is expected");
    }
    plant.push_back(std::clamp(value, unknown.lower, unknown.upper));
  }
  return plant;
}

double usual_dashpot(const DrivenPlant& plant) {
  constexpr double kDampingRatio = 0.2;
  const double mass = plant.mass_along();
  return 2 * kDampingRatio * std::sqrt(std::max(plant.stiffness_along(), 1e-3 * mass) * mass);
}

PlantStart plant_start(const InPlantSetup& setup, const std::vector<PlantRecording>& recordings,
                       PlantCases& cases, const InPlantOptions& options) {
  constexpr double kTolerance = 1e-4;
  constexpr int kIterations = 50;
  PlantStart start;
  start.plant = first_numbers(setup, regression_of(setup, cases), start.warnings);

  DataScale& scale = start.scale;
  scale.drive = drive_range(cases);

  // A dashpot of a fifth of the critical damping says how large motion and force are.
  NamedValues values = setup.known;
  for (std::size_t k = 0; k < start.plant.size(); ++k)
    values.emplace_back(setup.unknown[k].name, start.plant[k]);
  std::vector<PlantInputPlace> inputs;
  for (const PlantInputChannel& input : setup.inputs) inputs.push_back(input.place);
  const DrivenPlant plant(make_plant(*setup.model, values), inputs);
  const double stiffness = plant.stiffness_along();
  scale.stroke = scale.speed = scale.force = 1;
  const double dashpot = usual_dashpot(plant);
  const auto measure = [&](const std::vector<InPlantTrace>& traces) {
    scale.stroke = scale.speed = scale.force = 0;
    for (const InPlantTrace& trace : traces)
      for (const DamperTrace& damper : trace.dampers) {
        scale.stroke = std::max(scale.stroke, half_span(damper.deflection));
        scale.speed = std::max(scale.speed, half_span(damper.velocity));
        scale.force = std::max(scale.force, half_span(damper.force));
      }
    return std::isfinite(scale.stroke) && scale.stroke > 0 && std::isfinite(scale.speed) &&
           scale.speed > 0;
  };
  scale.force = dashpot / 0.3;  // so that the start of c0 is that dashpot
  std::vector<SensorFigures> figures;
  std::vector<InPlantTrace> traces;
  {
    const DamperUnknowns law = spring_and_dashpot(setup, scale, false);
    const PlantResiduals residuals(setup, cases, law, start.plant, scale);
    residuals.describe(residuals.start(start.plant), figures, traces, options.threads);
    if (!measure(traces))
      throw Error("plant " + std::string(setup.model->name),
                  "does not move, or diverges, with its numbers at the start",
                  "say where they are expected: 'about'");
  }
  scale.force = std::max(scale.force, 1e-3 * dashpot * scale.speed);

  // Plant, spring and dashpot together; a spring only where the plant's own is known.
  const DamperUnknowns law = spring_and_dashpot(setup, scale, setup.unknown.empty());
  const PlantResiduals residuals(setup, cases, law, start.plant, scale);
  LeastSquaresOptions solver;
  solver.max_iterations = kIterations;
  solver.function_tolerance = kTolerance;
  solver.threads = options.threads;
  solver.on_iteration = [&options](int, double, std::span<const double>) {
    options.monitor.check();
  };
  const LeastSquaresReport solved =
      solve(residuals.problem(0, options.threads), residuals.start(start.plant), solver);
  if (std::isfinite(solved.cost)) {
    if (options.steps == 0)
      choose_steps(setup, recordings, cases, residuals, solved.x, options.threads);
    residuals.describe(solved.x, figures, traces, options.threads);
    const DataScale before = scale;
    if (!measure(traces)) scale = before;
    for (std::size_t k = 0; k < start.plant.size(); ++k)
      start.plant[k] = residuals.described(k, solved.x).value;
    start.states = residuals.states_of(solved.x);
  }

  // What a spring and a dashpot of the plant take up may be the damper's.
  if (!setup.unknown.empty()) scale.force = std::max(scale.force, 0.3 * stiffness * scale.stroke);
  scale.force = std::max(scale.force, 1e-3 * dashpot * scale.speed);
  return start;
}

}  // namespace dashpot
