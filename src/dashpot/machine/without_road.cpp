#include "dashpot/machine/without_road.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/error.h"
#include "dashpot/machine/bench_start.h"
#include "dashpot/machine/damper_drive.h"
#include "dashpot/machine/more_unknowns.h"
#include "dashpot/machine/observe.h"
#include "dashpot/machine/plant_of_matrices.h"
#include "dashpot/machine/plant_start.h"
#include "dashpot/machine/road_pairs.h"
#include "dashpot/machine/sensor_doubts.h"
#include "dashpot/machine/spectral_likelihood.h"
#include "dashpot/numerics/distributions.h"
#include "dashpot/numerics/linear_algebra.h"

namespace dashpot {
namespace {

/// Of motions alone only ratios of masses, stiffnesses and forces can be told.
bool knows_a_force(const InPlantSetup& setup) {
  const auto is_force = [](const PlantInputChannel& one) {
    return one.place.kind == PlantInput::Force;
  };
  if (std::ranges::any_of(setup.inputs, is_force)) return true;
  for (const PlantSensor& sensor : setup.sensors)
    if (sensor.place.quantity == PlantQuantity::DamperForce) return true;
  if (setup.matrices && setup.matrices->states_a_number) return true;
  const auto& rows = setup.model->parameters;
  return std::ranges::any_of(setup.known, [&](const auto& known) {
    const auto& row = rows[row_named(rows, known.first, setup.model->name, "plant")];
    return known.second > 0 && (row.unit.find("kg") != std::string_view::npos ||
                                row.unit.find('N') != std::string_view::npos);
  });
}

void require_tellable(const InPlantSetup& setup, const std::vector<PlantRecording>& recordings) {
  const std::string where = "plant, sensors";
  if (setup.sensors.size() < 2)
    throw Error(where,
                "there is one, and nothing measures the road: what one sensor shows may come of "
                "the road or of the damper",
                "a second sensor: accelerations of body and wheel, the deflection");
  road_pairs(setup);  // throws at roads that are neither alone nor two side by side
  if (!knows_a_force(setup))
    throw Error("plant, parameters",
                "no mass, stiffness or force is known: motions alone tell only their ratios",
                "state one of them, the mass of the wheel, say");
  if (std::ranges::all_of(setup.sensors, &PlantSensor::finds_delay))
    throw Error(where, "all delays are unknown, and nothing that is measured moves the plant",
                "state the delay of one sensor: the others are found beside it");
  for (const PlantSensor& sensor : setup.sensors)
    if (sensor.finds_cutoff)
      throw Error(
          "plant, " + sensor.channel,
          "the cut-off of its filter is unknown, and beside a road that nothing measures it "
          "is not looked for",
          "the cut-off itself, or 'delay: unknown', which a filter nearly is");
  for (const PlantInputChannel& input : setup.inputs)
    if (input.finds_later)
      throw Error("plant, " + input.channel,
                  "is to be found, and beside a road that nothing measures it is not looked for",
                  "the delay itself, without 'about'");
  if (recordings.empty()) throw Error("recordings", "there are none", "name at least one");

  constexpr std::size_t kFewest = 500;
  for (const PlantRecording& recording : recordings) {
    require_units(setup, recording);
    const auto first =
        static_cast<std::size_t>(std::max(kFilterSettles, setup.skip) / recording.sample_time);
    const std::size_t fitted = fitted_samples(setup, recording);
    if (fitted < kFewest + first)
      throw Error(recording.name, "leaves " + std::to_string(fitted) + " samples to fit",
                  "at least " + std::to_string(kFewest) + " behind those that are skipped");
    if (recording.sample_time != recordings.front().sample_time)
      throw Error(recording.name, "has another sample rate than " + recordings.front().name,
                  "recordings of one rate");
    const std::vector<std::string> drives = setup.drive_channels();
    for (const std::string& name : setup.channels()) {
      const auto [low, high] = std::ranges::minmax(recording.channel(name).samples);
      if (low == high && std::ranges::find(drives, name) == drives.end())
        throw Error(recording.name + ", " + name, "is constant: it tells nothing of the plant",
                    "a recording in which the plant moves");
    }
  }
}

/// All that the stages of a fit share.
struct Task {
  const Law& law;
  const InPlantSetup& setup;
  const InPlantOptions& options;
  std::vector<PlantRecording> fitted;  ///< what may be fitted of each recording
  std::vector<double> plant;           ///< where the plant's unknowns start, SI
  std::vector<Domain> domains;         ///< of the motion of each kind of damper
};

/// The domain of the motion of a kind of damper in these records, which are those of one damper of
/// the plant after the other.
Domain domain_of(std::size_t kind, const InPlantSetup& setup, const std::vector<Record>& records) {
  const std::size_t dampers = setup.dampers();
  const auto range = [&](const std::string& name, double& low, double& high) {
    low = INFINITY;
    high = -INFINITY;
    for (std::size_t r = 0; r < records.size(); ++r) {
      const Channel* channel = records[r].find(name);
      if (!channel || setup.kinds.at(r % dampers) != kind) continue;
      const auto [least, greatest] = std::ranges::minmax(channel->samples);
      low = std::min(low, least);
      high = std::max(high, greatest);
    }
    if (!(low <= high)) low = high = 0;
  };
  Domain domain;
  range("displacement", domain.displacement_min, domain.displacement_max);
  range("velocity", domain.velocity_min, domain.velocity_max);
  range(setup.drive_unit == DriveUnit::Volt ? "voltage" : "current", domain.current_min,
        domain.current_max);
  return domain;
}

/// The inverse of the information between the scores' own products, where there are enough of them.
Covariance spread_of(const SpectralLikelihood& likelihood, const MostLikely& found) {
  const LikelihoodSlopes& slopes = found.slopes;
  const std::size_t n = slopes.gradient.size();

  // Noise that has gone to a bound is known there.
  std::vector<double> information = slopes.information;
  for (std::size_t k = 0; k < n; ++k)
    if (likelihood.is_noise(k) && likelihood.described(k, found.x).at_bound)
      for (std::size_t i = 0; i < n; ++i) information[k * n + i] = information[i * n + k] = 0;
  Covariance spread =
      covariance(std::vector<std::vector<double>>{information}, std::vector{1.0}, n);
  if (slopes.block_scores.size() < kBlocksPerUnknown * n) return spread;

  // Each block's score about their mean, which bounds keep off 0.
  const auto blocks = static_cast<double>(slopes.block_scores.size());
  std::vector<double> scores(n * n);
  for (const std::vector<double>& score : slopes.block_scores)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k)
        scores[i * n + k] += (score[i] - slopes.gradient[i] / blocks) *
                             (score[k] - slopes.gradient[k] / blocks) * blocks /
                             (blocks - static_cast<double>(n));
  spread.matrix = product(product(spread.matrix, scores, n), spread.matrix, n);
  return spread;
}

/// Of noise the logarithms are normal, not the numbers; and nothing is looked for beyond the
/// bounds.
void mend_intervals(const SpectralLikelihood& likelihood, InPlantReport& report) {
  for (std::size_t k = 0; k < likelihood.size(); ++k) {
    if (!likelihood.is_noise(k)) continue;
    FittedParameter& p =
        *std::ranges::find(report.nuisances, likelihood.name(k), &FittedParameter::name);
    if (p.at_bound) p.weak = false;
    const double half = (p.high - p.low) / 2 / p.value;
    p.low = std::max(p.value * std::exp(-half), std::exp(likelihood.lower()[k]));
    p.high = std::min(p.value * std::exp(half), std::exp(likelihood.upper()[k]));
  }
}

/// The share of what is known of an unknown for which no number of the law can stand.
double share_beside_law(const SpectralLikelihood& likelihood, const LikelihoodSlopes& slopes,
                        std::size_t k) {
  constexpr double kRidge = 1e-9;
  const std::size_t n = likelihood.size();
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < n; ++i)
    if (likelihood.is_of_law(i) && slopes.information[i * n + i] > 0) others.push_back(i);

