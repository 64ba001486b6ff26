#include "dashpot/machine/plant_advice.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/machine/plant_residuals.h"
#include "dashpot/machine/virtual_campaign.h"
#include "dashpot/numerics/distributions.h"
#include "dashpot/numerics/linear_algebra.h"

namespace dashpot {
namespace {

constexpr double kKnownBefore = 10;  // of each unknown, in its size

/// Information about all unknowns: a symmetric matrix, the inverse of their covariance.
using Information = std::vector<double>;

/// A number of plant or damper as a weighted sum of unknowns.
struct NumberOfInterest {
  std::string name, unit;
  double value = 0;
  std::size_t first = 0;
  std::vector<double> weights;
};

std::vector<NumberOfInterest> numbers_of(const EndedFit& fit) {
  std::vector<NumberOfInterest> numbers;
  const std::size_t plant = fit.residuals.plant_unknowns();
  for (std::size_t k = 0; k < plant; ++k) {
    const FittedParameter p = fit.residuals.described(k, fit.solved.x);
    numbers.push_back({p.name, p.unit, p.value, k, {fit.residuals.size_at(k, fit.solved.x)}});
  }
  for (const auto& c : fit.residuals.law_coefficients(fit.solved.x))
    if (!c.weights.empty())
      numbers.push_back({c.name, c.unit, c.value, plant + c.first, c.weights});
  return numbers;
}

void add_to(Information& sum, const std::vector<double>& matrix, double weight) {
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * matrix[k];
}

/// Per number, the standard deviation under this information.
std::vector<double> deviations_under(const Information& information, std::size_t n,
                                     const std::vector<NumberOfInterest>& numbers) {
  Information known = information;
  for (std::size_t k = 0; k < n; ++k) known[k * n + k] += 1 / (kKnownBefore * kKnownBefore);

  // Unknowns that nothing tells lie ten orders below the others: each by its own curvature.
  std::vector<double> size(n);
  for (std::size_t k = 0; k < n; ++k) size[k] = 1 / std::sqrt(known[k * n + k]);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) known[i * n + k] *= size[i] * size[k];
  const std::vector<double> covariance = inverse(known, n);
  std::vector<double> deviations;
  for (const NumberOfInterest& one : numbers) {
    double variance = 0;
    for (std::size_t i = 0; i < one.weights.size(); ++i)
      for (std::size_t k = 0; k < one.weights.size(); ++k)
        variance += one.weights[i] * size[one.first + i] *
                    covariance[(one.first + i) * n + one.first + k] * size[one.first + k] *
                    one.weights[k];
    deviations.push_back(std::sqrt(std::max(variance, 0.0)));
  }
  return deviations;
}

/// How the intervals shrink from `before` to `after`.
PlantAddition addition_of(std::string what, const std::vector<double>& before,
                          const std::vector<double>& after,
                          const std::vector<NumberOfInterest>& numbers) {
  PlantAddition addition{.what = std::move(what)};
  double sum = 0;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const double ratio = before[k] > 0 ? std::min(after[k] / before[k], 1.0) : 1;
    sum += std::log(std::max(ratio, 1e-12));
    if (k > 0 && ratio >= addition.of_most) continue;
    addition.most = numbers[k].name;
    addition.of_most = ratio;
  }
  addition.intervals = std::exp(sum / static_cast<double>(numbers.size()));
  if (addition.of_most >= 1) addition.most.clear();
  return addition;
}

/// Variance of one independent residual at each sensor of each recording.
std::vector<double> part_variances(const EndedFit& fit) {
  const LeastSquaresProblem whole = fit.residuals.problem();
  std::vector<double> r(whole.residuals);
  whole.residual(fit.solved.x, r);
  std::vector<std::pair<std::size_t, std::size_t>> segments;
  for (std::size_t part = 0; part < whole.parts.size(); ++part)
    segments.emplace_back(
        whole.parts[part],
        (part + 1 < whole.parts.size() ? whole.parts[part + 1] : r.size()) - whole.parts[part]);
  return independent_variances(r, segments, fit.solved.x.size());
}

/// What the present sensors tell, and how much more than a grade's noise each of them counts.
struct Present {
  Information information;
  std::vector<double> per_sensor;  ///< variance of an independent residual, mean over recordings
  double excess = 1;               ///< variance over that of the grade's noise, the median sensor
};

