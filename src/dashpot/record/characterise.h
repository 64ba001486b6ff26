#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/dataset.h"
#include "dashpot/record/cycle_figures.h"
#include "dashpot/record/knee.h"

// What a dyno sheet says of a damper, from the recordings alone, with no model fitted: cycle by
// cycle, record by record, and per level of the drive. docs/characterise.md has every definition
// with its limits. All in SI and Dashpot's signs: extension (rebound) positive, force positive when
// it resists extension, so that compression forces are negative.
namespace dashpot {

/// Cycles of one level of the drive that are alike in speed (within 5 %).
struct SpeedFigures {
  double speed = 0;  ///< m/s, mean of the mid-stroke speeds of both directions
  std::size_t cycles = 0;
  double stroke = 0;  ///< m, mean; not a number where the cycles' strokes are unlike
  StrokeFigures rebound, compression;  ///< means
  double damping_force = 0;            ///< N, mean
  /// %, standard deviation of damping_force between the cycles of one record, pooled; not a number
  /// where no record has two.
  double repeatability = kNoNumber;
  /// Means, as of a cycle; the energy is not a number where the strokes are unlike.
  double hysteresis = 0, energy = 0, equivalent_damping = 0;
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

/// Characterises every record. One that is at rest, shorter than a cycle, random or without force
/// is named with the reason in its remarks and takes no part in the levels. Throws Error where a
/// record has no force.
Characterisation characterise(const Dataset& dataset, const CharacteriseOptions& options = {});

/// The figures of a level at a speed between those that were measured there; nothing beyond.
std::optional<SpeedFigures> at_speed(const LevelFigures& level, double speed);

}  // namespace dashpot
