#pragma once
#include <cstddef>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "dashpot/damper_model.h"
#include "dashpot/drive.h"

namespace dashpot {

/// The most numbers of a covariance, sensors, measured inputs, dampers, numbers of the state of one
/// that is estimated, and of one that is carried along its motion.
constexpr std::size_t kMostObserved = 68, kMostObservedSensors = 12, kMostObservedInputs = 8,
                      kMostObservedDampers = 4, kMostObservedDamper = 12, kMostMemory = 512;

/// The tables of a filter of a plant, as c_text/plant_filter.h names and orders them. SI.
struct ObserverTables {
  int plant = 0, inputs = 0, drives = 1, roads = 0, dampers = 1, errors = 0, shifts = 0,
      sensors = 0, steps = 1;
  double step = 0;  ///< s
  double road_keep = 1;
  /// Numbers of each one's state: that are estimated, or that are carried along its motion.
  std::vector<int> damper, memory;
  std::vector<int> by_way;  ///< whether each one's force goes by its displacement: 0 or 1
  std::vector<double> error_keep, transition, by_start, by_end, deflection, on_ground;
  std::vector<double> sensor_plant, sensor_input, sensor_slope, sensor_road, sensor_force;
  std::vector<double> sensor_variance, process, difference;
  double way = 0, speed = 0, shift_added = 0;  ///< m, m/s, (m/s)^2
  std::vector<double>
      first_deviation;  ///< of every number of the estimate, before the first sample

  /// Where the states of the dampers begin.
  std::size_t own() const {
    return static_cast<std::size_t>(plant + roads + dampers * (errors + shifts));
  }
  std::size_t moving() const {
    return own() + static_cast<std::size_t>(std::accumulate(damper.begin(), damper.end(), 0));
  }
  /// Numbers of a covariance.
  std::size_t all() const { return moving() + static_cast<std::size_t>(sensors); }
  /// Numbers of an estimate: the memories stand behind those of the covariance.
  std::size_t kept() const {
    return all() + 3 * static_cast<std::size_t>(std::accumulate(memory.begin(), memory.end(), 0));
  }
};

/// What the numbers of an estimate and the places of the samples are called, for whoever writes
/// them: coordinates, velocities, roads; sensors and inputs by their channels.
struct ObserverNames {
  std::vector<std::string> states, state_units;  ///< of the plant and the roads
  std::vector<std::string> sensors, sensor_units;
  std::vector<std::string> inputs, input_units;
  std::vector<std::string> struts;  ///< one per damper
  std::string plant, damper;
  DriveUnit drive_unit = DriveUnit::None;
};

/// What a sample told a filter, beside the estimate: as FilterSample of the text.
struct ObservedSample {
  std::vector<double> transition;  ///< moving x moving
  std::vector<double> rows;        ///< sensors x all
  std::vector<double> innovation;  ///< per sensor
  std::vector<double> variance;    ///< of it; 0: the sensor showed no number
};

/// An extended Kalman filter of a linear plant with dampers in it: the state of the plant, the road
/// where nothing measures it, each damper's own state, errors of its force that come and go and of
/// the velocity by which it goes, and an offset per sensor, from what the sensors show. The same
/// text is the exported C. Immutable; estimate (kept() numbers) and covariance (all() x all()) are
/// the caller's. Source: R. E. Kalman 1960; A. Gelb, Applied Optimal Estimation, 1974, for the
/// extended one.
class PlantObserver {
 public:
  /// Throws Error where there are more numbers than kMostObserved...
  PlantObserver(ObserverTables tables, std::vector<std::shared_ptr<const DamperModel>> dampers);

  const ObserverTables& tables() const { return tables_; }
  const std::vector<std::shared_ptr<const DamperModel>>& dampers() const { return dampers_; }

  /// The first sample. `now`: the measured inputs, then the drives; `measured`: per sensor;
  /// `about`: the plant and its roads, where velocities are known to a tenth; empty: they are not.
  void start(std::span<const double> now, std::span<const double> measured,
             std::span<const double> about, std::span<double> estimate,
             std::span<double> covariance, ObservedSample& sample) const;
  /// The next sample, of which `before` are the inputs at the last one.
  void step(std::span<const double> before, std::span<const double> now,
            std::span<const double> measured, std::span<double> estimate,
            std::span<double> covariance, ObservedSample& sample) const;
  /// An estimate with its covariance.
  struct Known {
    std::span<const double> estimate, covariance;
  };
  /// The first and the next sample, with the tangents of plant and dampers at a motion that is
  /// known already, `earlier` at the sample before and `later` at this one, in place of those at
  /// the estimate.
  void start_along(Known later, std::span<const double> now, std::span<const double> measured,
                   std::span<const double> about, std::span<double> estimate,
                   std::span<double> covariance, ObservedSample& sample) const;
  void step_along(Known earlier, Known later, std::span<const double> before,
                  std::span<const double> now, std::span<const double> measured,
                  std::span<double> estimate, std::span<double> covariance,
                  ObservedSample& sample) const;
  /// The dampers' memories along a motion that is told, in its estimates: at the first sample, and
  /// from the sample before to this one.
  void remember_first(std::span<const double> now, std::span<double> estimate) const;
  void remember(std::span<const double> before, std::span<const double> now,
                std::span<const double> past, std::span<const double> covariance,
                std::span<double> estimate) const;
  /// Force of a damper, N, with its standard deviation, deflection m and its rate m/s.
  struct Damper {
    double force = 0, deviation = 0, deflection = 0, velocity = 0;
  };
  Damper damper_at(std::size_t damper, std::span<const double> before, std::span<const double> now,
                   Known known) const;

 private:
  void before_first(std::span<const double> now, std::span<const double> about,
                    std::span<double> estimate, std::span<double> covariance) const;

  ObserverTables tables_;
  std::vector<std::shared_ptr<const DamperModel>> dampers_;
};

}  // namespace dashpot
