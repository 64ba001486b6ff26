#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/dataset.h"
#include "dashpot/record/knee.h"

// What a dyno sheet says of a damper, from the recordings alone, with no model fitted: cycle by
// cycle, record by record, and per level of the drive. docs/characterise.md has every definition
// with its limits. All in SI and Dashpot's signs: extension (rebound) positive, force positive when
// it resists extension, so that compression forces are negative.
namespace dashpot {

/// A stroke between two turning points of the displacement, in one direction.
struct StrokeFigures {
  double mid_speed = 0;   ///< m/s, |v| where the rod passes the middle of the stroke
  double mid_force = 0;   ///< N, there: straight line through the middle fifth of the stroke
  double peak_speed = 0;  ///< m/s, greatest |v|, smoothed over a fiftieth of the stroke's time
  double peak_force = 0;  ///< N, of greatest size in this direction, smoothed likewise
};

/// One cycle: an extension from the lowest displacement, then a compression back to it.
struct CycleFigures {
  std::size_t first = 0, middle = 0, last = 0;  ///< samples of its three turning points
  double start = 0, duration = 0;               ///< s
  double stroke = 0, centre = 0;                ///< m, from turning point to turning point
  double drive = 0;                             ///< A or V, its mean; not a number without a drive
  StrokeFigures rebound, compression;
  /// N, half of the difference of the mid-stroke forces of the two directions: what is left when
  /// the gas force is taken off.
  double damping_force = 0;
  double static_force = 0;  ///< N, their mean, turned over: positive pushes the rod out
  double rate = 0;          ///< N/m, slope of the mean force of the directions over displacement
  /// N, size of the force while speed falls less that while it grows, at half of the mid-stroke
  /// speed, the rate taken off, mean of the directions: above 0 where force lags behind speed.
  double hysteresis = 0;
  double energy = 0;              ///< J, integral of F v dt
  double equivalent_damping = 0;  ///< N*s/m, of the dashpot that takes out as much in a sine
  double temperature = 0;         ///< K, its mean; not a number without the channel
};

/// Cycles of one level of the drive that are alike in speed (within 5 %).
struct SpeedFigures {
  double speed = 0;  ///< m/s, mean of the mid-stroke speeds of both directions
  std::size_t cycles = 0;
  StrokeFigures rebound, compression;  ///< means
  double damping_force = 0;            ///< N, mean
  /// %, standard deviation of damping_force between the cycles of one record, pooled; not a number
  /// where no record has two.
  double repeatability = kNoNumber;
  double hysteresis = 0, energy = 0, equivalent_damping = 0;  ///< means, as of a cycle
};

/// What a record says, and what it cannot say.
struct RecordFigures {
  std::string name, condition;
  std::optional<double> drive_level;
  std::vector<CycleFigures> cycles;
  double repeatability = kNoNumber;  ///< %, as SpeedFigures, over all its speeds
  Measured drift;  ///< %, change of damping_force over the record, at equal speeds
  Measured fade;   ///< %/K, change of damping_force with temperature, at equal speeds
  std::vector<std::string> remarks;  ///< what cannot be told and why; what to beware of
  bool is_cyclic() const { return !cycles.empty(); }
};

/// All cycles at one level of the drive.
struct LevelFigures {
  std::optional<double> drive;       ///< A or V; nothing where the drive is not known
  std::vector<SpeedFigures> speeds;  ///< ascending
  /// "speeds": from the mid-stroke forces of cycles at several speeds; "loop": from the loops of
  /// the fastest record, where speeds are too few; "none".
  std::string basis = "none";
  KneeFit rebound, compression;
  /// N, friction and field force together: the lines above the knees, led on to v = 0, mean of the
  /// directions.
  Measured yield;
  Measured friction;      ///< N, half of the jump of force between the directions at v -> 0;
                          ///< untold where loops have a knee: their lower line is hysteresis
  Measured static_force;  ///< N, gas force and zero of the load cell, at mid stroke and v -> 0
  Measured rate;          ///< N/m, its slope at mid stroke, towards frequency 0 where that varies
  std::vector<std::string> remarks;
};

/// Force at the highest drive over that at the lowest.
struct DynamicRange {
  double speed = 0;                            ///< m/s
  double ratio = 0;                            ///< of the damping forces
  double lowest_force = 0, highest_force = 0;  ///< N
};

struct Characterisation {
  DriveUnit drive_unit = DriveUnit::Ampere;
  std::vector<RecordFigures> records;  ///< of the dataset, in its order
  std::vector<LevelFigures> levels;    ///< ascending
  std::vector<double> stated_speeds;   ///< m/s, as asked for
  std::vector<DynamicRange> range;     ///< at the stated speeds, or those of the lowest drive
  std::vector<std::string> remarks;
};

struct CharacteriseOptions {
  /// m/s, ascending: the speeds at which forces are stated, by straight lines between the speeds
  /// that were measured and never beyond them. Empty: at those that were measured.
  std::vector<double> speeds;
};

/// The turning points of a displacement: samples between which it moves by more than `least`, one
/// way and then the other, the first and the last of them where the motion was already under way.
std::vector<std::size_t> turning_points(const std::vector<double>& displacement, double least);

/// Characterises every record. One that is at rest, shorter than a cycle, random or without force
/// is named with the reason in its remarks and takes no part in the levels. Throws Error where a
/// record has no force.
Characterisation characterise(const Dataset& dataset, const CharacteriseOptions& options = {});

/// The figures of a level at a speed between those that were measured there; nothing beyond.
std::optional<SpeedFigures> at_speed(const LevelFigures& level, double speed);

}  // namespace dashpot
