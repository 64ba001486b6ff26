#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace dashpot {

/// A variable of a MAT file: a real matrix, column by column, or a text.
struct MatVariable {
  std::string name;
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;
  std::string text;  ///< in place of values
  bool is_text = false;
};

/// The bytes of a MAT file of version 5, not compressed. `header` is its description; empty:
/// matio's own. Throws Error when the memory does not take it whole.
std::string mat_bytes(const std::vector<MatVariable>& variables, const std::string& header = {});

}  // namespace dashpot
