#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "dashpot/base/print_units.h"

namespace dashpot {

/// A column of numbers or of texts.
struct DataColumn {
  std::string name, unit, meaning;  ///< unit: "1" where there is none
  std::vector<double> numbers;      ///< not a number: nothing there
  std::vector<std::string> texts = {};

  bool is_text() const { return !texts.empty(); }
  std::size_t size() const { return is_text() ? texts.size() : numbers.size(); }
};

/// Columns of equal length, for programs.
struct ColumnTable {
  std::string name, title;
  std::vector<DataColumn> columns;

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
};

/// Columns of forces and motions, which are in SI, in other units.
ColumnTable in_units(ColumnTable table, const PrintUnits& units);

/// "sprung_mass[kg]" above numbers that keep all their digits; empty where there is nothing.
std::string csv_table(const ColumnTable& table);

/// A group per table and a dataset per column, with the attributes `unit` and `meaning`;
/// `attributes` are those of the file. The same content gives the same bytes. Throws Error where
/// the file cannot be written.
void write_hdf5(const std::filesystem::path& path, const std::vector<ColumnTable>& tables,
                const std::vector<std::pair<std::string, std::string>>& attributes);
/// Throws Error where write_hdf5() could write nothing, whatever the path: long work asks first.
void require_hdf5();

}  // namespace dashpot