  // Each scaled to an information of 1, so that `right` holds cosines.
  const auto scaled = [&](std::size_t i, std::size_t j) {
    return slopes.information[i * n + j] /
           std::sqrt(slopes.information[i * n + i] * slopes.information[j * n + j]);
  };
  const std::size_t m = others.size();
  std::vector<double> matrix(m * m), right(m), solution(m);
  for (std::size_t i = 0; i < m; ++i) {
    right[i] = scaled(others[i], k);
    for (std::size_t j = 0; j < m; ++j)
      matrix[i * m + j] = scaled(others[i], others[j]) + (i == j ? kRidge : 0);
  }
  if (!solve_positive_definite(matrix, right, solution)) return 0;
  double share = 1;
  for (std::size_t i = 0; i < m; ++i) share -= right[i] * solution[i];
  return share;
}

/// What a spring or a dashpot beside the law, which the law cannot make, would do to the plant's
/// numbers: their intervals reach to where these go, and a warning says so where it matters.
void ask_for_more(SpectralLikelihood& more, std::vector<double> x, const InPlantOptions& options,
                  InPlantReport& report) {
  constexpr double kOwnShare = 0.01, kChance = 0.005;
  const std::size_t n = more.size();

  // What the law can make by itself is not asked for.
  const MostLikely before = most_likely(more, x, 0, options.threads, options.monitor);
  if (!before.slopes.finite) return;
  bool asks = false;
  for (std::size_t k = more.first_more(); k < n; ++k)
    if (share_beside_law(more, before.slopes, k) > kOwnShare)
      asks = true;
    else
      more.hold_at_zero(k);
  if (!asks) return;

  const MostLikely found =
      most_likely(more, std::move(x), options.iterations, options.threads, options.monitor);
  if (!found.slopes.finite) return;
  const Covariance spread = spread_of(more, found);
  const auto half_of = [&](std::size_t k, double widths) {
    const double size[] = {more.size_at(k, found.x)};
    return widths * std::sqrt(spread.variance(k, size));
  };

  // The plant's intervals, to where they are with it.
  constexpr double kWider = 1.5;
  bool matters = false;
  for (std::size_t k = 0; k < report.plant.size(); ++k) {
    FittedParameter& p = report.plant[k];
    const double value = more.described(k, found.x).value, half = half_of(k, kNormal95),
                 before_it = p.high - p.low;
    p.low = std::min(p.low, value - half);
    p.high = std::max(p.high, value + half);
    matters |= p.high - p.low > kWider * before_it;
  }
  for (std::size_t k = more.first_more(); k < n; ++k) {
    const FittedParameter p = more.described(k, found.x);
    const bool shows = std::abs(p.value) > half_of(k, normal_quantile(1 - kChance));
    if (more.is_held(k) || (!shows && !matters)) continue;
    if (shows) report.lacks += (report.lacks.empty() ? "" : " and a ") + p.name;
    const double half = half_of(k, kNormal95);
    report.warnings.push_back(
        (shows ? "beside this law the damper shows a " + p.name + " of " + format_number(p.value, 3)
               : "this law has no " + p.name + ", and nothing tells whether the damper has one: ") +
        (shows ? " " + p.unit + " (" : "") + format_number(p.value - half, 3) + " ... " +
        format_number(p.value + half, 3) + (shows ? ")" : " " + p.unit) +
        ": intervals of the plant reach to where its numbers go with it; try a law that makes it");
  }
}

