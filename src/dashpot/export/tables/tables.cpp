#include <fmt/core.h>

#include "dashpot/base/text.h"
#include "dashpot/export/tables/force_map.h"
#include "dashpot/record/mat_bytes.h"

namespace dashpot {
namespace {

constexpr int kDigits = 12;  // of rates in mm/s, which are read by people

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

ForceMap asked_map(const ExportedModel& model, const ExportOptions& options) {
  return force_map(model, export_sample_time(model, options), options.velocities, options.currents);
}

/// The head of a table, and where the model extrapolates in it.
std::string with_note(const std::string& head, const std::string& note) {
  return note.empty() ? head : head + "; " + note;
}

std::string dpr(const ForceMap& map, std::size_t i, const std::string& title,
                const std::string& note) {
  std::string text = fmt::format(
      "$ {}{}\n"
      "$ Extension positive; the force is positive when it resists extension.\n"
      "[MDI_HEADER]\nFILE_TYPE = 'dpr'\nFILE_VERSION = 4.0\nFILE_FORMAT = 'ASCII'\n"
      "[UNITS]\nLENGTH = 'mm'\nANGLE = 'degrees'\nFORCE = 'newton'\nMASS = 'kg'\n"
      "TIME = 'second'\n[CURVE]\n{{vel force}}\n",
      title, note.empty() ? "" : "\n$ " + note);
  for (std::size_t v = 0; v < map.velocity.size(); ++v)
    text +=
        format_number(1000 * map.velocity[v], kDigits) + ' ' + format_exact(map.at(v, i)) + '\n';
  return text;
}

}  // namespace

std::vector<ExportedFile> write_tables(const ExportedModel& model, const ExportOptions& options) {
  const std::string name = export_name(model, options), unit = unit_of(model.drive_unit);
  const ForceMap map = asked_map(model, options);
  const CurrentMap inverse = inverse_of(map);
  const std::string note = extrapolation_note(model, options);

  // The same numbers for spreadsheets and for MATLAB.
  const std::vector<MatVariable> matrices{
      column("velocity", map.velocity),
      column("current", map.current),
      matrix("force", map.velocity.size(), map.current.size(), map.force),
      matrix("extrapolated", map.velocity.size(), map.current.size(), map.extrapolated),
      column("wanted_force", inverse.force),
      matrix("inverse_current", inverse.velocity.size(), inverse.force.size(), inverse.current)};
  return {
      {name + "_force.csv", csv(with_note("force[N]: velocity[m/s] \\ current[" + unit + "]", note),
                                map.velocity, map.current, map.force)},
      {name + "_current.csv",
       csv(with_note("current[" + unit + "]: velocity[m/s] \\ force[N]", note), inverse.velocity,
           inverse.force, inverse.current)},
      {name + ".mat", mat_bytes(matrices, "Dashpot " + options.version + ": " + name)}};
}

std::vector<ExportedFile> write_carsim(const ExportedModel& model, const ExportOptions& options) {
  const std::string name = export_name(model, options);
  const ForceMap map = asked_map(model, options);

  // Compression counts positive there: rates and forces change their sign, and their order.
  std::string text = with_note("compression rate [mm/s]", extrapolation_note(model, options));
  for (const double current : map.current)
    text += fmt::format(",force [N] at {} {}", format_number(current), unit_of(model.drive_unit));
  text += '\n';
  for (std::size_t v = map.velocity.size(); v-- > 0;) {
    text += format_number(0 - 1000 * map.velocity[v], kDigits);
    for (std::size_t i = 0; i < map.current.size(); ++i)
      text += ',' + format_exact(0 - map.at(v, i));
    text += '\n';
  }
  return {{name + "_carsim.csv", text}};
}

std::vector<ExportedFile> write_dpr(const ExportedModel& model, const ExportOptions& options) {
  const std::string name = export_name(model, options);
  const ForceMap map = asked_map(model, options);
  std::vector<ExportedFile> files;
  for (std::size_t i = 0; i < map.current.size(); ++i) {
    const std::string drive = format_number(map.current[i]) + ' ' + unit_of(model.drive_unit);
    files.push_back({fmt::format("{}_{:02}.dpr", name, i),
                     dpr(map, i, name + " at " + drive + ", made by Dashpot " + options.version,
                         extrapolation_note(model, options))});
  }
  return files;
}

}  // namespace dashpot
