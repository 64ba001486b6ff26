#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/virtual_bench.h"

namespace dashpot {

/// Sequences of motion and drive for one kind of damper, as make_motion and make_drive read them.
struct Excitation {
  std::string_view motion, drive;
};

/// An experiment that is known by name.
struct BenchExperiment {
  std::string_view name, title;
  Excitation continuous, switched;  ///< for a damper that takes any current, or two levels only
  std::string_view second;          ///< what its second recording changes in the motion
};

/// An experiment can be recorded twice, to learn from one and to be judged by the other: the second
/// has other random numbers, frequencies and speeds between those of the first, and stepped
/// currents that fall where they rose. Both cover the same ranges.
enum class Recording { First, Second };

/// The five experiments of the one-sensor paper (its table 2).
std::span<const BenchExperiment> bench_experiments();
/// Their names, and "one-sensor" for all five.
std::vector<std::string> experiment_names();

/// The tests of an experiment over the damper's range, or at its outer two levels where it has
/// levels. Throws Error on an unknown name.
std::vector<BenchTest> experiment_tests(const std::string& name, const ParameterSet& damper,
                                        std::uint64_t seed, Recording recording = Recording::First);

/// The paper's rate of samples and its sensor of velocity and displacement, as imperfect as such
/// sensors are: the paper does not say. What else the options say stays.
BenchOptions one_sensor_bench(BenchOptions options);

}  // namespace dashpot
