#include "dashpot/machine/virtual_recording.h"

#include "dashpot/base/random.h"

namespace dashpot {

PlantRecording virtual_recording(const Record& trace, const std::vector<VirtualSensor>& sensors,
                                 std::uint64_t seed) {
  PlantRecording recording{.name = trace.name,
                           .sample_time = (trace.time.back() - trace.time.front()) /
                                          static_cast<double>(trace.size() - 1),
                           .samples = trace.size(),
                           .channels = {}};
  Random random(seed);
  for (const VirtualSensor& sensor : sensors) {
    Channel channel = trace.channel(sensor.channel);
    for (double& sample : channel.samples) sample += sensor.noise * random.normal();
    recording.channels.push_back(std::move(channel));
  }
  return recording;
}

}  // namespace dashpot
