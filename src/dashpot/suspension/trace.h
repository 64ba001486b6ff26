#pragma once
#include <span>
#include <vector>

#include "dashpot/ground_motion.h"
#include "dashpot/plant.h"
#include "dashpot/record.h"
#include "dashpot/suspension/steps/step_method.h"

namespace dashpot {

/// Writes what a plant does, sample by sample, into the channels of a record.
class TraceWriter {
 public:
  TraceWriter(const Plant& plant, const PlantForces& forces, const GroundMotion& ground,
              std::size_t samples);
  /// road: under the plant's tyres, at the state's instant.
  void write(const PlantState& state, std::span<const FootMotion> road);
  Record take() { return std::move(record_); }

 private:
  void add(double value) { record_.channels[place_++].samples.push_back(value); }

  const Plant& plant_;
  const PlantForces& forces_;
  const GroundMotion& ground_;
  Record record_;
  std::size_t place_ = 0;
};

/// Shares of the samples from `first` on: in which some tyre has no load or pulls; in which some
/// stop is met.
double contact_lost(const Record& trace, const Plant& plant, std::size_t first);
double stops_met(const Record& trace, const Plant& plant, std::size_t first);

}  // namespace dashpot
