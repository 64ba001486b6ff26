#pragma once
#include "dashpot/damper/nets/kernel.h"
#include "dashpot/damper/nets/simd/intrinsics.h"

// The one product of matrices that forward and backward passes, and Jacobians, are made of. The
// left factor is read number by number and spread over the lanes, the right factor and the result
// by vectors. A tile of rows x vectors of the result stays in registers over the whole depth.
//
//   tile, rows x vectors      1 vector   2 vectors   4 vectors
//   16 registers               10 x 1      6 x 2         -
//   32 registers               12 x 1     10 x 2       6 x 4    (samples as lanes only)
//
// A tile needs rows x vectors sums and as many vectors of the right factor; what is left of the
// registers holds the spread number of the left factor.
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

/// The start of a product's sums, and the last step on them while they are still in registers.
enum class Form {
  Sum,      ///< from 0
  Gated,    ///< from 0; 0 where `bound` is not positive
  Neurons,  ///< a row from the row `start`; no lane below that of the row `bound`
  Samples,  ///< a row from its number in `start`; no lane below the number at `bound`
};

/// to = left * right, sums of `depth` products each, in some Form.
template <class Real>
struct Product {
  std::size_t depth;
  Left<Real> left;
  Rows<const Real> right;
  Rows<Real> to;
  Rows<const Real> start{}, bound{};
};

template <Form kForm, class Real>
inline Lanes<Real> first_sum(const Real* start, std::size_t lane) {
  if constexpr (kForm == Form::Neurons) return load(start + lane);
  if constexpr (kForm == Form::Samples) return Lanes<Real>{} + *start;
  return Lanes<Real>{};
}
template <Form kForm, class Real>
inline Lanes<Real> last_sum(Lanes<Real> sum, const Real* bound, std::size_t lane) {
  if constexpr (kForm == Form::Gated) return load(bound + lane) > 0 ? sum : Lanes<Real>{};
  if constexpr (kForm == Form::Neurons) return larger(load(bound + lane), sum);
  if constexpr (kForm == Form::Samples) return larger(Lanes<Real>{} + *bound, sum);
  return sum;
}

/// Usual steps of the left factor from row to row, which the compiler should know; 0 stands for any
/// other.
template <class Real>
constexpr std::size_t kOneLine = kKernelAlign / sizeof(Real);

/// `tiles` times kRows rows of kColumns vectors of a product from row `first` on, their sums in
/// registers.
template <class Real, Form kForm, std::size_t kRows, std::size_t kColumns, std::size_t kStep>
void multiply_tiles(std::size_t tiles, std::size_t first, const Product<Real>& product) {
  constexpr std::size_t kSize = kLanes<Real>;
  const std::size_t row_step = kStep ? kStep : product.left.row_step,
                    depth_step = product.left.depth_step;
  const std::size_t right_step = product.right.step, depth = product.depth;
  const Real* left = product.left.at + first * row_step;
  const Real* start = product.start.at + first * product.start.step;
  const Real* bound = product.bound.at + first * product.bound.step;
  Real* to = product.to.at + first * product.to.step;
  static_assert(kRows <= 16 && kColumns <= 4, "as far as the loops below are unrolled");
  static_assert(kRows * kColumns + kColumns < kRegisters, "a tile stays in registers");
  for (; tiles > 0; --tiles, left += kRows * row_step) {
    // Start the sums.
    Lanes<Real> sums[kRows][kColumns];
#pragma GCC unroll 16
    for (std::size_t r = 0; r < kRows; ++r, start += product.start.step)
#pragma GCC unroll 4
      for (std::size_t c = 0; c < kColumns; ++c) sums[r][c] = first_sum<kForm>(start, c * kSize);

    // Add products down the depth: kColumns vectors of the right factor serve all rows of the tile.
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

    // Bound or gate the sums, and store them.
#pragma GCC unroll 16
    for (std::size_t r = 0; r < kRows; ++r, to += product.to.step, bound += product.bound.step)
#pragma GCC unroll 4
      for (std::size_t c = 0; c < kColumns; ++c)
        store(to + c * kSize, last_sum<kForm, Real>(sums[r][c], bound, c * kSize));
  }
}

