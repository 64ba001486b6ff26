#include <fmt/core.h>

#include "dashpot/base/text.h"
#include "dashpot/export/tables/force_map.h"
#include "dashpot/record/mat_bytes.h"

namespace dashpot {
namespace {

/// A table with the values of its rows in the first column, those of its columns in the first line.
std::string csv(const std::string& corner, const std::vector<double>& rows,
                const std::vector<double>& columns, const std::vector<double>& values) {
  std::string text = corner;
  for (const double column : columns) text += ',' + format_exact(column);
  text += '\n';
  for (std::size_t r = 0; r < rows.size(); ++r) {
    text += format_exact(rows[r]);
    for (std::size_t c = 0; c < columns.size(); ++c)
      text += ',' + format_exact(values[r * columns.size() + c]);
    text += '\n';
  }
  return text;
}

/// A matrix whose values lie row by row.
MatVariable matrix(const std::string& name, std::size_t rows, std::size_t columns,
                   const std::vector<double>& values) {
  MatVariable made{.name = name, .rows = rows, .columns = columns};
  for (std::size_t c = 0; c < columns; ++c)
    for (std::size_t r = 0; r < rows; ++r) made.values.push_back(values[r * columns + c]);
  return made;
}

MatVariable column(const std::string& name, const std::vector<double>& values) {
  return matrix(name, values.size(), 1, values);
}

std::string dpr(const ForceMap& map, std::size_t i, const std::string& title) {
  std::string text = fmt::format(
      "$ {}\n"
      "$ Extension positive; the force is positive when it resists extension.\n"
      "[MDI_HEADER]\nFILE_TYPE = 'dpr'\nFILE_VERSION = 4.0\nFILE_FORMAT = 'ASCII'\n"
      "[UNITS]\nLENGTH = 'mm'\nANGLE = 'degrees'\nFORCE = 'newton'\nMASS = 'kg'\n"
      "TIME = 'second'\n[CURVE]\n{{vel force}}\n",
      title);
  for (std::size_t v = 0; v < map.velocity.size(); ++v)
    text += format_exact(1000 * map.velocity[v]) + ' ' + format_exact(map.at(v, i)) + '\n';
  return text;
}

}  // namespace

std::vector<ExportedFile> write_tables(const ExportedModel& model, const ExportOptions& options) {
  const std::string name = export_name(model, options), unit = unit_of(model.drive_unit);
  const ForceMap map = force_map(model, export_sample_time(model, options));
  const CurrentMap inverse = inverse_of(map);

  // The same numbers for spreadsheets and for MATLAB.
  const std::vector<MatVariable> matrices{
      column("velocity", map.velocity), column("current", map.current),
      matrix("force", map.velocity.size(), map.current.size(), map.force),
      column("wanted_force", inverse.force),
      matrix("inverse_current", inverse.velocity.size(), inverse.force.size(), inverse.current)};
  return {{name + "_force.csv", csv("force[N]: velocity[m/s] \\ current[" + unit + "]",
                                    map.velocity, map.current, map.force)},
          {name + "_current.csv", csv("current[" + unit + "]: velocity[m/s] \\ force[N]",
                                      inverse.velocity, inverse.force, inverse.current)},
          {name + ".mat", mat_bytes(matrices, "Dashpot " + options.version + ": " + name)}};
}

std::vector<ExportedFile> write_dpr(const ExportedModel& model, const ExportOptions& options) {
  const std::string name = export_name(model, options);
  const ForceMap map = force_map(model, export_sample_time(model, options));
  std::vector<ExportedFile> files;
  for (std::size_t i = 0; i < map.current.size(); ++i) {
    const std::string drive = format_number(map.current[i]) + ' ' + unit_of(model.drive_unit);
    files.push_back({fmt::format("{}_{:02}.dpr", name, i),
                     dpr(map, i, name + " at " + drive + ", made by Dashpot " + options.version)});
  }
  return files;
}

}  // namespace dashpot
