#pragma once
#include "dashpot/suspension/lanes/ride.h"
#include "dashpot/suspension/lanes/simd/lane_math.h"

namespace dashpot {
namespace {

/// Sums and greatest values of a ride, from its samples: the rows of LaneResult, and those of each
/// strut and tyre. Values are added in the lanes that `counts` marks.
template <std::size_t kMostStruts, std::size_t kMostTyres>
class Tally {
 public:
  explicit Tally(const LaneRide& ride) : ride_(ride) {}

  /// Acceleration of the body, m/s^2. The weighting filter runs in all of `which`, from the start
  /// of the ride on.
  void add_body(Lane acceleration, LaneMask which, LaneMask counts) {
    const Lane weighted = weigh(acceleration, which);
    put(kAcceleration2, acceleration * acceleration, counts);
    put(kWeighted2, weighted * weighted, counts);
    put(kWeighted4, weighted * weighted * weighted * weighted, counts);
  }
  /// Deflection m of a strut, power W and current A of its damper.
  void add_strut(std::size_t strut, Lane deflection, Lane power, Lane current, LaneMask counts) {
    Lane(&own)[kLaneStrutResults] = struts_[strut];
    own[kDeflection2] += counts ? deflection * deflection : Lane{};
    Lane& greatest = own[kGreatestDeflection];
    greatest = counts ? fmax(fabs(deflection), greatest) : greatest;
    put(kPower, power, counts);
    put(kCurrentSum, current, counts);
  }
  /// Load N, the same at rest, and deflection m of a tyre.
  void add_tyre(std::size_t tyre, Lane load, Lane at_rest, Lane deflection, LaneMask counts) {
    const Lane more = load - at_rest;
    Lane(&own)[kLaneTyreResults] = tyres_[tyre];
    own[kLoad2] += counts ? more * more : Lane{};
    own[kTyreDeflection2] += counts ? deflection * deflection : Lane{};
  }
  /// Whether some tyre has no load.
  void add_lost_contact(LaneMask lost, LaneMask counts) {
    put(kContactLost, lost ? all(1) : Lane{}, counts);
  }

  Lane& row(LaneResult row) { return sums_[row]; }
  void store_all(std::size_t struts, std::size_t tyres) const {
    double* at = ride_.results;
    const auto put_down = [&](Lane value) {
      store(at, value);
      at += kWidth;
    };
    for (const Lane sum : sums_) put_down(sum);
    for (std::size_t s = 0; s < struts; ++s)
      for (const Lane sum : struts_[s]) put_down(sum);
    for (std::size_t w = 0; w < tyres; ++w)
      for (const Lane sum : tyres_[w]) put_down(sum);
  }

 private:
  void put(LaneResult row, Lane value, LaneMask counts) { sums_[row] += counts ? value : Lane{}; }
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
  Lane sums_[kLaneResults]{};
  Lane struts_[kMostStruts][kLaneStrutResults]{}, tyres_[kMostTyres][kLaneTyreResults]{};
  Lane memory_[kWeightingSections][2]{};
};

}  // namespace
}  // namespace dashpot
