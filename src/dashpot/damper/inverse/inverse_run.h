#pragma once
#include <string>
#include <vector>

#include "dashpot/damper/bench_test.h"
#include "dashpot/damper/inverse/inverse.h"

namespace dashpot {

/// A damper's motion, current and force at equal steps of time: the examples that an inverse is
/// taught with.
struct InverseRun {
  std::string name;
  double sample_time = 1e-3;        ///< s
  std::vector<DamperInput> inputs;  ///< the current is the one in the coil
  std::vector<double> force;        ///< N, what a wish for this current would have been
  std::vector<double> weight;       ///< how much a sample counts; 0: not at all
  std::size_t size() const { return inputs.size(); }
};

/// The range of motion over which an inverse is taught or judged.
struct MotionRange {
  double amplitude = 0.02;  ///< m
  /// Hz, the highest of a random motion, whose standard deviation is half the amplitude.
  double frequency = 3;
  double speed() const;  ///< m/s, what such a motion hardly exceeds
};

/// Tests over the range and all currents: band-limited noise as Chang and Zhou used it, a road, a
/// chirp and strokes of constant speed, each under another random current.
std::vector<BenchTest> teaching_tests(const MotionRange& range, const InverseLimits& limits,
                                      std::uint64_t seed);

/// Runs the model along inputs at equal steps of limits.sample_time, without its coil's lag. Where
/// only its states feel the current, the force is the one at the Observer's horizon. A sample
/// weighs (dF/di)^2, so that an error of the current counts as the error of the force that it
/// makes: next to nothing where the motion turns. Throws Error when the model diverges.
InverseRun run_on_model(const DamperModel& forward, const std::string& name,
                        const std::vector<DamperInput>& inputs, const InverseLimits& limits);
/// The same along a test.
InverseRun run_on_model(const DamperModel& forward, const BenchTest& test,
                        const InverseLimits& limits);

}  // namespace dashpot