/// The dampers that were found, each where it stands.
ObservedDampers in_struts(const InPlantReport& report, const InPlantSetup& setup) {
  ObservedDampers dampers;
  for (std::size_t d = 0; d < setup.dampers(); ++d) {
    const FoundDamper& own = report.kinds[setup.kinds.at(d)];
    dampers.push_back({own.model, own.domain});
  }
  return dampers;
}

/// Sensors one sample ahead, before and behind what was fitted, and the damper as it is observed.
void add_traces(const Task& task, const InPlantSetup& found, const ObserverNoise& noise,
                const std::vector<PlantRecording>& recordings, InPlantReport& report) {
  constexpr std::size_t kFewest = 200;  // samples held back that say something
  const auto look = [&](const std::vector<PlantRecording>& parts) {
    return observe(in_struts(report, found), found, parts,
                   {.force = noise.force,
                    .threads = task.options.threads,
                    .monitor = {.on_progress = {}, .stop = task.options.monitor.stop},
                    .is_straight = true,
                    .seeks_faults = false});
  };
  const ObserveReport seen = look(task.fitted);
  std::vector<PlantRecording> held_back;
  for (std::size_t r = 0; r < recordings.size(); ++r)
    if (recordings[r].samples - task.fitted[r].samples >= kFewest)
      held_back.push_back(part_of(recordings[r], task.fitted[r].samples, recordings[r].samples));
  const ObserveReport unseen = held_back.empty() ? ObserveReport{} : look(held_back);

  report.steps = static_cast<std::size_t>(seen.steps);
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    const ObservedRecording& told = seen.recordings[r];
    const auto behind =
        std::ranges::find(unseen.recordings, recordings[r].name, &ObservedRecording::name);
    for (std::size_t s = 0; s < told.sensors.size(); ++s)
      report.sensors.push_back({.recording = told.name,
                                .channel = told.sensors[s].channel,
                                .unit = told.sensors[s].unit,
                                .rms = told.sensors[s].rms,
                                .training = told.sensors[s].surprise,
                                .held_back = behind == unseen.recordings.end()
                                                 ? std::numeric_limits<double>::quiet_NaN()
                                                 : behind->sensors[s].surprise,
                                .offset = told.sensors[s].offset});
    InPlantTrace trace{.recording = told.name,
                       .sample_time = told.sample_time,
                       .training = task.fitted[r].samples};
    const std::size_t dampers = seen.struts.size();
    const auto motions = observed_motions(found, task.fitted[r], told);
    for (std::size_t d = 0; d < dampers; ++d) {
      const auto [force, deflection, velocity] = damper_quantities(d, dampers);
      trace.dampers.push_back({.strut = seen.struts[d],
                               .deflection = told.quantities[deflection].value,
                               .velocity = told.quantities[velocity].value,
                               .force = told.quantities[force].value});
      for (const DamperInput& input : motions[d])
        trace.dampers.back().current.push_back(input.current);
    }
    report.traces.push_back(std::move(trace));
  }
}

