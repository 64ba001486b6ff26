#include "dashpot/machine/model_in_plant.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/passive_network/presets.h"
#include "dashpot/damper/registry.h"
#include "dashpot/error.h"
#include "dashpot/identify.h"
#include "dashpot/identify/fit/passive_network_fit.h"
#include "dashpot/machine/bench_start.h"
#include "dashpot/machine/beside_noise.h"
#include "dashpot/machine/found_noise.h"
#include "dashpot/machine/in_plant.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/observe.h"
#include "dashpot/machine/plant_fit_store.h"
#include "dashpot/machine/plant_residuals.h"
#include "dashpot/machine/recording_parts.h"

namespace dashpot {
namespace {

double half_width(std::span<const double> samples) {
  const auto [low, high] = std::ranges::minmax(samples);
  return (high - low) / 2;
}

/// How large the dampers' motion and force are.
DataScale scale_of(const std::vector<InPlantTrace>& traces) {
  DataScale scale{.force = 0, .stroke = 0, .speed = 0, .drive = {INFINITY, -INFINITY, false, 1}};
  for (const InPlantTrace& trace : traces)
    for (const DamperTrace& damper : trace.dampers) {
      scale.force = std::max(scale.force, half_width(damper.force));
      scale.stroke = std::max(scale.stroke, half_width(damper.deflection));
      scale.speed = std::max(scale.speed, half_width(damper.velocity));
      const auto [low, high] = std::ranges::minmax(damper.current);
      scale.drive.varies |= high > low;
      scale.drive.low = std::min(scale.drive.low, low);
      scale.drive.high = std::max(scale.drive.high, high);
    }
  return scale;
}

/// The setup with the noise of sensors and inputs that the law's fit has found, so that each round
/// weighs the sensors alike.
InPlantSetup with_noise_found(InPlantSetup setup, const InPlantReport& law) {
  const auto found = [&](const std::string& channel) {
    const auto place =
        std::ranges::find(law.nuisances, "noise of " + channel, &FittedParameter::name);
    return place == law.nuisances.end() ? 0.0 : place->value;
  };
  for (PlantInputChannel& input : setup.inputs)
    if (input.noise == 0) input.noise = found(input.channel);

  // What the law leaves at a sensor, where its noise was not looked for.
  for (PlantSensor& sensor : setup.sensors) {
    if (sensor.noise == 0) sensor.noise = found(sensor.channel);
    double squares = 0, count = 0;
    for (const SensorFigures& figure : law.sensors)
      if (figure.channel == sensor.channel) {
        squares += figure.training * figure.training;
        count += 1;
      }
    if (sensor.noise == 0) sensor.noise = std::sqrt(squares / count);
  }
  return setup;
}

/// The setup with the delays and cut-offs of sensors that the law's fit has found, asked for or
/// not, where the search for them starts.
InPlantSetup with_lags_found(InPlantSetup setup, const InPlantReport& law) {
  for (PlantSensor& sensor : setup.sensors) {
    const FoundLags found = lags_found(law.nuisances, sensor.channel);
    if (found.delay) sensor.finds_delay = true;
    if (found.cutoff && !sensor.finds_cutoff) sensor.finds_cutoff = CutoffRange{};
    take_found(found, sensor);
  }
  return setup;
}

/// The mean square of what is left at the sensors over their noise, on the time that is fitted.
double left_over(const std::vector<SensorFigures>& figures, const InPlantSetup& setup) {
  double sum = 0;
  for (std::size_t k = 0; k < figures.size(); ++k) {
    const double noise = setup.sensors[k % setup.sensors.size()].noise;
    sum += std::pow(figures[k].training / noise, 2) / static_cast<double>(figures.size());
  }
  return std::isfinite(sum) ? sum : static_cast<double>(INFINITY);
}

/// Where a law's fit has found the plant at the beginning of each recording: coordinates, then
/// velocities; empty where it begins at rest.
std::vector<double> beginnings(const InPlantReport& law, const InPlantSetup& setup) {
  const std::size_t of_plant = 2 * make_plant(*setup.model, setup.known).size();
  std::vector<double> states;
  for (const InPlantTrace& trace : law.traces) {
    std::size_t own = 0;
    for (const FittedParameter& p : law.nuisances)
      if (p.meaning == "at the beginning of " + trace.recording && own++ < of_plant)
        states.push_back(p.value);
  }
  return states;
}

/// What is known of plant and damper after some round, and what the sensors tell along it.
struct Round {
  InPlantSetup known;          ///< the plant with all its numbers
  std::vector<double> plant;   ///< its unknown ones, SI
  std::vector<double> states;  ///< at the beginnings
  InPlantReport report;
  double left = INFINITY;
};

/// Those of the dampers of a kind, of the records of one damper of the plant after the other.
std::vector<Record> records_of(std::size_t kind, const InPlantSetup& setup,
                               const std::vector<Record>& all) {
  std::vector<Record> own;
  for (std::size_t r = 0; r < all.size(); ++r)
    if (setup.kinds.at(r % setup.dampers()) == kind) own.push_back(all[r]);
  return own;
}

/// The model as its own trainer finds it from what the sensors tell of dampers that are alike.
FitReport learnt_from(const std::vector<Record>& records, const std::string& model,
                      const InPlantSetup& setup, const InPlantOptions& options) {
  IdentifyOptions trainer{.allow_active = true,
                          .network = options.network,
                          .seed = options.seed,
                          .threads = options.threads,
                          .monitor = {.on_progress = {}, .stop = options.monitor.stop}};
  if (law_inside(model)) trainer.choices = options.choices;

  // A passive network is told that the plant's motions are all that it will see.
  if (model_info(model).kind == ModelKind::PassiveNetwork)
    return fit_to_these_motions(find_preset(passive_network_presets(), model), records,
                                setup.drive_unit, trainer);
  return identify(model, records, setup.drive_unit, trainer);
}

/// Where the plant is at the beginnings, with the model held, and its unknown numbers. These stay
/// as the law's fit has found them where that went on beside the noise of the inputs, which would
/// draw them aside here.
LeastSquaresReport plant_anew(const InPlantSetup& setup, const InPlantOptions& options,
                              const PlantResiduals& residuals, const Round& before) {
  constexpr int kIterations = 15;
  LeastSquaresOptions solver;
  solver.max_iterations = kIterations;
  solver.function_tolerance = 1e-4;
  solver.threads = options.threads;
  solver.on_iteration = [&options](int, double, std::span<const double>) {
    options.monitor.check();
  };
  LeastSquaresProblem problem = residuals.problem(0, options.threads);
  const std::vector<double> x = residuals.start(before.plant, before.states);
  if (has_noisy_inputs(setup))
    for (std::size_t k = 0; k < before.plant.size(); ++k)
      problem.lower[k] = problem.upper[k] = x[k];
  return solve(problem, x, solver);
}

/// Plant and sensors with these dampers, one of each kind, fitted anew; no model in the report
/// where they diverge.
Round with_dampers(const std::vector<std::shared_ptr<const DamperModel>>& dampers,
                   const Round& before, const InPlantSetup& setup,
                   const std::vector<PlantRecording>& recordings, const DataScale& scale,
                   const PlantCases& cases, const InPlantOptions& options) {
  Round now;
  const PlantResiduals residuals(setup, cases, dampers, before.plant, scale);
  const LeastSquaresReport solved = plant_anew(setup, options, residuals, before);
  if (!std::isfinite(solved.cost)) {
    now.report.message = "the plant diverges with what was learnt: " + solved.message;
    return now;
  }

  // How well it goes, and what was found.
  InPlantReport& report = now.report;
  residuals.describe(solved.x, report.sensors, report.traces, options.threads);
  now.left = left_over(report.sensors, setup);
  report.step_error = residuals.step_error(solved.x, recordings, options.threads);
  report.iterations = solved.iterations;
  report.kinds = before.report.kinds;
  for (std::size_t kind = 0; kind < dampers.size(); ++kind)
    report.kinds[kind].model = dampers[kind];
  now.known = residuals.setup_at(solved.x);
  now.states = residuals.states_of(solved.x);
  for (std::size_t k = 0; k < solved.x.size(); ++k) {
    FittedParameter p = residuals.described(k, solved.x);
    p.low = p.high = std::numeric_limits<double>::quiet_NaN();
    if (const SensorUnknown* one = residuals.of_sensor(k)) tell(*one, p);
    if (k < before.plant.size()) now.plant.push_back(p.value);
    (k < before.plant.size() ? report.plant : report.nuisances).push_back(std::move(p));
  }
  return now;
}

/// A model of each kind of damper; none, and why.
struct Learnt {
  std::vector<std::shared_ptr<const DamperModel>> of_kinds;
  std::string message;
};

/// The model as it learns each kind of damper from these records, those of one damper of the plant
/// after the other.
Learnt learnt_of_kinds(const std::vector<FoundDamper>& kinds, const std::vector<Record>& records,
                       const std::string& model, const InPlantSetup& setup,
                       const InPlantOptions& options) {
  Learnt learnt;
  for (const FoundDamper& kind : kinds) {
    FitReport fit =
        learnt_from(records_of(learnt.of_kinds.size(), setup, records), model, setup, options);
    if (!fit.model) return {{}, std::move(fit.message)};
    if (fit.model->state_size() > kMostDamperStates)
      return {{},
              "has " + std::to_string(fit.model->state_size()) + " states, and a plant takes " +
                  std::to_string(kMostDamperStates)};
    learnt.of_kinds.push_back(
        mounted(fit.model, 0.5 * (kind.domain.current_min + kind.domain.current_max)));
  }
  return learnt;
}

/// A round: what the sensors tell along the one before, the models that learn from it, the plant
/// anew.
Round next_round(const Round& before, const std::string& model, const InPlantSetup& setup,
                 const std::vector<PlantRecording>& recordings, const DataScale& scale,
                 const PlantCases& cases, const InPlantOptions& options) {
  const std::vector<PlantRecording> fitted = fitted_parts(setup, recordings);
  const std::vector<Record> records = as_bench_records(
      setup, fitted, observe_beside_force(before.known, fitted, before.report.traces, options));
  Learnt learnt = learnt_of_kinds(before.report.kinds, records, model, setup, options);
  if (!learnt.of_kinds.empty())
    return with_dampers(learnt.of_kinds, before, setup, recordings, scale, cases, options);
  Round none;
  none.report.message = std::move(learnt.message);
  return none;
}

/// What speaks against the result, in words.
void add_doubts(InPlantReport& report, bool is_behind) {
  constexpr double kStepShare = 0.2;
  if (report.has_models() && is_behind)
    report.warnings.push_back("leaves more at the sensors than " + report.along +
                              ", along which it learnt: take that");
  if (report.has_models() && report.step_error > kStepShare)
    report.warnings.push_back("half the integrator's step changes a sensor by " +
                              format_number(100 * report.step_error, 2) + " % of its error");
  for (const FittedParameter& p : report.plant)
    if (p.at_bound)
      report.warnings.push_back(p.name + " = " + format_number(p.value) + " " + p.unit +
                                " stands at a bound of its range");
  for (const SensorFigures& figure : report.sensors)
    if (std::isinf(figure.held_back))
      report.warnings.push_back(figure.recording + ": the plant diverges on the time held back (" +
                                figure.channel + ")");
}

/// A model that is no law, along a law that was identified in the plant before.
InPlantReport identify_along(const std::string& model, const InPlantFit& law,
                             const InPlantSetup& stated,
                             const std::vector<PlantRecording>& recordings,
                             const InPlantOptions& options) {
  constexpr std::size_t kSteps = 4;  // of the integrator per sample
  constexpr double kBetter = 0.98;   // of what the round before left
  const double started = cpu_seconds();
  const InPlantSetup setup = with_lags_found(with_noise_found(stated, law.report), law.report);
  const DataScale scale = scale_of(law.report.traces);
  Round best;
  best.known = as_found(setup, law.report);
  for (const FittedParameter& p : law.report.plant) best.plant.push_back(p.value);
  best.states = beginnings(law.report, setup);
  best.report = law.report;
  const double left_by_law = left_over(law.report.sensors, setup);

  // Round after round, while each leaves clearly less of the time that is fitted.
  const PlantCases cases = make_cases(setup, recordings, options.steps > 0 ? options.steps : kSteps,
                                      PlantMethod::StraightForce);
  const int rounds = has_noisy_inputs(setup) ? 1 : 3;  // where the plant stays, one tells all
  int iterations = 0;
  for (int round = 0; round < rounds; ++round) {
    options.monitor.report("round " + std::to_string(round + 1),
                           static_cast<double>(round) / rounds);
    Round now = next_round(best, model, setup, recordings, scale, cases, options);
    iterations += now.report.iterations;
    const bool is_better = now.report.has_models() && now.left < kBetter * best.left;
    if (round == 0 || (now.report.has_models() && now.left < best.left)) best = std::move(now);
    if (!is_better) break;
  }

  // What came of it.
  InPlantReport report = std::move(best.report);
  report.along = law.model;
  report.noise = law.report.noise;
  if (report.has_models()) report.status = FitReport::Status::Converged;
  report.iterations = iterations;
  report.steps = cases.steps;
  report.method = cases.method;
  add_doubts(report, best.left > left_by_law);
  report.seconds = cpu_seconds() - started;
  return report;
}

/// The options of one of several models, whose progress is told as a part of the whole.
InPlantOptions told_of(const std::string& model, std::size_t before, std::size_t count,
                       InPlantOptions options) {
  if (!options.monitor.on_progress) return options;
  options.monitor.on_progress = [=, whole = options.monitor.on_progress](const Progress& own) {
    const double done = static_cast<double>(before) + own.fraction;
    whole({model + ", " + own.stage, std::min(1.0, done / static_cast<double>(count))});
  };
  return options;
}

}  // namespace

std::vector<std::string> usual_in_plant() {
  return {"tanh_guo", "tanh_kwok", "hysteretic_biviscous", "bouc_wen", "modified_bouc_wen"};
}

void require_model_for_plant(const std::string& model, const InPlantSetup& setup,
                             const std::string& where) {
  if (is_law(model)) return;
  const ModelKind kind = model_info(model, where).kind;
  if (kind == ModelKind::Mean)
    throw Error(where, "'" + model + "' is made of models that were fitted to a measured force",
                "a law or a network, as tanh_kwok or passive_network");
  if (kind == ModelKind::Family)
    throw Error(where, "'" + model + "' is a model of many dampers that differ by their drawings",
                "a law or a network, as tanh_kwok or passive_network; 'dashpot models' lists them");
  if (unmeasured_road(setup))
    throw Error(where,
                "'" + model +
                    "' is no law, and laws alone are identified on a road that nothing "
                    "measures",
                "a channel with the road's height, or a law, as tanh_kwok");
  require_no_follower(setup, "what makes a bench of the plant, as '" + model + "' needs,");
}

std::vector<InPlantFit> identify_in_plant(const std::vector<std::string>& models,
                                          const InPlantSetup& setup,
                                          const std::vector<PlantRecording>& as_recorded,
                                          const InPlantOptions& options, PlantFitStore* store) {
  require_setup(setup);
  for (const std::string& model : models) require_model_for_plant(model, setup, "models");
  const std::vector<PlantRecording> recordings = moving_parts(setup, as_recorded);
  std::vector<InPlantFit> fits;

  // A fit that was kept, or a new one; of dampers that are not alike once one law has found that.
  InPlantSetup as_taken = setup;
  const auto add_fit = [&](const std::string& model, const std::string& along, auto&& make) {
    const PlantFitStore::Request request{model, along, as_taken, recordings, options};
    InPlantFit fit{.model = model, .report = {}};
    if (std::optional<InPlantReport> kept = store ? store->load(request) : std::nullopt) {
      fit.report = std::move(*kept);
      fit.was_kept = true;
    } else {
      fit.report = make(told_of(model, fits.size(), models.size(), options));
      if (store) store->save(request, fit.report);
    }
    fits.push_back(std::move(fit));
  };
  const auto fit_law = [&](const std::string& law) {
    add_fit(law, "", [&](const InPlantOptions& own) {
      InPlantReport report = identify_in_plant(find_law(law), as_taken, recordings, own);
      report.noise = found_noise(setup, report);
      if (as_taken.kinds.size() > setup.kinds.size())
        report.warnings.push_back(unlike_found(as_taken));
      return report;
    });
    if (fits.back().report.kinds.size() > as_taken.kinds.size())
      as_taken = *with_unlike_dampers(as_taken);
  };

  // Laws first, one at least.
  for (const std::string& model : models)
    if (is_law(model)) fit_law(model);
  if (fits.size() == models.size()) return fits;
  if (fits.empty()) {
    fit_law(kLawBeforeModels);
    fits.back().was_asked_for = false;
  }

  // The others along the best of them, by the time that was fitted.
  const InPlantSetup weighed = with_noise_found(setup, fits.front().report);
  const auto left_by = [&](const InPlantFit& fit) {
    return fit.report.has_models() ? left_over(fit.report.sensors, weighed)
                                   : static_cast<double>(INFINITY);
  };
  const InPlantFit law = *std::ranges::min_element(fits, {}, left_by);
  as_taken = law.report.kinds.size() > setup.kinds.size() ? *with_unlike_dampers(setup) : setup;
  for (const std::string& model : models) {
    if (is_law(model)) continue;
    add_fit(model, law.model, [&](const InPlantOptions& own) {
      if (law.report.has_models()) return identify_along(model, law, as_taken, recordings, own);
      InPlantReport none;
      none.message = "no law could be fitted before it: " + law.report.message;
      return none;
    });
  }
  return fits;
}

std::vector<Record> bench_records_along(const InPlantReport& fit, const InPlantSetup& stated,
                                        const std::vector<PlantRecording>& recordings,
                                        const InPlantOptions& options) {
  const InPlantSetup setup = with_lags_found(with_noise_found(stated, fit), fit);
  const std::vector<PlantRecording> fitted = fitted_parts(setup, recordings);
  return as_bench_records(setup, fitted,
                          observe_beside_force(as_found(setup, fit), fitted, fit.traces, options));
}

}  // namespace dashpot
