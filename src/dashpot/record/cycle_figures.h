#pragma once
#include <span>
#include <vector>

#include "dashpot/record/characterise.h"

// The figures of one record: its turning points, its cycles, and how they repeat.
namespace dashpot {

/// The channels of a record that its figures come from, of equal length, in SI.
struct DynoChannels {
  std::span<const double> time, displacement, velocity, force;
  std::span<const double> drive;        ///< empty where it is not known
  std::span<const double> temperature;  ///< empty without the channel
};

/// All figures of the cycle between three turning points: lowest, highest, lowest.
CycleFigures figures_of_cycle(const DynoChannels& channels, std::size_t first, std::size_t middle,
                              std::size_t last);

/// Speeds (m/s) of one direction of a cycle, as shares of its mid-stroke speed, with the mean of
/// the forces (N, size) while speed grows and while it falls: its loop without width. `sign`: 1 for
/// the rebound, -1 for the compression.
struct MeanLoop {
  std::vector<double> speed, force;
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
