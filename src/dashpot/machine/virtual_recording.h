#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "dashpot/machine/plant_recording.h"
#include "dashpot/record.h"

namespace dashpot {

/// A sensor in a simulated plant: a channel of its trace and the standard deviation of the white
/// noise that is put on it, SI.
struct VirtualSensor {
  std::string channel;
  double noise = 0;
};

/// What these sensors would have recorded of a simulation, whose trace is sampled uniformly: so
/// that an identification can be judged where the truth is known. The same seed gives the same
/// noise. Throws Error at a channel that the trace lacks.
PlantRecording virtual_recording(const Record& trace, const std::vector<VirtualSensor>& sensors,
                                 std::uint64_t seed);

}  // namespace dashpot
