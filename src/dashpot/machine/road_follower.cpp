#include "dashpot/machine/road_follower.h"

#include <algorithm>
#include <cmath>

#include "dashpot/error.h"
#include "dashpot/machine/between_samples.h"

namespace dashpot {

std::vector<PlantRecording> with_followers(const InPlantSetup& setup,
                                           const std::vector<PlantRecording>& recordings,
                                           double longest) {
  std::vector<PlantRecording> all = recordings;
  for (PlantRecording& one : all) {
    std::size_t unknown = 0;
    for (const PlantInputChannel& input : setup.inputs) {
      if (input.follows.empty()) continue;
      Channel later = one.channel(input.follows);
      later.name = input.channel;
      later.origin = input.follows + ", later";
      later.samples = delayed(later.samples, one.sample_time, input.later);
      one.channels.push_back(std::move(later));

      // Until what the front met first is met, and known between samples.
      const auto behind =
          static_cast<std::size_t>(std::ceil(std::max(input.later, longest) / one.sample_time));
      unknown = std::max(unknown, behind + kSamplesAround);
    }
    if (unknown >= one.samples)
      throw Error(one.name, "is over before the rear has met the road that the front has shown",
                  "a longer recording");
    one.samples -= unknown;
    for (Channel& channel : one.channels)
      channel.samples.erase(channel.samples.begin(),
                            channel.samples.begin() + static_cast<std::ptrdiff_t>(unknown));
  }
  return all;
}

}  // namespace dashpot
