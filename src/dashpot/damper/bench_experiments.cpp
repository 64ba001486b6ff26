#include "dashpot/damper/bench_experiments.h"

#include <array>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr std::string_view kAll = "one-sensor";
constexpr std::uint64_t kSecondSeed = 1000;  // further than the number of experiments

// Each constant of SC sees the whole motion. In experiment 4 the frequencies are high and the
// amplitudes low, as the paper says of it.
constexpr std::array kExperiments{
    BenchExperiment{.name = "one-sensor-1",
                    .title = "triangles of variable slope, stepped constants",
                    .continuous = {"TPNVS,repeats=10", "SC,levels=10"},
                    .switched = {"TPNVS,repeats=2", "SC,levels=2"},
                    .second = "speed_min=0.06,speed_max=0.9"},
    BenchExperiment{.name = "one-sensor-2",
                    .title = "stepped frequencies, stepped constants",
                    .continuous = {"SFS,repeats=10", "SC,levels=10"},
                    .switched = {"SFS,repeats=2", "SC,levels=2"},
                    .second = "frequency_min=1,frequency_max=14"},
    BenchExperiment{.name = "one-sensor-3",
                    .title = "rough way, transient current",
                    .continuous = {"RP", "ICPS"},
                    .switched = {"RP", "PRBS"}},
    BenchExperiment{.name = "one-sensor-4",
                    .title = "amplitude modulation, transient current",
                    .continuous = {"AM,carrier=12,amplitude=3mm", "ICPS"},
                    .switched = {"AM,carrier=12,amplitude=3mm", "PRBS"},
                    .second = "modulation=0.13"},
    BenchExperiment{.name = "one-sensor-5",
                    .title = "frequency modulation, transient current",
                    .continuous = {"FM", "ICPS"},
                    .switched = {"FM", "PRBS"},
                    .second = "modulation=0.07"},
};

BenchTest test_of(std::size_t k, const ParameterSet& damper, std::uint64_t seed,
                  Recording recording) {
  const bool switched = !damper.drive_levels.empty(), second = recording == Recording::Second;
  const BenchExperiment& experiment = kExperiments[k];
  const Excitation& excitation = switched ? experiment.switched : experiment.continuous;
  DriveFrame frame{.low = damper.drive_min, .high = damper.drive_max};
  if (switched) frame = {.low = damper.drive_levels.front(), .high = damper.drive_levels.back()};
  if (second) seed += kSecondSeed;
  frame.seed = seed + k;  // no two experiments have the same current
  std::string motion(excitation.motion);
  if (second && !experiment.second.empty()) motion.append(",").append(experiment.second);
  if (second && excitation.drive.starts_with("SC")) std::swap(frame.low, frame.high);
  return under_sequence(sequence_test(motion, seed), std::string(excitation.drive), frame);
}

}  // namespace

std::span<const BenchExperiment> bench_experiments() { return kExperiments; }

std::vector<std::string> experiment_names() {
  std::vector<std::string> names{std::string(kAll)};
  for (const BenchExperiment& experiment : kExperiments) names.emplace_back(experiment.name);
  return names;
}

std::vector<BenchTest> experiment_tests(const std::string& name, const ParameterSet& damper,
                                        std::uint64_t seed, Recording recording) {
  std::vector<BenchTest> tests;
  for (std::size_t k = 0; k < kExperiments.size(); ++k)
    if (name == kAll || name == kExperiments[k].name)
      tests.push_back(test_of(k, damper, seed, recording));
  if (tests.empty())
    throw Error("", "unknown experiment '" + name + "'", suggest(name, experiment_names()));
  return tests;
}

BenchOptions one_sensor_bench(BenchOptions options) {
  options.sample_rate = 1650;
  options.velocity_sensor = true;
  options.velocity_noise = 5e-3;
  options.displacement_noise = 20e-6;
  options.displacement_resolution = 4e-6;  // 254 mm in 16 bits
  return options;
}

}  // namespace dashpot
