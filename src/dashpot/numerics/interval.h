#pragma once
#include <algorithm>
#include <cmath>

namespace dashpot {

/// A number that lies somewhere between two doubles. Whatever is computed from intervals encloses
/// what exact arithmetic would make of any numbers inside them, as long as nothing overflows.
///
/// Rounding to nearest misses the exact result of an operation by at most 2^-53 of it, or 2^-1075
/// where it underflows. Each result is moved outwards by four times that, which covers the
/// rounding of the move itself too; a fused multiply-add only rounds less often.
struct Interval {
  double low = 0, high = 0;

  constexpr Interval() = default;
  constexpr Interval(double exact) : low(exact), high(exact) {}  // implicit: doubles are exact
  constexpr Interval(double least, double greatest) : low(least), high(greatest) {}
};

inline Interval outwards(double low, double high) {
  constexpr double kRelative = 0x1p-51, kUnderflow = 0x1p-1070;
  return {low - (std::abs(low) * kRelative + kUnderflow),
          high + (std::abs(high) * kRelative + kUnderflow)};
}

inline Interval operator-(const Interval& a) { return {-a.high, -a.low}; }
inline Interval operator+(const Interval& a, const Interval& b) {
  return outwards(a.low + b.low, a.high + b.high);
}
inline Interval operator-(const Interval& a, const Interval& b) { return a + -b; }
inline Interval operator*(const Interval& a, const Interval& b) {
  const double ll = a.low * b.low, lh = a.low * b.high, hl = a.high * b.low, hh = a.high * b.high;
  return outwards(std::min(std::min(ll, lh), std::min(hl, hh)),
                  std::max(std::max(ll, lh), std::max(hl, hh)));
}
/// a / b for a b that does not contain 0.
inline Interval operator/(const Interval& a, const Interval& b) {
  return a * outwards(1 / b.high, 1 / b.low);
}
inline Interval& operator+=(Interval& a, const Interval& b) { return a = a + b; }
inline Interval& operator-=(Interval& a, const Interval& b) { return a = a - b; }

}  // namespace dashpot
