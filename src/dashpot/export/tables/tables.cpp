#include <array>

#include <fmt/core.h>

#include "dashpot/base/print_units.h"
#include "dashpot/base/text.h"
#include "dashpot/export/tables/force_map.h"
#include "dashpot/record/mat_bytes.h"

namespace dashpot {
namespace {

constexpr int kDigits = 12;  // of rates in mm/s, which are read by people

/// The head of a table, and where the model extrapolates in it.
std::string with_note(const std::string& head, const std::string& note) {
  return note.empty() ? head : head + "; " + note;
}

/// Numbers in SI and the unit in which a table has them.
struct Shown {
  const std::vector<double>& numbers;
  PrintUnit unit;

  /// Of another unit than SI, as people read it at the head of a line.
  std::string head(std::size_t k) const {
    return unit.factor == 1 ? format_exact(numbers[k])
                            : format_number(unit.factor * numbers[k], kDigits);
  }
};

/// "force[N]: velocity[m/s] \ current[A]" and a note; the values of the rows in the first column,
/// those of the columns in the first line.
std::string csv(const std::array<std::string, 3>& names, const std::string& note,
                const Shown& values, const Shown& rows, const Shown& columns) {
  std::string text = with_note(fmt::format("{}[{}]: {}[{}] \\ {}[{}]", names[0], values.unit.name,
                                           names[1], rows.unit.name, names[2], columns.unit.name),
                               note);
  const std::size_t width = columns.numbers.size();
  for (std::size_t c = 0; c < width; ++c) text += ',' + columns.head(c);
  text += '\n';
  for (std::size_t r = 0; r < rows.numbers.size(); ++r) {
    text += rows.head(r);
    for (std::size_t c = 0; c < width; ++c)
      text += ',' + format_exact(values.unit.factor * values.numbers[r * width + c]);
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
  const std::string name = export_name(model, options);
  const ForceMap map = asked_map(model, options);
  const CurrentMap inverse = inverse_of(map);
  // The same numbers for spreadsheets, and in SI for MATLAB.
  const std::vector<MatVariable> matrices{
      column("velocity", map.velocity),
      column("current", map.current),
      matrix("force", map.velocity.size(), map.current.size(), map.force),
      matrix("extrapolated", map.velocity.size(), map.current.size(), map.extrapolated),
      column("wanted_force", inverse.force),
      matrix("inverse_current", inverse.velocity.size(), inverse.force.size(), inverse.current)};
  const PrintUnits units =
      options.units.empty() ? PrintUnits::si() : PrintUnits::parse(options.units, "units");
  const PrintUnit speed = units.of("m/s"), force = units.of("N"),
                  drive{unit_of(model.drive_unit), 1};
  const std::string note = extrapolation_note(model, options, speed);
  return {
      {name + "_force.csv", csv({"force", "velocity", "current"}, note, {map.force, force},
                                {map.velocity, speed}, {map.current, drive})},
      {name + "_current.csv", csv({"current", "velocity", "force"}, note, {inverse.current, drive},
                                  {inverse.velocity, speed}, {inverse.force, force})},
      {name + ".mat", mat_bytes(matrices, "Dashpot " + options.version + ": " + name)}};
}

std::vector<ExportedFile> write_carsim(const ExportedModel& model, const ExportOptions& options) {
  const std::string name = export_name(model, options);
  const ForceMap map = asked_map(model, options);

  // Compression counts positive there: rates and forces change their sign, and their order.
  const PrintUnit rate{"mm/s", -1000};
  std::string text = with_note("compression rate [mm/s]", extrapolation_note(model, options, rate));
  for (const double current : map.current)
    text += fmt::format(",force [N] at {} {}", format_number(current), unit_of(model.drive_unit));
  text += '\n';
  for (std::size_t v = map.velocity.size(); v-- > 0;) {
    text += format_number(0 + rate.factor * map.velocity[v], kDigits);
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
                         extrapolation_note(model, options, {"mm/s", 1000}))});
  }
  return files;
}

}  // namespace dashpot
