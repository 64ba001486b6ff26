#pragma once
#include <span>
#include <vector>

#include "dashpot/suspension/integrator.h"
#include "dashpot/suspension/simulate.h"

namespace dashpot {

/// Writes what a plant does, sample by sample, into the channels of a Trace.
class TraceWriter {
 public:
  TraceWriter(const Plant& plant, const PlantForces& forces, const GroundMotion& ground, std::size_t samples);
  void write(const PlantState& state);
  Record take() { return std::move(record_); }

 private:
  void add(double value) { record_.channels[place_++].samples.push_back(value); }

  const Plant& plant_;
  const PlantForces& forces_;
  const GroundMotion& ground_;
  Record record_;
  std::vector<double> acceleration_;
  std::size_t place_ = 0;
};

}  // namespace dashpot
