#pragma once
#include "dashpot/damper/neural/simd/lanes.h"

namespace dashpot {
namespace {

/// An element of the left factor: at[row * row_step + depth * depth_step].
template <class Real>
struct Left {
  const Real* at;
  std::size_t row_step, depth_step;
};
/// Rows of lanes; step 0 repeats the first row.
template <class Real>
struct Rows {
  Real* at;
  std::size_t step;
};

/// Rows x Columns vectors of  to = start + left * right,  the sums in registers.
template <class Real, std::size_t kRows, std::size_t kColumns>
void multiply_tile(std::size_t depth, Left<Real> left, Rows<const Real> right, Rows<const Real> start,
                   Rows<Real> to) {
  constexpr std::size_t kSize = kLanes<Real>;
  Lanes<Real> sums[kRows][kColumns];
#pragma GCC unroll 16
  for (std::size_t r = 0; r < kRows; ++r)
#pragma GCC unroll 4
    for (std::size_t c = 0; c < kColumns; ++c) sums[r][c] = load(start.at + r * start.step + c * kSize);
  for (std::size_t k = 0; k < depth; ++k) {
    Lanes<Real> lanes[kColumns];
#pragma GCC unroll 4
    for (std::size_t c = 0; c < kColumns; ++c) lanes[c] = load(right.at + k * right.step + c * kSize);
#pragma GCC unroll 16
    for (std::size_t r = 0; r < kRows; ++r) {
      const Real factor = left.at[r * left.row_step + k * left.depth_step];
#pragma GCC unroll 4
      for (std::size_t c = 0; c < kColumns; ++c) sums[r][c] += factor * lanes[c];
    }
  }
#pragma GCC unroll 16
  for (std::size_t r = 0; r < kRows; ++r)
#pragma GCC unroll 4
    for (std::size_t c = 0; c < kColumns; ++c) store(to.at + r * to.step + c * kSize, sums[r][c]);
}

/// How many rows of sums, their operands beside them, the registers hold.
template <std::size_t kColumns>
constexpr std::size_t kTileRows = kRegisters == 32 ? (kColumns == 1   ? 12
                                                      : kColumns == 2 ? 10
                                                      : kColumns == 3 ? 8
                                                                      : 6)
                                                   : (kColumns == 1 ? 10 : 6);
constexpr std::size_t kTileColumns = kRegisters == 32 ? 4 : 2;

template <class Real>
using TileFunction = void (*)(std::size_t, Left<Real>, Rows<const Real>, Rows<const Real>, Rows<Real>);

template <class Real, std::size_t kColumns, std::size_t... Less>
void multiply_columns(std::size_t rows, std::size_t depth, Left<Real> left, Rows<const Real> right,
                      Rows<const Real> start, Rows<Real> to, std::index_sequence<Less...>) {
  static constexpr TileFunction<Real> kTiles[] = {&multiply_tile<Real, Less + 1, kColumns>...};
  const std::size_t tiles = (rows + sizeof...(Less) - 1) / sizeof...(Less);
  for (std::size_t t = 0; t < tiles; ++t) {  // of sizes that differ by one at most
    const std::size_t first = t * rows / tiles, last = (t + 1) * rows / tiles;
    kTiles[last - first - 1](depth, {left.at + first * left.row_step, left.row_step, left.depth_step}, right,
                             {start.at + first * start.step, start.step}, {to.at + first * to.step, to.step});
  }
}

/// to = start + left * right, of `rows` rows and `columns` whole vectors. `to` may be `start`.
template <class Real>
void multiply(std::size_t rows, std::size_t columns, std::size_t depth, Left<Real> left,
              Rows<const Real> right, Rows<const Real> start, Rows<Real> to) {
  const auto run = [&]<std::size_t kColumns>() {
    multiply_columns<Real, kColumns>(rows, depth, left, right, start, to,
                                     std::make_index_sequence<kTileRows<kColumns>>());
  };
  const std::size_t once = kTileColumns * kLanes<Real>;
  for (; columns > kTileColumns; columns -= kTileColumns) {
    run.template operator()<kTileColumns>();
    right.at += once;
    start.at += once;
    to.at += once;
  }
  switch (columns) {
    case 1:
      return run.template operator()<1>();
    case 2:
      return run.template operator()<2>();
    case 3:
      return run.template operator()<kTileColumns == 4 ? 3 : 1>();
    default:
      return run.template operator()<kTileColumns>();
  }
}

/// A row of zeros to start sums from, for up to 256 columns.
template <class Real>
Rows<const Real> zeros() {
  alignas(64) static constexpr Real kZeros[256] = {};
  return {kZeros, 0};
}

}  // namespace
}  // namespace dashpot
