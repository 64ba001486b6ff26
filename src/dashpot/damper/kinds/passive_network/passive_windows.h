#pragma once
#include <cstddef>

#include "dashpot/damper/nets/kernel.h"

namespace dashpot {

/// How large a passive network is.
struct PassiveSizes {
  std::size_t springs = 0, memories = 0, neurons = 0, viscous_neurons = 0;

  std::size_t seen() const noexcept { return 3 + memories; }            ///< v, x, q, memories
  std::size_t inputs() const noexcept { return seen() + springs + 1; }  ///< and springs, 1
};

/// Where the numbers of a passive network stand in the flat array that is trained; each part is
/// laid out as c_text/passive_cell.h has it.
struct PassiveLayout {
  explicit PassiveLayout(const PassiveSizes& sizes);

  std::size_t weights, gates, viscous_weights, viscous;  ///< of networks, of any sign
  std::size_t levers, stiffness, memory_rates, saturation, potential, drive_rate, inertia,
      inertia_rate;  ///< positive
  std::size_t count;

  std::size_t first_positive() const noexcept { return levers; }
};

/// Windows of recordings side by side, one per lane, on which a passive network runs freely from
/// rest and is differentiated backwards through time. Signals are standardised; arrays over time
/// hold `lanes` numbers per sample.
struct PassiveWindows {
  PassiveSizes sizes;
  bool lags = false, inert = false;
  const float* numbers;  ///< by PassiveLayout
  float step;            ///< s
  std::size_t samples;
  const float *displacement, *velocity, *drive, *force;
  const float* weight;   ///< of a sample's squared error
  const float* reading;  ///< share of the drive that networks read, one per lane
  float drive_middle;    ///< about which they do
  const float* offsets;  ///< of the windows' forces, one per lane
  float* forces;         ///< is filled: what the network says
  float* gradient;       ///< of the sum of weighted squares, is added to; null: not asked for
  float* offset_gradient;
  float* room;  ///< room_for() numbers, kKernelAlign aligned
};

/// The passes, compiled for one instruction set.
struct PassiveKernel {
  std::size_t lanes;  ///< windows at once
  std::size_t (*room_for)(const PassiveSizes& sizes, std::size_t samples) noexcept;
  /// The sum of weighted squared errors.
  double (*run)(const PassiveWindows& windows) noexcept;
};
/// The kernel for a level in simd_levels().
const PassiveKernel& passive_kernel(SimdLevel level);

}  // namespace dashpot
