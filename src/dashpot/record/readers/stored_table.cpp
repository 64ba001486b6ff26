#include "dashpot/record/readers/stored_table.h"

#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace dashpot {
namespace {

/// The length that most columns share; of two, the longer.
std::size_t common_length(const std::vector<StoredArray>& arrays) {
  std::map<std::size_t, std::size_t> columns;
  for (const StoredArray& array : arrays)
    if (array.length() > 1 && !array.is_wide()) columns[array.length()] += array.columns.size();
  std::size_t best = 0, most = 0;
  for (const auto& [length, count] : columns)
    if (count >= most) best = length, most = count;
  return best;
}

/// Numbers that are not finite become NaN, the first of them noted.
RawColumn column_of(std::string name, std::string unit, std::vector<double> values) {
  RawColumn column{std::move(name), std::move(unit), std::move(values), {}};
  for (std::size_t k = 0; k < column.values.size(); ++k) {
    double& value = column.values[k];
    if (std::isfinite(value)) continue;
    if (!column.bad) column.bad = BadCell{k, std::isnan(value) ? "NaN" : "infinite"};
    value = std::numeric_limits<double>::quiet_NaN();
  }
  return column;
}

void add_array(RawTable& table, StoredArray& array) {
  const std::size_t count = array.columns.size();
  for (std::size_t c = 0; c < count; ++c) {
    const std::string number = count == 1 ? "" : "(" + std::to_string(c + 1) + ")";
    table.columns.push_back(
        column_of(array.name + number, array.unit, std::move(array.columns[c])));
  }
}

}  // namespace

RawTable stored_table(const std::string& file, StoredArrays all,
                      ArrayWords (*described)(const StoredArray&)) {
  RawTable table;
  table.file = file;
  for (StoredNote& note : all.notes) table.notes.push_back(std::move(note.text));
  const std::size_t length = common_length(all.arrays);
  for (StoredArray& array : all.arrays) {
    if (array.length() == 1) {
      table.scalars.emplace_back(array.name, array.columns.front().front());
    } else if (array.length() == length && !array.is_wide()) {
      add_array(table, array);
    } else {
      const ArrayWords words = described(array);
      table.notes.push_back(words.kind + " '" + array.name + "' passed over: " + words.size +
                            " values, the recording has " + std::to_string(length));
    }
  }
  return table;
}

}  // namespace dashpot