Present present_of(const EndedFit& fit, const SensorGrade& grade) {
  const std::size_t n = fit.solved.x.size(), sensors = fit.setup.sensors.size();
  const std::vector<double> variances = part_variances(fit);
  Present present{Information(n * n), std::vector<double>(sensors), 1};
  for (std::size_t part = 0; part < variances.size(); ++part) {
    add_to(present.information, fit.solved.part_matrices[part], 1 / variances[part]);
    present.per_sensor[part % sensors] +=
        variances[part] * static_cast<double>(sensors) / static_cast<double>(variances.size());
  }
  std::vector<double> excess;
  for (std::size_t s = 0; s < sensors; ++s) {
    const double noise =
        grade.sensors[static_cast<std::size_t>(fit.setup.sensors[s].place.quantity)];
    excess.push_back(present.per_sensor[s] * std::pow(fit.residuals.scale_of(s) / noise, 2));
  }
  std::ranges::sort(excess);
  present.excess = std::max(1.0, excess[excess.size() / 2]);
  return present;
}

/// Every quantity at every point that the plant could show and no sensor does.
std::vector<PlantSensorPlace> places_without(const InPlantSetup& setup, const Plant& plant) {
  std::vector<PlantSensorPlace> places;
  const auto add = [&](PlantSensorPlace place) {
    const bool is_there = std::ranges::any_of(setup.sensors, [&](const PlantSensor& one) {
      return one.place.quantity == place.quantity &&
             (place.is_of_damper() ? one.place.strut == place.strut
                                   : one.place.coordinate == place.coordinate);
    });
    if (!is_there) places.push_back(place);
  };
  for (const PlantQuantity q :
       {PlantQuantity::Displacement, PlantQuantity::Velocity, PlantQuantity::Acceleration})
    for (std::size_t c = 0; c < plant.size(); ++c) add({q, c});
  for (const PlantQuantity q :
       {PlantQuantity::Deflection, PlantQuantity::DeflectionVelocity, PlantQuantity::DamperForce})
    for (std::size_t d = 0; d < plant.struts.size(); ++d) add({q, 0, d});
  return places;
}

std::string words_of(PlantSensorPlace place, const Plant& plant) {
  constexpr const char* kWords[] = {"displacement",        "velocity",
                                    "acceleration",        "deflection of the damper",
                                    "speed of the damper", "force of the damper"};
  const std::string word = kWords[static_cast<std::size_t>(place.quantity)];
  if (!place.is_of_damper()) return word + " of " + plant.coordinates[place.coordinate].name;
  return plant.struts.size() > 1 ? word + " at " + plant.struts[place.strut].name : word;
}

/// Adds J'J of what such sensors would show in one recording, over their samples without their
/// mean. False where the plant diverges beside the best.
bool add_information(const EndedFit& fit, std::size_t recording,
                     const std::vector<PlantSensorPlace>& places, int threads,
                     std::vector<Information>& sums) {
  constexpr double kStep = 1e-5;
  const std::vector<double>& x = fit.solved.x;
  const auto shown = fit.residuals.other_sensors(x, recording, places);
  std::vector<PlantResiduals::Shown> slopes(x.size());
  parallel_for(x.size(), threads, [&](std::size_t k) {
    if (!fit.residuals.acts_on(k, recording)) {
      for (const std::vector<double>& samples : shown) slopes[k].emplace_back(samples.size(), 0.0);
      return;
    }
    std::vector<double> moved = x;
    const double length = kStep * std::max(1.0, std::abs(x[k]));
    moved[k] += length;
    slopes[k] = fit.residuals.other_sensors(moved, recording, places);
    for (std::size_t s = 0; s < slopes[k].size() && s < shown.size(); ++s)
      for (std::size_t i = 0; i < shown[s].size(); ++i)
        slopes[k][s][i] = (slopes[k][s][i] - shown[s][i]) / length;
  });
  if (shown.empty() || std::ranges::any_of(slopes, [](const auto& one) { return one.empty(); }))
    return false;

  for (std::size_t s = 0; s < places.size(); ++s)
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::size_t k = 0; k < x.size(); ++k)
        sums[s][i * x.size() + k] +=
            std::inner_product(slopes[i][s].begin(), slopes[i][s].end(), slopes[k][s].begin(), 0.0);
  return true;
}

/// The same over all recordings; empty where the plant diverges in one.
std::vector<Information> information_at(const EndedFit& fit,
                                        const std::vector<PlantSensorPlace>& places, int threads) {
  const std::size_t n = fit.solved.x.size();
  std::vector<Information> sums(places.size(), Information(n * n));
  for (std::size_t recording = 0; recording < fit.cases.all.size(); ++recording)
    if (!add_information(fit, recording, places, threads, sums)) return {};
  return sums;
}