/// Where a fit begins, and where it came to.
struct Point {
  std::vector<double> plant, law;
  ObserverNoise noise;
  double gain_by_delays = 0, gain_by_kinds = 0;  ///< at the end
};

/// The most likely from here, or from where a parameter of the law does not follow the drive: one
/// that takes on another's part at a low drive may be left there by the scoring.
MostLikely most_likely_of_starts(const SpectralLikelihood& likelihood,
                                 const DamperUnknowns& unknowns, const std::vector<double>& start,
                                 const InPlantOptions& options) {
  constexpr double kClearly = 20;  // of -log L
  const auto from = [&](std::vector<double> x) {
    return most_likely(likelihood, std::move(x), options.iterations, options.threads,
                       options.monitor);
  };
  MostLikely best = from(start);
  if (!best.slopes.finite) return best;

  // Each in turn, beside the best so far.
  const std::vector<double> found = best.x;
  const std::span law = std::span(found).subspan(likelihood.plant_unknowns(), unknowns.size());
  for (const DamperUnknowns::Flattened& flat : unknowns.flattened(law)) {
    std::vector<double> x = best.x;
    std::ranges::copy(flat.unknowns,
                      x.begin() + static_cast<std::ptrdiff_t>(likelihood.plant_unknowns()));
    MostLikely other = from(std::move(x));
    if (other.slopes.finite && other.slopes.value < best.slopes.value - kClearly)
      best = std::move(other);
  }
  return best;
}

