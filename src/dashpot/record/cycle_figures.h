#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dashpot/drive.h"
#include "dashpot/record.h"
#include "dashpot/record/knee.h"

// The figures of one record: its turning points, its cycles, and how they repeat.
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

/// The channels of a record that its figures come from, of equal length, in SI.
struct DynoChannels {
  std::span<const double> time, displacement, velocity, force;
  std::span<const double> drive;        ///< empty where it is not known
  std::span<const double> temperature;  ///< empty without the channel
};

/// The turning points of a displacement: samples between which it moves by more than `least`, one
/// way and then the other. A record that begins or ends within a stroke has its first or last
/// sample among them.
std::vector<std::size_t> turning_points(const std::vector<double>& displacement, double least);

/// All figures of the cycle between three turning points: lowest, highest, lowest.
CycleFigures figures_of_cycle(const DynoChannels& channels, std::size_t first, std::size_t middle,
                              std::size_t last);

/// Speeds (m/s) of one direction of a cycle, as shares of its mid-stroke speed, with the mean of
/// the forces (N, size) while speed grows and while it falls: its loop without width. `sign`: 1 for
/// the rebound, -1 for the compression.
struct MeanLoop {
  std::vector<double> speed, force;
  std::vector<std::size_t> ends = {};  ///< behind the last point of each cycle
};
void add_mean_loop(const DynoChannels& channels, const CycleFigures& cycle, double sign,
                   MeanLoop& loop);

/// The displacement's own noise, m: from what three neighbouring samples differ from a line.
double noise_of(std::span<const double> samples);

/// The record's channels; `integrated` takes the displacement where there is none. Throws Error
/// without force or velocity, and where displacement cannot be integrated.
DynoChannels dyno_channels(const Record& record, DriveUnit drive_unit,
                           std::vector<double>& integrated);

RecordFigures figures_of_record(const Record& record, DriveUnit drive_unit);

}  // namespace dashpot
