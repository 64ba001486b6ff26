#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "dashpot/damper/bench_test.h"
#include "dashpot/damper_model.h"
#include "dashpot/dataset.h"
#include "dashpot/drive.h"

namespace dashpot {

/// A test bench that exists only in the computer: a damper with known parameters, driven through a
/// matrix of sines and constant currents, and sensors as imperfect as real ones.
struct BenchOptions {
  std::vector<SineMotion> motions = {{0.025, 0.25}, {0.025, 0.5}, {0.005, 3}, {0.002, 5}};
  std::vector<double> drive_levels = {0, 0.25, 0.5, 0.75, 1};  ///< A or V
  double sample_rate = 500;                                    ///< Hz
  double cycles = 4;                 ///< recorded per test, at least one second
  double force_noise = 0.01;         ///< standard deviation, share of the record's force span
  double displacement_noise = 2e-6;  ///< m, standard deviation
  bool velocity_sensor = false;      ///< the velocity is recorded; else derived from displacement
  double velocity_noise = 0;         ///< m/s, standard deviation of that sensor
  double force_resolution = 1.0;     ///< N per count of the load cell's converter
  double displacement_resolution = 1e-6;  ///< m per count
  double force_offset = 30;  ///< N, standard deviation of the zero from record to record
  std::uint64_t seed = 1;
};

/// The motions of the options, without a drive yet. Throws Error on one that cannot be sampled.
std::vector<BenchTest> bench_sines(const BenchOptions& options);

/// The campaign as a dataset: channels displacement, force and drive, velocity derived as from a
/// real recording unless there is a sensor. Conditions, drive levels and the true offsets (in the
/// notes) are filled in.
Dataset run_virtual_bench(const DamperModel& damper, DriveUnit drive_unit,
                          const BenchOptions& options);
/// The same for any tests: of the options, those of the matrix do not count.
Dataset run_virtual_bench(const DamperModel& damper, DriveUnit drive_unit,
                          std::span<const BenchTest> tests, const BenchOptions& options);

}  // namespace dashpot
