#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <matio.h>
#include <memory>
#include <unistd.h>

#include <fmt/core.h>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/export/tables/force_map.h"

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

/// A matrix by name, row by row.
struct Matrix {
  std::string name;
  std::size_t rows, columns;
  std::vector<double> values;
};

void add(mat_t* file, const Matrix& matrix) {
  std::vector<double> by_column;
  for (std::size_t c = 0; c < matrix.columns; ++c)
    for (std::size_t r = 0; r < matrix.rows; ++r)
      by_column.push_back(matrix.values[r * matrix.columns + c]);
  std::size_t sizes[] = {matrix.rows, matrix.columns};
  const std::unique_ptr<matvar_t, decltype(&Mat_VarFree)> variable(
      Mat_VarCreate(matrix.name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, 2, sizes, by_column.data(), 0),
      &Mat_VarFree);
  if (!variable || Mat_VarWrite(file, variable.get(), MAT_COMPRESSION_NONE) != 0)
    throw Error("MAT file", "matio cannot write " + matrix.name);
}

/// The bytes of a MAT file of version 5; matio writes to a file only.
std::string mat_file(const std::vector<Matrix>& matrices, const std::string& what) {
  std::string path = (std::filesystem::temp_directory_path() / "dashpot-XXXXXX").string();
  const int handle = mkstemp(path.data());
  if (handle < 0) throw Error(path, "no temporary file can be made there");
  close(handle);
  const std::unique_ptr<const std::string, void (*)(const std::string*)> removed(
      &path, [](const std::string* name) { std::remove(name->c_str()); });
  {
    const std::unique_ptr<mat_t, decltype(&Mat_Close)> file(
        Mat_CreateVer(path.c_str(), what.c_str(), MAT_FT_MAT5), &Mat_Close);
    if (!file) throw Error(path, "matio cannot write there");
    for (const Matrix& matrix : matrices) add(file.get(), matrix);
  }
  return read_file(path);
}

Matrix column(const std::string& name, const std::vector<double>& values) {
  return {name, values.size(), 1, values};
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
  const std::vector<Matrix> matrices{
      column("velocity", map.velocity),
      column("current", map.current),
      {"force", map.velocity.size(), map.current.size(), map.force},
      column("wanted_force", inverse.force),
      {"inverse_current", inverse.velocity.size(), inverse.force.size(), inverse.current}};
  return {{name + "_force.csv", csv("force[N]: velocity[m/s] \\ current[" + unit + "]",
                                    map.velocity, map.current, map.force)},
          {name + "_current.csv", csv("current[" + unit + "]: velocity[m/s] \\ force[N]",
                                      inverse.velocity, inverse.force, inverse.current)},
          {name + ".mat", mat_file(matrices, "Dashpot " + options.version + ": " + name)}};
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