/// Vectors beside each other in a tile: a block of samples fills many.
template <Form kForm>
constexpr std::size_t kTileColumns = kForm == Form::Samples && kRegisters == 32 ? 4 : 2;
/// How many rows of sums, their operands beside them, the registers hold.
template <std::size_t kColumns>
constexpr std::size_t kTileRows = kColumns == 1                       ? kRegisters == 32 ? 12 : 10
                                  : kColumns == 2 && kRegisters == 32 ? 10
                                                                      : 6;

/// All rows of kColumns vectors, in tiles whose heights differ by one at most.
template <class Real, Form kForm, std::size_t kColumns, std::size_t kStep, std::size_t... Less>
inline void multiply_rows(std::size_t rows, const Product<Real>& product,
                          std::index_sequence<Less...>) {
  using Function = void (*)(std::size_t, std::size_t, const Product<Real>&);
  static constexpr Function kTiles[] = {&multiply_tiles<Real, kForm, Less + 1, kColumns, kStep>...};

  // As few tiles as hold all rows, then as low as that many may be, counted, which takes less time
  // than to divide. `higher` of them have one row more than the others.
  std::size_t tiles = 1, height = sizeof...(Less);
  while (tiles * height < rows) ++tiles;
  while (tiles * height > rows) --height;

  const std::size_t higher = rows - tiles * height;
  if (higher > 0) kTiles[height](higher, 0, product);
  kTiles[height - 1](tiles - higher, higher * (height + 1), product);
}

/// All rows of kColumns vectors. Steps of the left factor that networks have most are told to the
/// compiler as constants: 1, where it is read across, and one cache line, that of a narrow layer.
template <class Real, Form kForm, std::size_t kColumns>
inline void multiply_columns(std::size_t rows, const Product<Real>& product) {
  constexpr auto kHeights = std::make_index_sequence<kTileRows<kColumns>>();
  if constexpr (kForm == Form::Sum)
    if (product.left.row_step == 1)
      return multiply_rows<Real, kForm, kColumns, 1>(rows, product, kHeights);
  if constexpr (kForm != Form::Samples)
    if (product.left.row_step == kOneLine<Real>)
      return multiply_rows<Real, kForm, kColumns, kOneLine<Real>>(rows, product, kHeights);
  multiply_rows<Real, kForm, kColumns, 0>(rows, product, kHeights);
}

/// A product of `rows` rows and `columns` whole vectors; Form::Samples: of multiples of
/// kTileColumns.
template <Form kForm, class Real>
inline void multiply(std::size_t rows, std::size_t columns, const Product<Real>& product) {
  constexpr std::size_t kWide = kTileColumns<kForm>, kStep = kWide * kLanes<Real>;
  if constexpr (kForm != Form::Samples)
    if (columns == 1) return multiply_columns<Real, kForm, 1>(rows, product);
  if (columns == kWide) return multiply_columns<Real, kForm, kWide>(rows, product);

  // Wide tiles from left to right, and a narrow one for an odd vector at the end.
  Product<Real> part = product;
  for (; columns >= kWide; columns -= kWide) {
    multiply_columns<Real, kForm, kWide>(rows, part);
    part.right.at += kStep;
    part.to.at += kStep;
    if constexpr (kForm == Form::Neurons) part.start.at += kStep;
    if constexpr (kForm == Form::Neurons || kForm == Form::Gated) part.bound.at += kStep;
  }
  if constexpr (kForm != Form::Samples)
    if (columns > 0) multiply_columns<Real, kForm, 1>(rows, part);
}

}  // namespace
}  // namespace dashpot