/// Information about the unknowns that every recording shares, the others left open: those at
/// first ... end - 1 are of one recording alone.
Information shared_of(const Information& information, std::size_t n, std::size_t first,
                      std::size_t end) {
  std::vector<std::size_t> shared, own;
  for (std::size_t k = 0; k < n; ++k) (k >= first && k < end ? own : shared).push_back(k);
  const std::size_t m = shared.size(), o = own.size();
  Information inside(o * o), across(o * m), kept(m * m);
  for (std::size_t i = 0; i < o; ++i) {
    for (std::size_t k = 0; k < o; ++k) inside[i * o + k] = information[own[i] * n + own[k]];
    for (std::size_t k = 0; k < m; ++k) across[i * m + k] = information[own[i] * n + shared[k]];
    inside[i * o + i] += 1e-9 * inside[i * o + i] + 1e-300;
  }
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t k = 0; k < m; ++k) kept[i * m + k] = information[shared[i] * n + shared[k]];
  if (o == 0) return kept;
  const std::vector<double> solved = solve_columns(inside, across, o);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t k = 0; k < m; ++k)
      for (std::size_t j = 0; j < o; ++j) kept[i * m + k] -= across[j * m + i] * solved[j * m + k];
  return kept;
}

/// A recording that was not made: the first one, moved more or driven at one level.
struct Manoeuvre {
  std::string what;
  double amplitude = 1;
  std::optional<double> level = {};
};

std::vector<Manoeuvre> manoeuvres(const EndedFit& fit) {
  std::vector<Manoeuvre> all = {{"twice the amplitude", 2}, {"half the amplitude", 0.5}};
  const auto [low, high, varies, levels] = drive_range(fit.cases);
  if (fit.setup.drive_channels().empty() || !(high > low)) return all;
  const std::string unit = to_string(fit.setup.drive_unit);
  for (const double level : {low, 0.5 * (low + high), high, high + 0.5 * (high - low)})
    all.push_back({format_number(level, 3) + " " + unit + " all along", 1, level});
  return all;
}

/// Information of that recording about what all share; empty where the plant diverges in it.
Information information_of(const EndedFit& fit, const Manoeuvre& manoeuvre,
                           const std::vector<double>& per_sensor, int threads) {
  PlantCases cases{
      .all = {fit.cases.all.front()}, .steps = fit.cases.steps, .method = fit.cases.method};
  PlantCase& one = cases.all.front();
  for (auto* list : {&one.driving.value, &one.driving.rate})
    for (std::vector<double>& input : *list)
      for (double& value : input) value *= manoeuvre.amplitude;
  if (manoeuvre.level) {
    for (std::vector<double>& current : one.driving.current)
      std::ranges::fill(current, *manoeuvre.level);
    std::ranges::fill(one.levels, manoeuvre.level);
  }

  // The same sensors with the same scales; the state at the beginning goes with the amplitude.
  InPlantSetup setup = fit.setup;
  for (std::size_t s = 0; s < setup.sensors.size(); ++s)
    setup.sensors[s].noise = fit.residuals.scale_of(s);
  const PlantResiduals residuals(setup, cases, fit.law, fit.plant_start, fit.scale);
  const std::size_t first = fit.residuals.first_state(),
                    states = residuals.first_of_sensors() - first;
  std::vector<double> x(fit.solved.x.begin(),
                        fit.solved.x.begin() + static_cast<std::ptrdiff_t>(first + states));
  for (std::size_t k = first; k < x.size(); ++k) x[k] *= manoeuvre.amplitude;
  x.insert(x.end(),
           fit.solved.x.begin() + static_cast<std::ptrdiff_t>(fit.residuals.first_of_sensors()),
           fit.solved.x.end());
  const LeastSquaresReport at = describe_at(residuals.problem(0, threads), x, {.threads = threads});
  if (at.part_matrices.empty() || !std::isfinite(at.cost)) return {};
  Information sum(x.size() * x.size());
  for (std::size_t s = 0; s < at.part_matrices.size(); ++s)
    add_to(sum, at.part_matrices[s], 1 / per_sensor[s]);
  return shared_of(sum, x.size(), first, first + states);
}

