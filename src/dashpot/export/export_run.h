#pragma once
#include <cstdint>
#include <vector>

#include "dashpot/damper_model.h"

namespace dashpot {

struct ExportRunOptions {
  std::uint64_t seed = 20;
  double fastest = 6;  ///< Hz, of the motion; the command changes half as fast
};

/// Motion and command within a domain at equal steps, from a seed: sums of sines of random phase,
/// the velocity that of the displacement. What exported models are checked along.
std::vector<DamperInput> export_run(const Domain& domain, double sample_time, std::size_t count,
                                    const ExportRunOptions& options = {});

/// The model's force along inputs at equal steps, from rest at the first.
std::vector<double> force_along(const DamperModel& model, const std::vector<DamperInput>& inputs,
                                double sample_time);

}  // namespace dashpot