/// The setup with the delays that it does not state among the unknowns; one stays, since on a road
/// that nobody knows a delay of all shows nowhere. Nothing where it asks for some, or states all.
std::optional<InPlantSetup> with_other_delays_unknown(InPlantSetup setup) {
  bool stays = std::ranges::any_of(setup.sensors, [](const auto& one) { return one.delay != 0; });
  bool asks = false;
  for (PlantSensor& sensor : setup.sensors) {
    if (sensor.finds_delay) return {};
    if (sensor.delay != 0) continue;
    sensor.finds_delay = stays;
    asks |= stays;
    stays = true;
  }
  return asks ? std::optional(std::move(setup)) : std::nullopt;
}

/// By how much -log L would fall for each sample, to first order, with the unknowns of a setup that
/// has more of them; 0 where there is none. law: where those of the dampers stand.
double gain_by_more(const std::optional<InPlantSetup>& beside, const Task& task,
                    const std::vector<RiddenRecording>& rides, const DamperUnknowns& unknowns,
                    const std::vector<double>& law, double force, const Point& point) {
  constexpr double kTrace = 1e-9;  // keeps what the law and the noise trade solvable
  if (!beside) return 0;
  const SpectralLikelihood more(*beside, rides, unknowns, point.plant, point.noise, force);
  const std::vector<double> start = more.start(point.plant, law);
  const LikelihoodSlopes slopes =
      most_likely(more, start, 0, task.options.threads, task.options.monitor).slopes;
  if (!slopes.finite) return 0;

  // A step of the scoring.
  const std::size_t n = more.size();
  std::vector<double> matrix = slopes.information, step(n);
  for (std::size_t k = 0; k < n; ++k)
    matrix[k * (n + 1)] = std::max(matrix[k * (n + 1)] * (1 + kTrace), 1e-300);
  if (!solve_positive_definite(matrix, slopes.gradient, step)) return 0;
  double gain = 0, samples = 0;
  for (std::size_t k = 0; k < n; ++k) gain += slopes.gradient[k] * step[k] / 2;
  for (const RiddenRecording& ride : rides) samples += static_cast<double>(ride.samples);
  return gain / samples;
}

