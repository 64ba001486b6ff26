#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dashpot/error.h"

namespace dashpot {

/// A readable file that holds no table of numbers: a text, say. In a folder it is passed over; a
/// file that was named is refused with it.
class NoTable : public Error {
 public:
  using Error::Error;
};

/// A cell that holds no finite number, kept for the message.
struct BadCell {
  std::size_t row = 0;
  std::string text;  ///< "" when the cell is empty
};

/// A column of a file as it stands there. A cell that is not a finite number is NaN in `values`;
/// only when the column is used is that an error.
struct RawColumn {
  std::string name;  ///< "" in a file without names
  std::string unit;  ///< from a units row or fixed by the format; "" when the name may hold it
  std::vector<double> values;
  std::optional<BadCell> bad;  ///< the first one
};

/// One test run as a file holds it: named columns of equal length, in the file's own units and
/// signs. Between the readers, which make it, and build_record, which consumes it.
struct RawTable {
  std::string file;
  std::string part;            ///< "" or what of the file this is: "part 2, rows 9301-17600"
  std::size_t part_index = 0;  ///< counts the parts of one group from 0
  std::string part_name;       ///< "" or what the file itself calls the part: a sheet, a group
  std::string group;           ///< "" or what the parts of one group share: a damper's key
  std::vector<RawColumn> columns;
  std::vector<std::pair<std::string, double>> scalars;  ///< single numbers beside the columns: Ts
  std::optional<double> sample_time;                    ///< s, when the format itself states it
  /// Conditions in SI, when the format itself states them.
  std::vector<std::pair<std::string, double>> conditions;
  /// Pairs of row and line where the numbering jumps.
  std::vector<std::pair<std::size_t, std::size_t>> lines;
  std::vector<std::string> notes;

  /// Appends a sample; notes its line where the numbering of rows and lines parts. Cells that are
  /// missing or no finite numbers become NaN.
  void append_row(std::span<const std::string_view> cells, std::size_t line, char decimal = '.');

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
  bool named() const;                           ///< some column has a name
  std::string place() const;                    ///< "run3.csv", or "tests.xlsx, sheet 'run 3'"
  std::string at_line(std::size_t line) const;  ///< "run3.csv:118"
  /// "run3.csv:118", or "run3.mat, row 117" where there are no lines.
  std::string where(std::size_t row) const;
  /// "'t_s', 'x_mm'", or "3 columns without names", and what was passed over beside them.
  std::string column_list() const;
  /// "; variable 'time' passed over: why; ...", the first of them; "" where nothing was.
  std::string passed_over() const;
};

}  // namespace dashpot
