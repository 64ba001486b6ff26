#pragma once
// Vectors of the instruction set that this text is compiled for, and what shuffles their lanes.
//
//   set      bytes  float  double  registers
//   AVX-512     64     16       8         32
//   AVX2        32      8       4         16
//   others      16      4       2         16
//
// Included by sources alone that are compiled once per instruction set. So everything here has
// internal linkage, and no inline function of the standard library is called: of those the linker
// keeps one copy for all, and that might be the one which needs AVX-512.
#include <cstddef>
#include <cstdint>
#include <utility>

namespace dashpot {
namespace {

// DASHPOT_NARROW_LANES: the instructions of the set on its shortest vectors, for few lanes.
#if defined(__AVX512F__)
#define DASHPOT_LANE_BYTES 64
constexpr std::size_t kRegisters = 32;
#elif defined(__AVX2__) && !defined(DASHPOT_NARROW_LANES)
#define DASHPOT_LANE_BYTES 32
constexpr std::size_t kRegisters = 16;
#else
#define DASHPOT_LANE_BYTES 16
constexpr std::size_t kRegisters = 16;
#endif
constexpr std::size_t kLaneBytes = DASHPOT_LANE_BYTES;

/// The format of a number and constants of tanh_lanes() for it. kRound: adding it to a small number
/// rounds that to an integer. kLn2High + kLn2Low = ln 2, the first with so few bits that its
/// product with an exponent is exact.
template <class Real>
struct Arithmetic;
template <>
struct Arithmetic<float> {
  using Bits = std::int32_t;
  static constexpr int kMantissa = 23, kBias = 127;
  static constexpr float kRound = 0x1.8p23f, kLn2High = 0x1.62e4p-1f, kLn2Low = 0x1.7f7d1cp-20f;
  static constexpr float kTanhOne = 10;  // from here on tanh x rounds to 1
};
template <>
struct Arithmetic<double> {
  using Bits = std::int64_t;
  static constexpr int kMantissa = 52, kBias = 1023;
  static constexpr double kRound = 0x1.8p52, kLn2High = 0x1.62e42feep-1,
                          kLn2Low = 0x1.a39ef35793c76p-33;
  static constexpr double kTanhOne = 20;
};

template <class Real>
struct LaneTypes {
  using Bits = typename Arithmetic<Real>::Bits;
  typedef Real Values __attribute__((vector_size(kLaneBytes)));
  typedef Bits Integers __attribute__((vector_size(kLaneBytes)));
};
template <class Real>
using Lanes = typename LaneTypes<Real>::Values;
template <class Real>
constexpr std::size_t kLanes = kLaneBytes / sizeof(Real);

/// kLanes numbers from anywhere: rows of inputs need not be aligned.
template <class Real>
inline Lanes<Real> load(const Real* from) {
  Lanes<Real> lanes;
  __builtin_memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
template <class Real>
inline void store(Real* to, Lanes<Real> lanes) {
  __builtin_memcpy(to, &lanes, sizeof lanes);
}

/// Transposes and sums over lanes, in rounds that each join lanes half as far apart as the last.
template <class Real>
struct Shuffle {
  using V = Lanes<Real>;
  static constexpr int kSize = static_cast<int>(kLanes<Real>);
  static_assert(kSize == 2 || kSize == 4 || kSize == 8 || kSize == 16,
                "the rounds below are written out for up to 16 lanes");
  static constexpr auto kSequence = std::make_integer_sequence<int, kSize>();

  /// Exchanges the lanes of `a` that have bit `Half` with those of `b` that have not.
  template <int Half, int... Lane>
  static void exchange(V& a, V& b, std::integer_sequence<int, Lane...>) {
    const V low = __builtin_shufflevector(a, b, ((Lane & Half) ? kSize + Lane - Half : Lane)...);
    b = __builtin_shufflevector(a, b, ((Lane & Half) ? kSize + Lane : Lane + Half)...);
    a = low;
  }
  template <int Half>
  static void exchange_all(V* rows) {
#pragma GCC unroll 16
    for (int r = 0; r < kSize; ++r)
      if (!(r & Half)) exchange<Half>(rows[r], rows[r + Half], kSequence);
  }
  /// Transposes a square of kSize rows.
  static void transpose(V* rows) {
    if constexpr (kSize > 8) exchange_all<8>(rows);
    if constexpr (kSize > 4) exchange_all<4>(rows);
    if constexpr (kSize > 2) exchange_all<2>(rows);
    exchange_all<1>(rows);
  }

  /// Halves of the groups of `Group` lanes of a and b, added.
  template <int Group, int... Lane>
  static V fold(V a, V b, std::integer_sequence<int, Lane...>) {
    constexpr int kHalf = Group / 2;
    return __builtin_shufflevector(a, b, (Lane / kHalf * Group + Lane % kHalf)...) +
           __builtin_shufflevector(a, b, (Lane / kHalf * Group + Lane % kHalf + kHalf)...);
  }
  template <int Group>
  static void fold_all(V* rows) {
#pragma GCC unroll 8
    for (int r = 0; r < Group / 2; ++r)
      rows[r] = fold<Group>(rows[2 * r], rows[2 * r + 1], kSequence);
  }
  /// Lane k of the result is the sum over the lanes of rows[k], kSize of them.
  static V sums(V* rows) {
    if constexpr (kSize > 8) fold_all<16>(rows);
    if constexpr (kSize > 4) fold_all<8>(rows);
    if constexpr (kSize > 2) fold_all<4>(rows);
    fold_all<2>(rows);
    return rows[0];
  }

  template <int Half, int... Lane>
  static V with_other(V a, std::integer_sequence<int, Lane...>) {
    return a + __builtin_shufflevector(a, a, (Lane ^ Half)...);
  }
  /// The sum over the lanes.
  static Real sum(V lanes) {
    if constexpr (kSize > 8) lanes = with_other<8>(lanes, kSequence);
    if constexpr (kSize > 4) lanes = with_other<4>(lanes, kSequence);
    if constexpr (kSize > 2) lanes = with_other<2>(lanes, kSequence);
    return with_other<1>(lanes, kSequence)[0];
  }
};

}  // namespace
}  // namespace dashpot
