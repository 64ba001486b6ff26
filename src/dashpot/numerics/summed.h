#pragma once
#include <algorithm>
#include <cmath>

#include "dashpot/numerics/interval.h"

namespace dashpot {

/// A sum of products and its size: the same sum with every term counted as positive. It tells the
/// exact sum as an interval does, at a tenth of the cost, where
///   - what it is made of is exact, or an Interval,
///   - no term takes more than 100 roundings on its way, those of its factors counted together,
///   - what underflows meets at most six more factors, none of them as large as kGreatest.
/// Then the exact sum differs from the value by at most 100 * 2^-53 of the size. 128 times covers
/// the roundings of the size and of the interval, too.
struct Summed {
  static constexpr double kGreatest = 1e30;
  double value = 0, size = 0;

  constexpr Summed() = default;
  constexpr Summed(double exact) : value(exact), size(exact < 0 ? -exact : exact) {}  // implicit
  constexpr Summed(double sum, double of_all) : value(sum), size(of_all) {}

  /// Its width is at most 8 roundings of the size.
  Summed(const Interval& a)
      : value(0.5 * (a.low + a.high)),
        size(std::max({std::abs(a.low), std::abs(a.high), (a.high - a.low) * 0x1p50})) {}

  /// Encloses the exact sum.
  Interval interval() const {
    const double error = size * 0x1p-46 + 1e-120;
    return {value - error, value + error};
  }
};

inline Summed operator+(const Summed& a, const Summed& b) {
  return {a.value + b.value, a.size + b.size};
}
inline Summed operator-(const Summed& a, const Summed& b) {
  return {a.value - b.value, a.size + b.size};
}
inline Summed operator*(const Summed& a, const Summed& b) {
  return {a.value * b.value, a.size * b.size};
}
inline Summed operator-(const Summed& a) { return {-a.value, a.size}; }
inline Summed& operator+=(Summed& a, const Summed& b) { return a = a + b; }
inline Summed& operator-=(Summed& a, const Summed& b) { return a = a - b; }
/// By a double above 0, whose roundings count.
inline Summed scaled(double factor, const Summed& a) { return {factor * a.value, factor * a.size}; }

}  // namespace dashpot
