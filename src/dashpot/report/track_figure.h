#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "dashpot/drive.h"
#include "dashpot/identify/judge/track.h"

namespace dashpot {

/// What one scheme made of a wanted force.
struct TrackedScheme {
  std::string name;
  TrackReport report;
};

/// Draws the first seconds of the wanted force with what the schemes obtained, and their coil
/// currents, as track.svg and track.pdf; all schemes share one wanted force. At least one, of which
/// the first four are drawn. Returns the paths. Throws Error when gnuplot is missing.
std::vector<std::filesystem::path> write_track_figure(const std::vector<TrackedScheme>& schemes,
                                                      DriveUnit drive_unit,
                                                      const std::filesystem::path& folder);

}  // namespace dashpot
