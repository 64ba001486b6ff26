#include "dashpot/machine/any_force.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"

namespace dashpot {
namespace {

constexpr double kOne[] = {1};

/// Residuals and columns at some x, weighed by the noise of each recording, and that noise.
struct Look {
  EndOfSearch end;
  std::vector<RecordingNoise> noise;
  NoiseSources sources;
};

/// Calls of(noise, rows) for each recording with its rows of all.
template <class Of>
void for_each_recording(std::vector<RecordingNoise>& noise, std::vector<double>& all,
                        const Of& of) {
  std::size_t at = 0;
  for (RecordingNoise& one : noise) {
    const std::span rows = std::span(all).subspan(at, one.lines() * one.rows_per_line());
    of(one, rows);
    at += rows.size();
  }
}

/// What pieces of time tell.
Jackknife told_by(Look look, int threads) {
  const auto whiten = [](const RecordingNoise& one, std::span<double> rows) { one.whiten(rows); };
  for_each_recording(look.noise, look.end.residuals, whiten);
  for (std::vector<double>& column : look.end.columns)
    if (!column.empty()) for_each_recording(look.noise, column, whiten);
  return {pieces_of(look.end, look.noise, threads), look.end.columns.size()};
}

/// Finds the noise that is left where the unknowns are what pieces of time tell, and weighs by it:
/// a wrong state at the beginning would count as noise.
void find_noise_left(const FitBesideNoise& fit, const Jackknife& told, Look& look) {
  std::vector<double> left = look.end.residuals;
  for (std::size_t k = 0; k < look.end.columns.size(); ++k)
    for (std::size_t i = 0; i < look.end.columns[k].size(); ++i)
      left[i] += told.step()[k] * look.end.columns[k][i];
  for_each_recording(look.noise, left,
                     [](RecordingNoise& one, std::span<double> rows) { one.set_beyond(rows); });
  look.sources =
      find_noise(look.noise, fit.setup, look.sources, fit.threads, ForceErrors::Known).sources;
}

/// As it is at the end of a fit, of which the residuals and columns are over each sensor's scale.
Look look_at(const FitBesideNoise& fit, EndOfSearch end, std::vector<RecordingNoise> noise,
             NoiseSources sources) {
  Look look{std::move(end), std::move(noise), std::move(sources)};
  for (RecordingNoise& one : look.noise) one.weigh_by(look.sources);
  const auto in_units = [&](const RecordingNoise& one, std::span<double> rows) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i] *= fit.residuals.scale_of(i % one.rows_per_line() / 2);
  };
  for_each_recording(look.noise, look.end.residuals, in_units);

  // What a law can make is a force.
  for (std::size_t k = 0; k < look.end.columns.size(); ++k)
    if (fit.residuals.is_of_law(k))
      look.end.columns[k].clear();
    else if (!look.end.columns[k].empty())
      for_each_recording(look.noise, look.end.columns[k], in_units);
  return look;
}

/// The same about another x, under inputs without their noise as it is likely there; nothing where
/// the plant diverges.
std::optional<Look> look_about(const FitBesideNoise& fit, std::span<const double> x,
                               const NoiseSources& sources) {
  fit.cases = fit.as_measured;
  const std::vector<InPlantTrace> traces = traces_at(fit.residuals, x, fit.threads);
  std::vector<RecordingNoise> noise =
      noise_about(fit.residuals.setup_at(x), fit.as_measured, traces, fit.threads);
  if (noise.empty()) return {};
  for (RecordingNoise& one : noise) one.weigh_by(sources);
  fit.cases = without_noise(fit.as_measured, fit.setup, fit.recordings, noise, fit.threads);
  keep_residuals(traces, traces_at(fit.residuals, x, fit.threads), fit.cases);
  std::optional<EndOfSearch> end = end_of(fit.problem, x);
  if (!end) return {};
  return look_at(fit, std::move(*end), std::move(noise), sources);
}

/// Whether a number of the plant goes further from where the fit ended than by chance. The law's
/// own step from there counts as none: it is the fit's number that is told.
bool differs(const Jackknife& told, const Jackknife& beside_law, std::size_t count) {
  constexpr double kChance = 0.05;
  const double beyond = kChance / 2 / static_cast<double>(count);
  for (std::size_t k = 0; k < count; ++k)
    if (std::abs(told.step()[k]) > told.half_of_difference(beside_law, k, beyond)) return true;
  return false;
}

}  // namespace

