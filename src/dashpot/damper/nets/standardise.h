#pragma once
#include <cstddef>
#include <utility>
#include <vector>

#include "dashpot/damper/nets/mlp.h"

namespace dashpot {

/// Mean and standard deviation of every `stride`-th value from `first` on; a constant has scale 1.
std::pair<double, double> mean_and_scale(const std::vector<double>& values, std::size_t first,
                                         std::size_t stride);
/// Sets the scales of the network's inputs and of its output to those of its training samples.
void standardise(Mlp& mlp, const TrainingSamples& samples);
/// without_weights(), its scales those of the samples.
Mlp untrained(std::size_t inputs, const std::vector<std::size_t>& hidden, Activation kind,
              const TrainingSamples& samples);

}  // namespace dashpot
