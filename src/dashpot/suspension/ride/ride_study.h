#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "dashpot/suspension/ride/gain_curves.h"
#include "dashpot/suspension/ride/ride_bound.h"
#include "dashpot/suspension/ride/simulated_run.h"

namespace dashpot {

/// Several controllers in one vehicle, in frequency and in time.
struct RideStudyOptions {
  VehicleWords vehicle;                                   ///< its own controller is not looked at
  std::vector<std::string> controllers;                   ///< words; "all": every law that suits it
  std::string against;                                    ///< as passive_words() has it
  std::vector<double> frequencies = usual_frequencies();  ///< Hz
  GainOptions gains;  ///< its tolerance and monitor are those of the study
  std::string road = "iso8608,class=C";
  double road_duration = 30;  ///< s
  double step_height = 0.03;  ///< m
  std::size_t held = 12;      ///< currents of the same dampers without control, for the trade-off
  bool bound = false;         ///< also what is possible on the road: a quarter car's
  double allowed_outside = 0.05;  ///< share of the time that a damper may be outside its data
  double relative_tolerance = 1e-6;
  std::uint64_t seed = 1;
  int threads = 0;
  Monitor monitor;
};

/// The runs of one vehicle of a study.
struct RiddenVehicle {
  std::vector<GainPoint> sines;  ///< one per frequency
  std::vector<GainPoint> chirp;  ///< over the same range, finely
  SimulatedRun road, step;
  /// Whether the bounds, where there are any, speak of its ride on the road: its damper's forces
  /// lie in their range. Another damper's need not, nor those of the same damper at a current at
  /// which it has another force at rest, since the springs bear that from the start.
  bool in_range = true;
  const std::string& name() const { return road.name; }
};

/// Comfort and road holding of one setting on the road.
struct TradeOff {
  double setting = 0;             ///< A (or V, or place from 0 to 1), held
  double weighted = 0, tyre = 0;  ///< a_w m/s^2; dynamic over static tyre load, rms, %
};

struct RideStudy {
  RideStudyOptions options;
  std::string ground;  ///< the road's description
  RiddenVehicle passive;
  std::vector<RiddenVehicle> controlled;
  std::vector<TradeOff> held;         ///< the same dampers, softest first
  std::vector<std::string> left_out;  ///< of "all", and why
  /// Bounds on the road, where they were asked for: from comfort alone to road holding
  /// alone.
  std::vector<ClairvoyantBound> front;
  StrutMotion bounded;  ///< the bounds hold for rides that stay within; infinite: for all rides
  const Plant& plant() const { return passive.road.vehicle->set.plant; }
};

/// Throws Error where the plant has no tyres, where its dampers cannot be driven, at unknown words,
/// where a bound is asked for and none is known.
RideStudy study_ride(const RideStudyOptions& options);

/// sqrt of the integral of the squared fundamental gains by sines over frequency.
double comfort_integral(const RiddenVehicle& ridden);
double holding_integral(const RiddenVehicle& ridden);

}  // namespace dashpot