std::optional<BesideAnyForce> beside_any_force(const FitBesideNoise& fit, EndOfSearch end,
                                               const Jackknife& beside_law) {
  constexpr int kRounds = 4;
  constexpr double kTimes = 10, kStays = 0.1;  // of the force; of half an interval
  const std::size_t count = fit.residuals.plant_unknowns();
  if (fit.setup.sensors.size() <= fit.setup.dampers()) return {};

  // As if forces were anything.
  NoiseSources sources = fit.sources;
  sources.force.front() = kTimes * fit.force;
  Look look = look_at(fit, std::move(end), fit.noise, std::move(sources));
  Jackknife told = told_by(look, fit.threads);
  if (!differs(told, beside_law, count)) return {};

  // Once more about where the numbers go, until they stay: sensitivities change with the plant, and
  // what the law lacked was taken for noise.
  const PlantCases cases = fit.cases;
  std::vector<double> x(fit.x.begin(), fit.x.end());
  const auto moved = [&] {
    std::vector<double> next = x;
    for (std::size_t k = 0; k < count; ++k)
      next[k] = std::clamp(x[k] + told.step()[k], fit.problem.lower[k], fit.problem.upper[k]);
    return next;
  };
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<double> next = moved();
    bool stays = round > 0;
    for (std::size_t k = 0; k < count; ++k)
      stays = stays && std::abs(next[k] - x[k]) < kStays * told.half(k, kOne);
    if (stays) break;
    find_noise_left(fit, told, look);
    std::optional<Look> there = look_about(fit, next, look.sources);
    if (!there) break;
    x = next;
    look = std::move(*there);
    told = told_by(look, fit.threads);
  }
  fit.cases = cases;

  std::vector<double> way = moved();
  way.resize(count);
  for (std::size_t k = 0; k < count; ++k) way[k] -= fit.x[k];
  return BesideAnyForce{std::move(way), std::move(told)};
}

std::pair<double, double> reach_to(double half, double way, double half_there) {
  return {std::max(half, half_there - way), std::max(half, half_there + way)};
}

std::vector<FittedParameter> numbers_beside_any_force(const BesideAnyForce& found,
                                                      const FitBesideNoise& fit) {
  std::vector<double> x(fit.x.begin(), fit.x.end());
  for (std::size_t k = 0; k < found.way.size(); ++k) x[k] += found.way[k];
  std::vector<FittedParameter> numbers;
  for (std::size_t k = 0; k < found.way.size(); ++k) {
    FittedParameter number = fit.residuals.described(k, x);
    const double half = found.told.half(k, kOne) * fit.residuals.size_at(k, x);
    number.low = number.value - half;
    number.high = number.value + half;
    numbers.push_back(std::move(number));
  }
  return numbers;
}

std::string told_beside_any_force(const BesideAnyForce& found, const FitBesideNoise& fit,
                                  const Jackknife& beside_law) {
  // Each number, and the one of whose interval the way makes most.
  std::vector<std::string> numbers;
  std::string furthest;
  double most = 0;
  for (const FittedParameter& number : numbers_beside_any_force(found, fit)) {
    const std::size_t k = numbers.size();
    numbers.push_back(number.name + " " + format_number(number.value, 4) + " " + number.unit +
                      " (" + format_number(number.low, 4) + " ... " +
                      format_number(number.high, 4) + ")");
    const double half = beside_law.half(k, kOne);
    const auto [below, above] = reach_to(half, found.way[k], found.told.half(k, kOne));
    if (const double share = 1 - 2 * half / (below + above); share > most) {
      most = share;
      furthest = number.name;
    }
  }
  std::string words =
      "this law seems not to be the damper's, or something stated of the plant not so (one sound "
      "fit in twenty is told this by chance): whatever the damper's force is, the sensors tell " +
      join(numbers, ", ") + "; the plant as found has these, and intervals reach to there";
  if (!furthest.empty())
    words += ", and " + format_number(100 * most, 2) + " % of that of " + furthest +
             " comes from what the law lacks";
  return words;
}

}  // namespace dashpot