/// Recordings beside one more that is like the first.
std::vector<PlantAddition> rides_of(const EndedFit& fit, const Present& present,
                                    const std::vector<NumberOfInterest>& numbers, int threads) {
  const std::size_t n = fit.solved.x.size(), first = fit.residuals.first_state(),
                    end = fit.residuals.first_of_sensors(), shared = n - (end - first);

  // What both recordings tell together.
  const Information now = shared_of(present.information, n, first, end);
  const auto with = [&](const Manoeuvre& manoeuvre) {
    Information sum = information_of(fit, manoeuvre, present.per_sensor, threads);
    if (!sum.empty()) add_to(sum, now, 1);
    return sum;
  };

  // Each manoeuvre against the same ride once more.
  std::vector<PlantAddition> rides;
  const Information alike = with({});
  if (alike.empty()) return rides;
  const std::vector<double> before = deviations_under(alike, shared, numbers);
  for (const Manoeuvre& manoeuvre : manoeuvres(fit))
    if (const Information sum = with(manoeuvre); !sum.empty())
      rides.push_back(
          addition_of(manoeuvre.what, before, deviations_under(sum, shared, numbers), numbers));
  std::ranges::stable_sort(rides, {}, &PlantAddition::intervals);
  return rides;
}

/// The number that is known worst, by its size.
std::string worst_of(const std::vector<NumberOfInterest>& numbers,
                     const std::vector<double>& deviations) {
  std::size_t worst = 0;
  const auto share = [&](std::size_t k) {
    return deviations[k] / std::max(std::abs(numbers[k].value), 1e-300);
  };
  for (std::size_t k = 1; k < numbers.size(); ++k)
    if (share(k) > share(worst)) worst = k;
  return numbers[worst].name;
}

/// Where the misfit reaches that of the 95 % interval on one side, by straight lines of its root;
/// `points` from the best outwards.
double crossing(const std::vector<std::pair<double, double>>& points, double open) {
  for (std::size_t k = 1; k < points.size(); ++k) {
    const double root = std::sqrt(std::max(points[k].second, 0.0)),
                 last = std::sqrt(std::max(points[k - 1].second, 0.0));
    if (root >= kNormal95)
      return points[k - 1].first + (points[k].first - points[k - 1].first) *
                                       std::clamp((kNormal95 - last) / (root - last), 0.0, 1.0);
  }
  return open;
}

/// The unknowns with the k-th moved by `step`, and the others where that is best to first order:
/// along the floor of the valley, so that the fit there is nearly done.
std::vector<double> along_valley(const EndedFit& fit, const LeastSquaresProblem& problem,
                                 std::size_t k, double step) {
  constexpr double kRidge = 1e-9;  // of each curvature: numbers may be traded
  const std::size_t n = fit.solved.x.size();
  Information curvature(n * n);
  for (const std::vector<double>& part : fit.solved.part_matrices) add_to(curvature, part, 1);

  // What the step pushes the others by, and how stiff these are with the k-th held.
  std::vector<double> push(n), moved(n);
  for (std::size_t i = 0; i < n; ++i) {
    push[i] = i == k ? step : -step * curvature[i * n + k];
    curvature[i * n + i] = std::max(curvature[i * n + i] * (1 + kRidge), 1e-300);
  }
  for (std::size_t i = 0; i < n; ++i) curvature[i * n + k] = curvature[k * n + i] = i == k ? 1 : 0;
  if (!solve_positive_definite(curvature, push, moved)) moved[k] = step;
  for (std::size_t i = 0; i < n; ++i)
    moved[i] = std::clamp(fit.solved.x[i] + moved[i], problem.lower[i], problem.upper[i]);
  return moved;
}

double cost_at(const LeastSquaresProblem& problem, const std::vector<double>& x) {
  std::vector<double> r(problem.residuals);
  if (!problem.residual(x, r)) return INFINITY;
  return 0.5 * std::inner_product(r.begin(), r.end(), r.begin(), 0.0);
}

