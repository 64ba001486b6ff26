#pragma once
#include <string>
#include <string_view>

namespace dashpot {

/// A unit that people see: number = factor * the number in SI.
struct PrintUnit {
  std::string name;
  double factor = 1;
};

/// The units in which people see forces and motions; models, JSON and every calculation are in SI.
class PrintUnits {
 public:
  PrintUnits() = default;  ///< N, mm and mm/s: of every screen and page that is not asked for more
  static PrintUnits si();
  /// "lbf,in/s", "kN,m/s": a unit of force and a length per second, as parse_unit() knows them.
  /// Throws Error(where, ...) on anything else.
  static PrintUnits parse(std::string_view text, const std::string& where);

  /// How a quantity is shown that is "N", "m", "m/s", "m/s^2", "m/s^1.75", "N/m", "N*s/m", "J" or
  /// "W" in SI: what is composed of force and length follows them, in metres where the length is
  /// metric. Every other unit is shown as it is.
  PrintUnit of(std::string_view si_unit) const;

 private:
  PrintUnit force_{"N", 1}, length_{"mm", 1000};
};

}  // namespace dashpot
