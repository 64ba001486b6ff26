#pragma once
#include <cmath>
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
  double fastest = INFINITY;  ///< m/s, in the recordings of its damper
};

/// The ride of a scheme over chirp, step and road.
struct SchemeRide {
  std::vector<GainPoint> large, small;  ///< on chirps of 2 cm, the paper's, and of 2 mm
  double contact_lost = 0;  ///< share of the 2 cm chirp in which the tyre pulls at the road
  double too_fast = 0;      ///< share of it in which the damper is faster than on the bench
  Trace step;
  StepMeasures comfort, holding;  ///< of body acceleration, m/s^2; of tyre deflection, m
  double travel = 0;              ///< m, the damper's greatest after the step, signed
  RideSquares on_step, on_road;
};

/// The ride of Mix-1-sensor on ideal dampers of one least damping.
struct LeastDamping {
  double least = 0;       ///< N*s/m
  double wheel_gain = 0;  ///< greatest gain of the tyre's deflection
  double body_gain = 0;   ///< greatest gain of the body's acceleration up to 2 Hz, 1/s^2
  RideSquares on_step, on_road;
};

/// How the study is run.
struct SuspensionStudyOptions {
  std::uint64_t seed = 1;
  int threads = 0;
  double road_duration = 10;  ///< s
  double step_duration = 3;   ///< s
  Monitor monitor;
};

/// Everything that the page shows.
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
/// bounds what is possible. The same bits on any number of threads. Throws Interrupted when
/// stopped.
SuspensionStudy study_suspension(const SuspensionStudyOptions& options);

/// Greatest fundamental gain between two frequencies, Hz.
double greatest_gain(const std::vector<GainPoint>& gains, Gain GainPoint::* signal, double from,
                     double to);
/// Damping of a linear damper, N*s/m, whose greatest gain of the tyre's deflection up to 20 Hz is
/// `gain`; sought from 100 to 6000 N*s/m.
double damping_for_wheel_gain(const Plant& plant, double gain);

}  // namespace dashpot
