#pragma once
#include "dashpot/suspension/lanes/ride.h"
#include "dashpot/suspension/lanes/simd/lane_math.h"

namespace dashpot {
namespace {

/// Sums and greatest values of a ride, from its samples: the rows of LaneResult.
class Tally {
 public:
  /// load_at_rest: N, of the tyre.
  Tally(const LaneRide& ride, Lane load_at_rest) : ride_(ride), load_at_rest_(load_at_rest) {}

  /// acceleration of the body m/s^2, load of the tyre N, deflections m, speed m/s and force N of
  /// the damper, current A.
  struct Sample {
    Lane acceleration, load, tyre_deflection, deflection, speed, force, current;
  };

  /// Adds a sample in the lanes that `counts` marks among `which`. The weighting filter runs in all
  /// of `which`, from the start of the ride on.
  void add(const Sample& s, LaneMask which, LaneMask counts) {
    const Lane weighted = weigh(s.acceleration, which);

    counts &= which;
    const auto put = [&](LaneResult row, Lane value) { sums_[row] += counts ? value : Lane{}; };
    const Lane more = s.load - load_at_rest_;
    put(kAcceleration2, s.acceleration * s.acceleration);
    put(kWeighted2, weighted * weighted);
    put(kWeighted4, weighted * weighted * weighted * weighted);
    put(kLoad2, more * more);
    put(kTyreDeflection2, s.tyre_deflection * s.tyre_deflection);
    put(kDeflection2, s.deflection * s.deflection);
    put(kContactLost, s.load <= 0 ? all(1) : Lane{});
    put(kPower, s.force * s.speed);
    put(kCurrentSum, s.current);
    Lane& greatest = sums_[kGreatestDeflection];
    greatest = counts ? fmax(fabs(s.deflection), greatest) : greatest;
  }
  Lane& row(LaneResult row) { return sums_[row]; }
  void store_all() const {
    for (std::size_t k = 0; k < kLaneResults; ++k) store(ride_.results + k * kWidth, sums_[k]);
  }

 private:
  /// The weighting's sections one after the other, each in the transposed direct form II:
  /// out = b0 in + s0,  s0 = b1 in - a1 out + s1,  s1 = b2 in - a2 out.
  Lane weigh(Lane in, LaneMask which) {
    const double* b = ride_.weighting;
    for (Lane(&s)[2] : memory_) {
      const Lane out = b[0] * in + s[0];
      s[0] = which ? b[1] * in - b[3] * out + s[1] : s[0];
      s[1] = which ? b[2] * in - b[4] * out : s[1];
      in = out;
      b += 5;
    }
    return in;
  }

  const LaneRide& ride_;
  Lane load_at_rest_;
  Lane sums_[kLaneResults]{};
  Lane memory_[kWeightingSections][2]{};
};

}  // namespace
}  // namespace dashpot
