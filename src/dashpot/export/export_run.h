#pragma once
#include <cstdint>
#include <vector>

#include "dashpot/damper_model.h"

namespace dashpot {

struct ExportRunOptions {
  std::uint64_t seed = 20;
  double fastest = 6;  ///< Hz, of the motion; the command changes half as fast
};

/// Motion and command within a domain at equal steps of `sample_time` s, along which exported
/// models are checked: sums of sines with random phases from a seed; the velocity is the slope of
/// the displacement.
std::vector<DamperInput> export_run(const Domain& domain, double sample_time, std::size_t count,
                                    const ExportRunOptions& options = {});

/// The model's force, N, along inputs (one at least) that lie `sample_time` s apart, from rest at
/// the first.
std::vector<double> force_along(const DamperModel& model, const std::vector<DamperInput>& inputs,
                                double sample_time);

}  // namespace dashpot
