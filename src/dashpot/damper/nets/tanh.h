#pragma once
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace dashpot {

/// Hyperbolic tangent within 4 ulp, without branches or calls, so that loops over it become SIMD
/// code.
///
///   tanh|x| = e / (e + 2),   e = exp(2|x|) - 1 = 2^k expm1(r) + (2^k - 1)
///   2|x| = k ln 2 + r,   |r| <= ln 2 / 2
///
/// Exact in sign and odd to the last bit; a NaN stays one.
[[gnu::always_inline]] inline double branchless_tanh(double x) noexcept {
  constexpr double kLog2E = 1.44269504088896338700,
                   kRound = 0x1.8p52;  // adding kRound rounds to an integer
  constexpr double kLn2High = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;
  const double twice = 2 * std::abs(x);
  const double y = twice > 40 ? 40 : twice;  // tanh(20) rounds to 1; a NaN passes

  const double shifted = y * kLog2E + kRound;
  const double k = shifted - kRound;
  const double power = std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + 1023) << 52);
  const double r = (y - k * kLn2High) - k * kLn2Low;

  // Taylor series of expm1 up to r^14 / 14!: the rest is below 1e-18.
  double series = 1.0 / 87178291200;
  series = series * r + 1.0 / 6227020800;
  series = series * r + 1.0 / 479001600;
  series = series * r + 1.0 / 39916800;
  series = series * r + 1.0 / 3628800;
  series = series * r + 1.0 / 362880;
  series = series * r + 1.0 / 40320;
  series = series * r + 1.0 / 5040;
  series = series * r + 1.0 / 720;
  series = series * r + 1.0 / 120;
  series = series * r + 1.0 / 24;
  series = series * r + 1.0 / 6;
  series = series * r + 0.5;
  const double e = power * (series * r * r + r) + (power - 1);
  return std::copysign(e / (e + 2), x);
}

/// The same of `count` numbers, which go beside each other.
inline void branchless_tanh(double* numbers, std::size_t count) noexcept {
  for (std::size_t k = 0; k < count; ++k) numbers[k] = branchless_tanh(numbers[k]);
}

}  // namespace dashpot