/// The most likely of all unknowns along the observed motion, from `point`, which moves there. The
/// setup as it was found; the report has no model where the law diverges. `last`: intervals too.
InPlantSetup fit_along(const Task& task, const DamperUnknowns& unknowns, double force,
                       const ObserveReport& observed, bool last, Point& point,
                       InPlantReport& report) {
  const InPlantOptions& options = task.options;
  std::vector<RiddenRecording> rides;
  for (std::size_t r = 0; r < task.fitted.size(); ++r)
    rides.push_back({&task.fitted[r], task.fitted[r].samples,
                     observed_motions(task.setup, task.fitted[r], observed.recordings[r])});
  const SpectralLikelihood likelihood(task.setup, rides, unknowns, point.plant, point.noise, force);
  const std::vector<double> start = likelihood.start(point.plant, point.law);

  // What can be told is said before the fit.
  if (!last) {
    const MostLikely before = most_likely(likelihood, start, 0, options.threads, options.monitor);
    if (before.slopes.finite)
      report.knowable = knowable_of(likelihood, {before.slopes.information}, start.size());
  }
  const MostLikely found =
      last ? most_likely(likelihood, start, options.iterations, options.threads, options.monitor)
           : most_likely_of_starts(likelihood, unknowns, start, options);
  report.iterations += found.iterations;
  report.kinds.clear();
  if (!found.slopes.finite) {
    report.message = "the law diverges along the motion that the sensors tell";
    return task.setup;
  }
  for (LawModel& law : likelihood.laws(found.x)) {
    const std::size_t kind = report.kinds.size();
    report.kinds.push_back({task.setup.kinds.names[kind],
                            task.setup.kinds.struts(kind, task.setup.dampers()),
                            std::make_shared<LawModel>(std::move(law)), task.domains[kind]});
  }
  for (std::size_t k = 0; k < point.plant.size(); ++k)
    point.plant[k] = likelihood.described(k, found.x).value;
  std::copy_n(found.x.begin() + static_cast<std::ptrdiff_t>(point.plant.size()), unknowns.size(),
              point.law.begin());
  point.noise = likelihood.noise(found.x);

  // Dampers that go alike err alike, which the likelihood does not know.
  constexpr double kOneRoad = 0.05;  // m
  if (const double width = point.noise.track_width; width > 0 && width < kOneRoad) {
    report.kinds.clear();
    report.message =
        "left and right meet one and the same road, so that nothing tells how the plant rolls, and "
        "a fit beside it would be wrong: take a half_car, or a road whose tracks differ";
    return task.setup;
  }

  // Intervals and what else is to be said.
  if (last) {
    report.status =
        found.converged ? FitReport::Status::Converged : FitReport::Status::IterationLimit;
    report.message = found.converged ? "most likely" : "still rising after all iterations";
    const Covariance spread = spread_of(likelihood, found);
    add_parameters(likelihood, found.x, spread, report);
    mend_intervals(likelihood, report);
    add_warnings(likelihood, spread, report);
    point.gain_by_delays = gain_by_more(with_other_delays_unknown(task.setup), task, rides,
                                        unknowns, point.law, force, point);
    if (const std::optional<InPlantSetup> unlike = with_unlike_dampers(task.setup)) {
      const DamperUnknowns apart = unknowns.in_kinds(unlike->kinds);
      point.gain_by_kinds =
          gain_by_more(unlike, task, rides, apart, apart.alike(point.law), force, point);
    }
    SpectralLikelihood more(task.setup, rides, unknowns, point.plant, point.noise, force, true);
    ask_for_more(more, more.start(point.plant, point.law), options, report);
  }
  return likelihood.setup_at(found.x);
}

/// All stages of a fit of the setup as it stands.
InPlantReport fit_without_road(const Law& law, const InPlantSetup& setup,
                               const std::vector<PlantRecording>& recordings,
                               const InPlantOptions& options, FitDoubts& doubts) {
  constexpr double kWorthATry = 0.01;  // of -log L, for each sample
  InPlantReport report;
  report.road_measured = false;
  report.step_error = std::numeric_limits<double>::quiet_NaN();
  require_drive(law, setup, options, report.warnings);
  Task task{law, setup, options, {}, first_numbers(setup, {}, report.warnings), {}};
  task.fitted = fitted_parts(setup, recordings);

  // The dampers' motion and force without the law, and the law as a bench would find it.
  options.monitor.report("motion and force of the dampers, without the law", 0);
  ObserveReport observed = observe_without_law(setup, task.plant, task.fitted, options);
  const std::vector<Record> records = as_bench_records(setup, task.fitted, observed);
  options.monitor.report("the law, as on a bench", 0.2);
  const DataScale size = data_scale(records, setup.drive_unit);
  const std::shared_ptr<const DamperModel> from_bench =
      fit_as_on_bench(law, setup, records, options);
  const DamperUnknowns unknowns(from_bench ? from_bench->law_inside()->law() : law, size, setup,
                                options.choices);
  for (const std::string& warning : unknowns.warnings()) report.warnings.push_back(warning);
  std::vector<double> law_numbers = unknowns.start();
  if (from_bench)
    law_numbers = unknowns.off_bounds(
        unknowns.of(std::vector<LawModel>(setup.kinds.size(), *from_bench->law_inside())));

  // The most likely of all, and once more along the motion that a filter with that sees.
  constexpr double kFirstError = 0.1;
  ObserverNoise noise = observed.noise;
  noise.force = {{kFirstError * size.force, 0.01}, {kFirstError * size.force, 0.3}};
  Point point{task.plant, std::move(law_numbers), noise};
  for (std::size_t kind = 0; kind < setup.kinds.size(); ++kind)
    task.domains.push_back(domain_of(kind, setup, records));
  try {
    for (const bool last : {false, true}) {
      options.monitor.report(last ? "fit, along the motion as now observed" : "fit",
                             last ? 0.6 : 0.3);
      const InPlantSetup found =
          fit_along(task, unknowns, size.force, observed, last, point, report);
      if (!report.has_models()) break;
      if (!last) {
        observed = observe(in_struts(report, found), found, task.fitted,
                           {.force = point.noise.force,
                            .threads = options.threads,
                            .is_straight = true,
                            .seeks_faults = false});
        continue;
      }
      report.force_error = 0;
      for (const ForceError& error : point.noise.force)
        report.force_error = std::hypot(report.force_error, error.deviation);
      add_traces(task, found, point.noise, recordings, report);
      std::ranges::move(noise_doubts(setup, report), std::back_inserter(report.warnings));
      doubts = {point.gain_by_delays > kWorthATry, point.gain_by_kinds > kWorthATry};
    }
  } catch (const Error& error) {
    // A filter with this law diverges; those of other laws may not.
    report.kinds.clear();
    report.status = FitReport::Status::Failed;
    report.message = error.what();
  }
  return report;
}

