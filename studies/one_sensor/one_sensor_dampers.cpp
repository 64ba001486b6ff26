// The dampers of the one-sensor study: the paper's two as virtual ones, and any that was measured.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>

#include "dashpot/damper/bench_experiments.h"
#include "studies/one_sensor/one_sensor_study.h"

namespace dashpot {
namespace {

constexpr std::size_t kExampleExperiment = 1;  // of the paper's tables 3 to 5: its experiment 2

std::vector<Record> record_experiments(const ParameterSet& damper, std::uint64_t seed,
                                       Recording recording) {
  const bool second = recording == Recording::Second;
  BenchOptions bench = one_sensor_bench({});
  bench.seed = 2 * seed + (second ? 1 : 0);  // other noise and another zero of the load cell
  Dataset dataset =
      run_virtual_bench(damper.model, damper.model.drive_unit(),
                        experiment_tests("one-sensor", damper, seed, recording), bench);
  for (Record& record : dataset.records)
    record.name += second ? ", second recording" : ", first recording";
  return std::move(dataset.records);
}

StudiedDamper virtual_damper(const std::string& name, std::uint64_t seed) {
  const ParameterSet set = load_parameter_set(name);

  // Name, description and drive from its parameter set.
  StudiedDamper damper;
  damper.name = name;
  std::ranges::transform(damper.name, damper.name.begin(),
                         [](unsigned char c) { return std::toupper(c); });
  damper.description = set.damper;
  damper.is_virtual = true;
  damper.drive_unit = set.model.drive_unit();

  // Each experiment is a fold: learn from its first recording, judge on its second.
  std::vector<Record> first = record_experiments(set, seed, Recording::First),
                      second = record_experiments(set, seed, Recording::Second);
  for (std::size_t k = 0; k < first.size(); ++k) {
    Fold fold{.name = "experiment " + std::to_string(k + 1), .training = {}, .left_out = {}};
    fold.training.push_back(std::move(first[k]));
    fold.left_out.push_back(std::move(second[k]));
    damper.experiments.push_back(std::move(fold));
  }
  return damper;
}

}  // namespace

double StudiedDamper::half_span() const {
  double low = INFINITY, high = -INFINITY;
  for (const Fold& fold : experiments)
    for (const Record& record : fold.left_out) {
      const std::vector<double>& force = record.channel("force").samples;
      const auto [least, greatest] = std::minmax_element(
          force.begin() + static_cast<std::ptrdiff_t>(record.warm_up), force.end());
      low = std::min(low, *least);
      high = std::max(high, *greatest);
    }
  return (high - low) / 2;
}

bool StudiedDamper::has_displacement() const {
  const auto measured = [](const Record& record) { return record.find("displacement") != nullptr; };
  return std::ranges::all_of(experiments, [&](const Fold& fold) {
    return std::ranges::all_of(fold.training, measured) &&
           std::ranges::all_of(fold.left_out, measured);
  });
}

std::vector<StudiedDamper> virtual_dampers(std::uint64_t seed) {
  std::vector<StudiedDamper> dampers{virtual_damper("mr1", seed), virtual_damper("mr2", seed)};
  dampers.front().example = {kExampleExperiment};
  return dampers;
}

StudiedDamper measured_damper(const Dataset& dataset, const LeaveOut& leave_out) {
  StudiedDamper damper;
  damper.name = dataset.name;
  damper.description = dataset.citation;
  damper.drive_unit = dataset.drive_unit;
  damper.experiments = split(dataset, leave_out);
  damper.example.resize(damper.experiments.size());
  std::iota(damper.example.begin(), damper.example.end(), std::size_t{0});
  return damper;
}

}  // namespace dashpot
