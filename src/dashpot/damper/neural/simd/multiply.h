#pragma once
#include "dashpot/damper/neural/kernel.h"
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

/// to = start + left * right, of `depth` products each. `to` may be `start`.
template <class Real>
struct Product {
  std::size_t depth;
  Left<Real> left;
  Rows<const Real> right, start;
  Rows<Real> to;
};

/// Usual steps of the left factor from row to row, which the compiler should know; 0 stands for any other.
template <class Real>
constexpr std::size_t kOneLine = kKernelAlign / sizeof(Real);

/// `tiles` times kRows rows of kColumns vectors of a product from row `first` on, their sums in registers.
template <class Real, std::size_t kRows, std::size_t kColumns, std::size_t kStep>
void multiply_tiles(std::size_t tiles, std::size_t first, const Product<Real>& product) {
  constexpr std::size_t kSize = kLanes<Real>;
  const std::size_t row_step = kStep ? kStep : product.left.row_step, depth_step = product.left.depth_step;
  const std::size_t right_step = product.right.step, depth = product.depth;
  const Real* left = product.left.at + first * row_step;
  const Real* start = product.start.at + first * product.start.step;
  Real* to = product.to.at + first * product.to.step;
  for (; tiles > 0; --tiles) {
    Lanes<Real> sums[kRows][kColumns];
#pragma GCC unroll 16
    for (std::size_t r = 0; r < kRows; ++r)
#pragma GCC unroll 4
      for (std::size_t c = 0; c < kColumns; ++c)
        sums[r][c] = load(start + r * product.start.step + c * kSize);
    const Real* factors = left;
    const Real* right = product.right.at;
    for (std::size_t k = depth; k > 0; --k, factors += depth_step, right += right_step) {
      Lanes<Real> lanes[kColumns];
#pragma GCC unroll 4
      for (std::size_t c = 0; c < kColumns; ++c) lanes[c] = load(right + c * kSize);
#pragma GCC unroll 16
      for (std::size_t r = 0; r < kRows; ++r)
#pragma GCC unroll 4
        for (std::size_t c = 0; c < kColumns; ++c) sums[r][c] += factors[r * row_step] * lanes[c];
    }
#pragma GCC unroll 16
    for (std::size_t r = 0; r < kRows; ++r, to += product.to.step)
#pragma GCC unroll 4
      for (std::size_t c = 0; c < kColumns; ++c) store(to + c * kSize, sums[r][c]);
    left += kRows * row_step;
    start += kRows * product.start.step;
  }
}

/// How many rows of sums, their operands beside them, the registers hold.
template <std::size_t kColumns>
constexpr std::size_t kTileRows = kRegisters == 32 ? (kColumns == 1   ? 12
                                                      : kColumns == 2 ? 10
                                                      : kColumns == 3 ? 8
                                                                      : 6)
                                                   : (kColumns == 1 ? 10 : 6);
constexpr std::size_t kTileColumns = kRegisters == 32 ? 4 : 2;

/// All rows of kColumns vectors, in tiles whose heights differ by one at most.
template <class Real, std::size_t kColumns, std::size_t kStep, std::size_t... Less>
inline void multiply_columns(std::size_t rows, const Product<Real>& product, std::index_sequence<Less...>) {
  using Function = void (*)(std::size_t, std::size_t, const Product<Real>&);
  static constexpr Function kTiles[] = {&multiply_tiles<Real, Less + 1, kColumns, kStep>...};
  const auto count = static_cast<std::uint32_t>(rows);  // divided quicker than 64 bits
  const std::uint32_t tiles = (count + sizeof...(Less) - 1) / sizeof...(Less);
  const std::uint32_t height = count / tiles, higher = count % tiles;
  if (higher > 0) kTiles[height](higher, 0, product);
  kTiles[height - 1](tiles - higher, higher * (height + 1), product);
}

template <class Real, std::size_t kColumns>
inline void multiply_columns(std::size_t rows, const Product<Real>& product) {
  constexpr auto kHeights = std::make_index_sequence<kTileRows<kColumns>>();
  if (product.left.row_step == 1) return multiply_columns<Real, kColumns, 1>(rows, product, kHeights);
  if (product.left.row_step == kOneLine<Real>)
    return multiply_columns<Real, kColumns, kOneLine<Real>>(rows, product, kHeights);
  multiply_columns<Real, kColumns, 0>(rows, product, kHeights);
}

/// Up to kTileColumns vectors.
template <class Real>
void multiply_few(std::size_t rows, std::size_t columns, const Product<Real>& product) {
  switch (columns) {
    case 1:
      return multiply_columns<Real, 1>(rows, product);
    case 2:
      return multiply_columns<Real, 2>(rows, product);
    case 3:
      return multiply_columns<Real, kTileColumns == 4 ? 3 : 1>(rows, product);
    default:
      return multiply_columns<Real, kTileColumns>(rows, product);
  }
}

/// A product of `rows` rows and `columns` whole vectors.
template <class Real>
void multiply(std::size_t rows, std::size_t columns, const Product<Real>& product) {
  if (columns <= kTileColumns) return multiply_few(rows, columns, product);
  Product<Real> part = product;
  for (; columns > kTileColumns; columns -= kTileColumns) {
    multiply_columns<Real, kTileColumns>(rows, part);
    part.right.at += kTileColumns * kLanes<Real>;
    part.start.at += kTileColumns * kLanes<Real>;
    part.to.at += kTileColumns * kLanes<Real>;
  }
  multiply_few(rows, columns, part);
}

/// A row of zeros to start sums from, for up to 256 columns.
template <class Real>
Rows<const Real> zeros() {
  alignas(64) static constexpr Real kZeros[256] = {};
  return {kZeros, 0};
}

}  // namespace
}  // namespace dashpot