/// Once more with dampers that are not alike, of which the plant does not say that they are. Taken
/// where the fit gets on; `setup` then says so.
InPlantReport fit_unlike_ones(const Law& law, InPlantSetup& setup,
                              const std::vector<PlantRecording>& recordings,
                              const InPlantOptions& options, InPlantReport as_stated,
                              FitDoubts& doubts) {
  const InPlantSetup unlike = *with_unlike_dampers(setup);
  FitDoubts then;
  InPlantReport report = fit_without_road(law, unlike, recordings, options, then);
  if (!report.has_models()) return as_stated;
  report.warnings.push_back(unlike_found(unlike));
  setup = unlike;
  doubts = then;
  return report;
}

/// Once more with the delays that the plant does not state among the unknowns. Taken where the
/// law's own errors are then clearly smaller and some delay is more than what a law of another
/// structure than the damper's is late by.
InPlantReport fit_beside_other_delays(const Law& law, const InPlantSetup& setup,
                                      const std::vector<PlantRecording>& recordings,
                                      const InPlantOptions& options, InPlantReport as_stated) {
  constexpr double kClearly = 0.7;  // of the force; half the power
  constexpr double kLate = 0.001;   // s
  const InPlantSetup beside = *with_other_delays_unknown(setup);
  FitDoubts then;
  InPlantReport report = fit_without_road(law, beside, recordings, options, then);
  double most = 0;
  for (const FittedParameter& p : report.nuisances)
    if (p.name.starts_with("delay of ")) most = std::max(most, std::abs(p.value));
  const bool is_better =
      report.has_models() && most > kLate && report.force_error < kClearly * as_stated.force_error;
  if (!is_better) return as_stated;

  // What was found, and beside which sensor.
  const auto stays = std::ranges::find(beside.sensors, false, &PlantSensor::finds_delay);
  report.warnings.push_back(delays_found(setup, beside, report) + "; all may be later by what " +
                            stays->channel + " is late by, which shows nowhere");
  return report;
}

}  // namespace

InPlantReport identify_without_road(const Law& law, const InPlantSetup& setup,
                                    const std::vector<PlantRecording>& recordings,
                                    const InPlantOptions& options) {
  const double started = cpu_seconds();
  require_setup(setup);
  require_tellable(setup, recordings);
  FitDoubts doubts;
  InPlantSetup as_taken = with_held_drives(setup, recordings);
  InPlantReport report = fit_without_road(law, as_taken, recordings, options, doubts);
  if (report.has_models() && doubts.are_unlike)
    report = fit_unlike_ones(law, as_taken, recordings, options, std::move(report), doubts);
  if (report.has_models() && doubts.is_late)
    report = fit_beside_other_delays(law, as_taken, recordings, options, std::move(report));
  report.seconds = cpu_seconds() - started;
  return report;
}

}  // namespace dashpot
