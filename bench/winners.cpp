// Prints the tables "Is the best on inner folds the best outside?" and, with --few, "Named from two
// records" of docs/accuracy.md.
//
//   bench_winners [--models A,B,...] [--epochs N] [--few N [--draws N]] [TRUTH ...]
//
// Dampers whose truth is known and of other structure than the models (studies/ride_rank) are
// recorded on the virtual bench, with noise and drift, and with what the six here add: a driver
// that lags, a sensor that lags. The models are ranked by motions of these recordings left out in
// turn; then each is judged on what no ranking has seen: other motions, other currents, a current
// that switches. --epochs: updates of the passive network's training, 1 600 unless told.
// --few: so many of the twelve records at random, four times unless --draws says otherwise, and
// judged on the rest of them as well.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "dashpot/base/random.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/virtual_bench.h"
#include "dashpot/error.h"
#include "dashpot/evaluate.h"
#include "dashpot/rank.h"
#include "dashpot/suspension/sweep/statistics.h"
#include "studies/ride_rank/true_dampers.h"

using namespace dashpot;

namespace {

constexpr double kCurrentMax = 2;  // A

/// A truth, and how it is measured.
struct Case {
  std::string_view truth;
  double force_noise;     ///< share of the force span
  double force_drift;     ///< N, from record to record
  double sensor_lag = 0;  ///< s, of the force channel
};
constexpr std::array kCases{Case{"series_spring", 0.01, 30}, Case{"asymmetric_valves", 0.01, 30},
                            Case{"sticky_seals", 0.005, 30}, Case{"slow_coil", 0.02, 30},
                            Case{"fading", 0.01, 100},       Case{"bypass", 0.01, 30, 0.005}};

BenchOptions bench_of(const Case& one, std::uint64_t seed) {
  return {.sample_rate = 100,
          .cycles = 2,
          .force_noise = one.force_noise,
          .force_offset = one.force_drift,
          .seed = seed};
}

/// The sensor's first-order lag, s, on every force.
Dataset lagged(Dataset dataset, double lag) {
  if (lag <= 0) return dataset;
  for (Record& record : dataset.records)
    for (Channel& channel : record.channels) {
      if (channel.name != "force") continue;
      for (std::size_t k = 1; k < channel.samples.size(); ++k) {
        const double kept = std::exp(-(record.time[k] - record.time[k - 1]) / lag);
        channel.samples[k] += (channel.samples[k - 1] - channel.samples[k]) * kept;
      }
    }
  return dataset;
}

void add_sines(std::vector<BenchTest>& tests, const BenchOptions& bench,
               const std::vector<double>& levels) {
  for (const BenchTest& sine : bench_sines(bench))
    for (const double level : levels) tests.push_back(at_level(sine, level, DriveUnit::Ampere));
}

/// What a workshop records: sines from slow and long to quick and short at three currents.
Dataset recorded(const DamperModel& truth, const Case& one) {
  BenchOptions bench = bench_of(one, 1);
  bench.motions = {{0.025, 0.5}, {0.02, 3}, {0.008, 2}, {0.003, 8}};
  std::vector<BenchTest> tests;
  add_sines(tests, bench, {0, kCurrentMax / 2, kCurrentMax});
  return lagged(run_virtual_bench(truth, DriveUnit::Ampere, tests, bench), one.sensor_lag);
}

/// What comes afterwards: sines between and beyond those, at other currents, and a sweep under a
/// current that switches. Without noise and lag of the sensor: the truth.
Dataset outside(const DamperModel& truth, const Case& one) {
  BenchOptions bench = bench_of(one, 2);
  bench.force_noise = 0;
  bench.motions = {{0.022, 1}, {0.012, 4}, {0.005, 6}, {0.001, 9}};
  std::vector<BenchTest> tests;
  add_sines(tests, bench, {0.4, 1.5});
  tests.push_back(under_sequence(
      sequence_test("FM,amplitude=10mm,speed_max=0.5,duration=8,modulation=0.1", bench.seed),
      "PRBS", {.low = 0, .high = kCurrentMax, .duration = 8, .seed = bench.seed}));
  return run_virtual_bench(truth, DriveUnit::Ampere, tests, bench);
}

struct Row {
  std::string model;
  double inside, outside;  ///< ESR, %
};

/// The models in the order of their ranking, those that may be called best, with both errors.
std::vector<Row> judged(const Ranking& ranking, const Dataset& outside) {
  std::vector<Row> rows;
  for (const RankedModel& model : ranking.models) {
    if (!is_recommendable(model)) continue;
    const Evaluation there = evaluate(*model.fit.model, outside.records, outside.drive_unit);
    rows.push_back({model.name, model.left_out.pooled.esr, there.pooled.esr});
  }
  return rows;
}

/// One line of the table.
void print_case(const Case& one, const std::vector<Row>& rows) {
  std::vector<double> inside, outside;
  for (const Row& row : rows) {
    inside.push_back(row.inside);
    outside.push_back(row.outside);
  }
  const Row& best = *std::ranges::min_element(rows, {}, &Row::outside);
  fmt::print("| {} | `{}` | {} | {} | `{}` | {} | {} | {} |\n", one.truth, rows.front().model,
             format_number(rows.front().inside, 2), format_number(rows.front().outside, 2),
             best.model, format_number(best.outside, 2),
             format_number(rows.front().outside / best.outside, 3),
             format_number(rank_correlation(inside, outside).value_or(NAN), 2));
  std::fflush(stdout);
}

/// What a rule names, as a multiple of the least error that any of the models has there: the
/// logarithms, summed over all draws.
struct Regret {
  double rest = 0, outside = 0;
  void add(double to_best_rest, double to_best_outside) {
    // One that runs away counts as a thousandfold.
    rest += std::log(std::min(to_best_rest, 1000.0));
    outside += std::log(std::min(to_best_outside, 1000.0));
  }
};

/// The records of a set in an order by chance: the first few of them, and the rest.
std::pair<Dataset, Dataset> drawn(Dataset all, std::size_t few, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t k = all.records.size(); k > 1; --k)
    std::swap(all.records[k - 1], all.records[random.index(k)]);
  Dataset rest = all;
  const auto end_of_few = static_cast<std::ptrdiff_t>(few);
  all.records.erase(all.records.begin() + end_of_few, all.records.end());
  rest.records.erase(rest.records.begin(), rest.records.begin() + end_of_few);
  return {all, rest};
}