/// One profile: unknown k at steps of its size to both sides.
ParameterProfile profile_along(const EndedFit& fit, std::size_t k, double deviation,
                               const NumberOfInterest& number, double variance,
                               const InPlantOptions& options) {
  constexpr double kSides[] = {-3, -2, -1, 1, 2, 3};
  constexpr int kIterations = 20;
  constexpr double kNearlyNone = 0.2;  // of a misfit that reaches 3.84 at the interval's ends
  const double per_unknown = number.weights.front();
  const LeastSquaresProblem whole = fit.residuals.problem(0, options.threads);

  // As far as three deviations, where there is one to be believed; else about the number itself.
  const double own = std::abs(fit.solved.x[k]);
  const double step = deviation > 0 ? std::min(deviation, std::max(0.3 * own, 1e-6)) : 0.3 * own;
  std::vector<std::pair<double, double>> points = {{number.value, 0}};
  for (const double side : kSides) {
    const double at = fit.solved.x[k] + side * step;
    if (at < whole.lower[k] || at > whole.upper[k]) continue;
    options.monitor.check();
    LeastSquaresProblem held = whole;
    held.lower[k] = held.upper[k] = at;
    const auto add_point = [&](double cost) {
      points.emplace_back(number.value + side * step * per_unknown,
                          2 * (cost - fit.solved.cost) / variance);
    };

    // Nearly no misfit on the floor of the valley, as where numbers are traded, cannot fall much.
    const std::vector<double> floor = along_valley(fit, held, k, side * step);
    const double there = cost_at(held, floor);
    if (2 * (there - fit.solved.cost) < kNearlyNone * variance) {
      add_point(there);
      continue;
    }
    const LeastSquaresReport solved = solve(
        held, floor,
        {.max_iterations = kIterations, .function_tolerance = 1e-6, .threads = options.threads});
    if (std::isfinite(solved.cost)) add_point(solved.cost);
  }
  std::ranges::sort(points);
  ParameterProfile profile{.name = number.name, .unit = number.unit};
  std::vector<std::pair<double, double>> below, above;
  for (const auto& point : points) {
    profile.value.push_back(point.first);
    profile.misfit.push_back(point.second);
    if (point.first <= number.value) below.insert(below.begin(), point);
    if (point.first >= number.value) above.push_back(point);
  }
  profile.low = crossing(below, -INFINITY);
  profile.high = crossing(above, INFINITY);
  return profile;
}

}  // namespace

PlantAdvice advise(const EndedFit& fit, const SensorGrade& grade, const InPlantOptions& options) {
  const std::size_t n = fit.solved.x.size();
  PlantAdvice advice{.grade = grade.name};
  const std::vector<NumberOfInterest> numbers = numbers_of(fit);
  if (numbers.empty()) return advice;
  const Present present = present_of(fit, grade);
  const std::vector<double> before = deviations_under(present.information, n, numbers);
  advice.worst = worst_of(numbers, before);

  // Each sensor that is not there.
  options.monitor.report("sensors that are not there", 0.9);
  const Plant plant = make_plant(*fit.setup.model, fit.setup.known);
  const std::vector<PlantSensorPlace> places = places_without(fit.setup, plant);
  const std::vector<Information> added = information_at(fit, places, options.threads);
  for (std::size_t s = 0; s < added.size(); ++s) {
    const double noise = grade.sensors[static_cast<std::size_t>(places[s].quantity)];
    Information sum = present.information;
    add_to(sum, added[s], 1 / (noise * noise * present.excess));
    advice.sensors.push_back(addition_of(words_of(places[s], plant), before,
                                         deviations_under(sum, n, numbers), numbers));
  }
  std::ranges::stable_sort(advice.sensors, {}, &PlantAddition::intervals);

  // Each recording that was not made.
  options.monitor.report("recordings that were not made", 0.95);
  advice.rides = rides_of(fit, present, numbers, options.threads);
  return advice;
}

std::vector<ParameterProfile> profiles_of(const EndedFit& fit, const Covariance& spread,
                                          const std::vector<std::string>& names,
                                          const InPlantOptions& options) {
  // The residuals' variance, by the samples of each part.
  const std::vector<double> variances = part_variances(fit);
  const LeastSquaresProblem whole = fit.residuals.problem();
  double sum = 0;
  for (std::size_t part = 0; part < variances.size(); ++part) {
    const std::size_t end = part + 1 < whole.parts.size() ? whole.parts[part + 1] : whole.residuals;
    sum += variances[part] * static_cast<double>(end - whole.parts[part]);
  }
  const double variance = sum / static_cast<double>(whole.residuals);

  std::vector<ParameterProfile> profiles;
  const std::vector<NumberOfInterest> numbers = numbers_of(fit);
  for (const std::string& name : names)
    for (const NumberOfInterest& one : numbers) {
      if (one.name != name || one.weights.size() != 1) continue;
      options.monitor.report("profile of " + name, 0.85);
      const double unit[] = {1.0};
      profiles.push_back(profile_along(fit, one.first, std::sqrt(spread.variance(one.first, unit)),
                                       one, variance, options));
    }
  return profiles;
}

}  // namespace dashpot
