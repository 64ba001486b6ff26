#pragma once
#include <string>
#include <vector>

#include "dashpot/base/print_units.h"
#include "dashpot/export.h"

namespace dashpot {

/// The settled force over velocity and command.
struct ForceMap {
  std::vector<double> velocity;  ///< m/s, ascending, denser about 0
  std::vector<double> current;   ///< A or V, ascending
  std::vector<double> force;     ///< N, a row per velocity, a column per current
  /// Likewise, 1 where the model's domain has no such velocity or current: it extrapolates.
  std::vector<double> extrapolated;

  double at(std::size_t v, std::size_t i) const { return force[v * current.size() + i]; }
};

/// Each force at the end of a stroke from rest, at constant velocity and command, that ends in the
/// middle of the domain, as makers of dampers plot it; `sample_time` in s. Empty velocities or
/// currents: over the domain. Throws Error where the model gives no finite force.
ForceMap force_map(const ExportedModel& model, double sample_time,
                   const std::vector<double>& velocities = {},
                   const std::vector<double>& currents = {});

/// "extrapolated beyond -200 ... 200 mm/s and 0 ... 2 A": the domain, where the options' grid
/// leaves it; else empty. `speed` is the unit of velocities in what the note stands in; its factor
/// is negative where compression counts positive there.
std::string extrapolation_note(const ExportedModel& model, const ExportOptions& options,
                               const PrintUnit& speed);

/// The command over velocity and wanted force: the least one at which the map has the force, or the
/// one that comes nearest.
struct CurrentMap {
  std::vector<double> velocity, force;  ///< m/s; N, ascending
  std::vector<double> current;          ///< A or V, a row per velocity, a column per force
};
CurrentMap inverse_of(const ForceMap& map);

/// NAME_force.csv, NAME_current.csv and NAME.mat with both.
std::vector<ExportedFile> write_tables(const ExportedModel& model, const ExportOptions& options);
/// NAME_carsim.csv: force over the rate of compression.
std::vector<ExportedFile> write_carsim(const ExportedModel& model, const ExportOptions& options);
/// One TeimOrbit file per current.
std::vector<ExportedFile> write_dpr(const ExportedModel& model, const ExportOptions& options);

}  // namespace dashpot
