#pragma once
#include <cstddef>

namespace dashpot {

/// The explicit Runge-Kutta method of J. R. Dormand and P. J. Prince, J. Comput. Appl. Math. 6
/// (1980) 19-26, for y' = f(t, y): seven stages, order 5, with an embedded solution of order 4.
///
///     c   | a                                                            k_i = f(t + c_i h,
///     ----+------------------------------------------------------------    y + h sum a_ij k_j)
///     0   |
///     1/5 |       1/5
///     3/10|      3/40        9/40
///     4/5 |     44/45      -56/15       32/9
///     8/9 |19372/6561 -25360/2187 64448/6561 -212/729
///     1   | 9017/3168     -355/33 46732/5247   49/176  -5103/18656
///     1   |    35/384           0   500/1113  125/192   -2187/6784    11/84
///     ----+------------------------------------------------------------
///     y_5 |    35/384           0   500/1113  125/192   -2187/6784    11/84     0
///     y_4 |5179/57600           0 7571/16695  393/640 -92097/339200 187/2100 1/40
///
/// The last stage stands at the end y_5 of the step, so that its slope is the first of the next
/// one. The error of a step is taken to be h e . k = y_5 - y_4, of order h^5: the length that just
/// meets a tolerance goes as (tolerance / error)^(1/5).
struct DormandPrince {
  static constexpr std::size_t kStages = 7;
  static constexpr double kPower = 0.2;  ///< 1 / 5, of error in the length of the next step

  /// c: where in the step each stage stands, in shares of it.
  static constexpr double kAt[kStages] = {0, 0.2, 0.3, 0.8, 8.0 / 9, 1, 1};

  /// a: how much each stage takes of the slopes before it; the last row gives the end of the step.
  static constexpr double kFrom[kStages][kStages - 1] = {
      {},
      {0.2},
      {3.0 / 40, 9.0 / 40},
      {44.0 / 45, -56.0 / 15, 32.0 / 9},
      {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
      {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
      {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};

  /// e: y_5 - y_4 over h.
  static constexpr double kError[kStages] = {
      71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
};

/// The classical Runge-Kutta method of order 4, with the error of R. Balac and F. Mahe, Comput.
/// Phys. Commun. 184 (2013) 1211-1219: an embedded solution of order 3 takes a tenth of the slope
/// at the end of the step, which is the first of the next one, in place of that of the last stage.
///
///     c  |  a
///     ---+-----------------------
///     0  |
///     1/2| 1/2
///     1/2|  0   1/2
///     1  |  0    0    1
///     1  | 1/6  1/3  1/3  1/6
///     ---+-----------------------
///     y_4| 1/6  1/3  1/3  1/6    0
///     y_3| 1/6  1/3  1/3 1/15 1/10
struct ClassicalRungeKutta {
  static constexpr std::size_t kStages = 5;
  static constexpr double kAt[kStages] = {0, 0.5, 0.5, 1, 1};
  static constexpr double kFrom[kStages][kStages - 1] = {
      {}, {0.5}, {0, 0.5}, {0, 0, 1}, {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6}};
  static constexpr double kError[kStages] = {0, 0, 0, 0.1, -0.1};
};

/// A method is consistent where each stage's row sums up to where it stands, and the weights of the
/// error to 0.
template <class Method>
constexpr bool is_consistent() {
  const auto is_rounding = [](double off) { return off < 1e-14 && off > -1e-14; };
  double errors = 0;
  for (std::size_t stage = 0; stage < Method::kStages; ++stage) {
    double off = -Method::kAt[stage];
    for (const double weight : Method::kFrom[stage]) off += weight;
    if (!is_rounding(off)) return false;
    errors += Method::kError[stage];
  }
  return is_rounding(errors);
}
static_assert(is_consistent<DormandPrince>() && is_consistent<ClassicalRungeKutta>());

}  // namespace dashpot