/// One line of the second table: what is named by few records, and what another rule would.
void print_few(const Case& one, const DamperModel& truth, const std::vector<std::string>& models,
               const IdentifyOptions& options, std::size_t few, std::size_t draws) {
  const Dataset all = recorded(truth, one), there = outside(truth, one);
  Regret first, passive;
  for (std::size_t draw = 0; draw < draws; ++draw) {
    const auto [inside, rest] = drawn(all, few, 100 * few + draw);
    const Ranking ranking = rank(models, inside, default_leave_out(inside), options);

    // What each model leaves of the rest, and of what came afterwards.
    std::vector<double> of_rest, of_there;
    for (const RankedModel& model : ranking.models) {
      if (!is_recommendable(model)) break;
      of_rest.push_back(evaluate(*model.fit.model, rest.records, rest.drive_unit).pooled.esr);
      of_there.push_back(evaluate(*model.fit.model, there.records, there.drive_unit).pooled.esr);
    }
    if (of_rest.empty()) throw Error(std::string(one.truth), "no model may be named");

    // The passive network stands where it cannot be told from the first, else the first again.
    std::size_t passive_place = 0;
    for (const RankedModel* leader : ranking.leaders())
      if (leader->name == "passive_network")
        passive_place = static_cast<std::size_t>(leader - ranking.models.data());
    const double least_rest = std::ranges::min(of_rest), least_there = std::ranges::min(of_there);
    first.add(of_rest.front() / least_rest, of_there.front() / least_there);
    passive.add(of_rest[passive_place] / least_rest, of_there[passive_place] / least_there);
  }

  const auto mean = [&](double sum) {
    return format_number(std::exp(sum / static_cast<double>(draws)), 3);
  };
  fmt::print("| {} | {} | {} | {} | {} |\n", one.truth, mean(first.rest), mean(first.outside),
             mean(passive.rest), mean(passive.outside));
  std::fflush(stdout);
}

void print_details(const std::vector<Row>& rows) {
  for (const Row& row : rows)
    fmt::print(stderr, "  {:<24} inside {:>8} outside {:>8}\n", row.model,
               format_number(row.inside, 3), format_number(row.outside, 3));
}

int run(const std::vector<std::string>& arguments) {
  // The options, then the truths; all six unless some are named.
  std::size_t few = 0, draws = 4;
  std::vector<std::string> models = {"bingham",           "tanh_kwok",       "large_scale_bouc_wen",
                                     "modified_bouc_wen", "passive_network", "hysteresis_network"};
  std::vector<std::string> truths;
  IdentifyOptions options{.threads = 1};
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const bool has_value = k + 1 < arguments.size();
    if (arguments[k] == "--models" && has_value)
      models = split(arguments[++k], ',');
    else if (arguments[k] == "--epochs" && has_value)
      options.network.epochs = static_cast<std::size_t>(std::stoul(arguments[++k]));
    else if (arguments[k] == "--few" && has_value)
      few = std::stoul(arguments[++k]);
    else if (arguments[k] == "--draws" && has_value)
      draws = std::stoul(arguments[++k]);
    else
      truths.push_back(arguments[k]);
  }
  constexpr std::size_t kRecords = 12;  // of recorded()
  if (few >= kRecords || draws == 0)
    throw Error("--few, --draws", "nothing is left to judge", "fewer than 12, and one or more");
  for (const std::string& name : truths)
    if (std::ranges::find(kCases, name, &Case::truth) == kCases.end())
      throw Error(name, "is none of the dampers", "series_spring, asymmetric_valves, ...");

  if (few > 0)
    fmt::print(
        "| damper | first: the rest | first: afterwards | passive among equals: the rest | passive "
        "among equals: afterwards |\n|---|---:|---:|---:|---:|\n");
  else
    fmt::print(
        "| damper | named inside | ESR % inside | outside | best outside | ESR % | named / best | "
        "rank correlation |\n|---|---|---:|---:|---|---:|---:|---:|\n");

  for (const Case& one : kCases) {
    if (!truths.empty() && std::ranges::find(truths, one.truth) == truths.end()) continue;
    const auto truth =
        make_true_damper(*std::ranges::find(true_dampers(), one.truth, &TrueDamperParts::name));
    if (few > 0) {
      print_few(one, *truth, models, options, few, draws);
      continue;
    }
    const Dataset inside = recorded(*truth, one);
    const std::vector<Row> rows = judged(
        rank(models, inside, {.by = LeaveOut::By::Condition}, options), outside(*truth, one));
    if (rows.empty()) {
      fmt::print("| {} | none may be named | | | | | | |\n", one.truth);
      continue;
    }
    print_case(one, rows);
    print_details(rows);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_winners: {}\n", error.what());
    return 1;
  }
}
