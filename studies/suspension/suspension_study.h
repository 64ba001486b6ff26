#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/monitor.h"
#include "dashpot/suspension/ride/gain_curves.h"
#include "dashpot/suspension/ride/ride_bound.h"
#include "dashpot/vehicle.h"
#include "studies/suspension/study_dampers.h"

// The one-sensor paper's last section: its quarter car with the identified damper and Mix-1-sensor
// control.
namespace dashpot {

/// A suspension of the study: a damper with what drives it, in the paper's car.
struct SuspensionScheme {
  std::string key, title;
  Vehicle vehicle;
  bool within_range = false;  ///< its damper is the identified one: the bounds below hold for it
};

/// How a scheme rides.
struct SchemeRide {
  std::vector<GainPoint> large, small;  ///< on chirps of 2 cm, the paper's, and of 2 mm
  double contact_lost = 0,
         too_fast = 0;  ///< shares of the 2 cm chirp: tyre pulls; damper beyond its data
  Trace step;
  StepMeasures comfort,
      holding;  ///< of body acceleration, m/s^2, and tyre deflection, m, after the step
  RideSquares on_step, on_road;
};

/// Mix-1-sensor on ideal dampers whose least damping is this.
struct LeastDamping {
  double least = 0;       ///< N*s/m
  double wheel_gain = 0;  ///< greatest gain of the tyre's deflection
  double body_gain = 0;   ///< greatest gain of the body's acceleration up to 2 Hz, 1/s^2
  RideSquares on_step, on_road;
};

struct SuspensionStudyOptions {
  std::uint64_t seed = 1;
  int threads = 0;
  double road_duration = 10;  ///< s
  double step_duration = 3;   ///< s
  Monitor monitor;
};

struct SuspensionStudy {
  SuspensionStudyOptions options;
  std::string road;  ///< its description
  Plant plant;
  NetworkDamper damper, passive;
  double crossover = 0;                              ///< Hz, of Mix-1-sensor
  ControlLimits limits;                              ///< of the identified damper
  double least_possible = 0, greatest_possible = 0;  ///< N*s/m: any damper, for the paper's claims
  std::vector<SuspensionScheme> schemes;             ///< the passive reference first
  std::vector<SchemeRide> rides;
  std::vector<LeastDamping> least_damping;
  std::vector<ClairvoyantBound> road_front;  ///< comfort alone first, road holding alone last
  std::vector<ClairvoyantBound> step_front;
  std::vector<ClairvoyantBound> any_damper;  ///< on the step, of any damping that can be

  std::size_t place(const std::string& key) const;  ///< of a scheme; it must be known
};

/// Identifies the dampers, drives every scheme over chirp, step and road, sweeps the least damping,
/// bounds what is possible. The same bits on any number of threads.
SuspensionStudy study_suspension(const SuspensionStudyOptions& options);

/// Greatest fundamental gain between two frequencies, Hz.
double greatest_gain(const std::vector<GainPoint>& gains, Gain GainPoint::* signal, double from,
                     double to);
/// Damping of a linear damper, N*s/m, whose greatest gain of the tyre's deflection is this.
double damping_for_wheel_gain(const Plant& plant, double gain);

}  // namespace dashpot
