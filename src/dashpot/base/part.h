#pragma once
#include <cstddef>
#include <string>

namespace dashpot {

/// A share of long work that several processes do without knowing of each other: the third of
/// sixteen has the tasks 2, 18, 34 ... in the order in which the work is stated, so that each gets
/// some of every kind.
struct Part {
  std::size_t number = 1, of = 1;  ///< 1 <= number <= of

  bool has(std::size_t task) const { return task % of == number - 1; }
  bool is_all() const { return of == 1; }
};

/// What a process did of its part.
struct PartReport {
  std::size_t tasks = 0;  ///< of the part
  std::size_t all = 0;    ///< of the whole work
  std::size_t kept = 0;   ///< of the part: they were there already
  double wall_seconds = 0;
};

/// From "3/16". Throws Error(where, ...) on anything else.
Part parse_part(const std::string& text, const std::string& where);
/// "3/16"
std::string format_part(const Part& part);

}  // namespace dashpot
