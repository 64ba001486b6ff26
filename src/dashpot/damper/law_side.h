#pragma once
#include "dashpot/damper/law.h"

namespace dashpot {

/// The rows that a law with rebound and compression apart has behind its own, in this order.
inline constexpr std::string_view kSideFriction = "f_side", kSideViscous = "c_side",
                                  kSideSpeed = "v_side";

/// The same law with a valve beside it that works in one direction only (c_text/law_side.h): its
/// name, states and functions, and three more rows. A law that has them is returned as it is. Lives
/// as long as the program; safe to call from several threads.
const Law& with_side(const Law& law);

/// A copy of the law with those rows, for who keeps it himself.
Law extended_by_side(const Law& law);

/// Those rows, for who chooses parameters before a law has them.
std::span<const ParamInfo> side_rows();

/// N, what the valve adds to the force of a law with_side(); p: the law's parameters.
double side_force(const Law& law, const double* p, double v) noexcept;

}  // namespace dashpot
