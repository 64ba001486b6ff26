#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "dashpot/base/random.h"
#include "dashpot/controller.h"

namespace dashpot {

/// Sensors and filters of all struts. Mutable: noise and memories are its own.
class Sensors {
 public:
  /// Throws Error on a delay, corner, noise or resolution that makes no sense.
  Sensors(const SensorOptions& options, std::size_t struts, double sample_time);

  /// One sample: the true signals become what the controller gets, in place.
  void measure(std::span<StrutSignals> signals);
  bool ideal() const { return !options_.in_car; }
  /// Coefficients of the filters: how much of the body's velocity stays from sample to sample, and
  /// how much of a new difference the deflection's velocity takes over.
  double keep() const { return keep_; }
  double share() const { return share_; }

 private:
  struct Memory {
    double body[2] = {}, deflection[2] = {};  ///< what their filters keep
    bool started = false;
    std::vector<StrutSignals> waiting;  ///< a ring of what the delay holds back
  };
  StrutSignals delayed(Memory& memory, const StrutSignals& now);
  void measure(Memory& memory, StrutSignals& signals);

  SensorOptions options_;
  double dt_, keep_ = 0, share_ = 0;
  std::size_t delay_, place_ = 0;
  std::vector<Memory> memories_;
  Random random_;
};

}  // namespace dashpot
