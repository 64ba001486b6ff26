#pragma once
#include <string>
#include <vector>

#include "dashpot/report/wrap.h"

namespace dashpot::cli {

/// A table for a terminal. The last column gives way, line by line, when the terminal is narrow,
/// unless it is of numbers.
class Table {
 public:
  /// A title that begins with '>' stands over a column of numbers, set flush right.
  explicit Table(const std::vector<std::string>& titles);
  void row(std::vector<std::string> cells);
  std::string text(std::size_t width, std::size_t indent = 0) const;

 private:
  std::vector<bool> right_;
  std::vector<std::vector<std::string>> rows_;  // the first holds the titles
};

}  // namespace dashpot::cli
