#pragma once
#include <cmath>
#include <functional>

#include "dashpot/base/text.h"
#include "program.h"

// What people get wrong, end to end: the program ends with its code and says where, what, and what
// would be right. Messages of single parts are tested beside those parts.

namespace dashpot {

/// A sine on a damper with friction, one sample each 5 ms: t, x, F, i.
inline std::vector<std::string> sine_row(int k) {
  const double phase = 2 * 3.14159265358979 * k * 0.005;
  return {format_number(k * 0.005, 9), format_number(10 * std::sin(phase), 9),
          format_number(300 * std::tanh(5 * std::cos(phase)), 9), "1"};
}

inline constexpr const char* kNames = "t_s,x_mm,F_N,i_A\n";

/// The sine as CSV below `names`; `change` may alter the cells of a row.
using Change = std::function<void(int, std::vector<std::string>&)>;
inline std::string csv(const Change& change = {}, int rows = 300,
                       const std::string& names = kNames) {
  std::string text = names;
  for (int k = 0; k < rows; ++k) {
    std::vector<std::string> row = sine_row(k);
    if (change) change(k, row);
    text += join(row, ",") + '\n';
  }
  return text;
}

/// One cell of row 100, which is line 102 of the file.
inline Change cell(std::size_t column, const std::string& text) {
  return [=](int k, std::vector<std::string>& row) {
    if (k == 100) row[column] = text;
  };
}

/// Every row scaled in one column.
inline Change scaled(std::size_t column, double factor) {
  return [=](int, std::vector<std::string>& row) {
    row[column] = format_number(factor * *parse_number(row[column]), 9);
  };
}

inline void drop_force(int, std::vector<std::string>& row) { row.erase(row.begin() + 2); }
inline void drop_current(int, std::vector<std::string>& row) { row.pop_back(); }

/// Files, and what the program makes of them. In `arguments` DIR is the folder that holds them.
struct Wrong {
  std::string what;
  std::vector<std::pair<std::string, std::string>> files;
  std::string arguments;
  int exit_code;
  std::vector<std::string> said;
};

inline void check(const Wrong& wrong) {
  CAPTURE(wrong.what);
  const TemporaryFolder folder;
  for (const auto& [name, content] : wrong.files) folder.write(name, content);
  std::string arguments = wrong.arguments;
  for (std::size_t at; (at = arguments.find("DIR")) != std::string::npos;)
    arguments.replace(at, 3, folder.path().string());
  const ProgramResult result = run_dashpot(arguments);
  CAPTURE(result.output);
  CHECK(result.exit_code == wrong.exit_code);
  for (const std::string& part : wrong.said) CHECK_MESSAGE(contains(result.output, part), part);
}

}  // namespace dashpot
