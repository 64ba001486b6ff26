#pragma once
#include <limits>

#include "dashpot/plant.h"

// The forces of a plant that are not linear in its motion: friction and stops of a strut, and a
// tyre that lifts. These are the only texts of them. simulate() takes them with Number = double,
// rides in lanes with a vector that holds a number per vehicle.
//
//   strut     F = F_c tanh(v / v_s) + k_s e(d)         N, resists extension where positive
//             e = d - d_e      where d > d_e           m beyond the stop of extension
//               = d + d_c      where d < -d_c          m beyond the stop of compression
//               = 0            else
//   tyre      P = k h + c h'                           N, from the road at height h alone
//             L = L_0 + P - k y - c y'                 N, load of a wheel at height y on the road
//             on the wheel   P - min(L, 0)             where the tyre may lift: it does not pull
//
// d m and v m/s of the strut, extension positive; h and y m, up.
namespace dashpot {

/// F_c, d_e, d_c and k_s of a strut.
template <class Number>
struct StrutResistance {
  Number friction;          ///< N
  Number extension_stop;    ///< m of travel; infinite: none
  Number compression_stop;  ///< m of travel; infinite: none
  Number stop_stiffness;    ///< N/m
};

/// k, c and L_0 of a tyre.
template <class Number>
struct TyreContact {
  Number stiffness;    ///< N/m
  Number damping;      ///< N*s/m
  Number static_load;  ///< N, at rest
  Number may_lift;     ///< 1: it only pushes; 0: it pulls as well
};

inline StrutResistance<double> resistance_of(const Strut& strut) {
  const auto travel = [](double stop) {
    return stop > 0 ? stop : std::numeric_limits<double>::infinity();
  };
  return {strut.friction, travel(strut.extension_stop), travel(strut.compression_stop),
          strut.stop_stiffness};
}

inline TyreContact<double> contact_of(const Tyre& tyre, bool may_lift) {
  return {tyre.stiffness, tyre.damping, tyre.static_load, may_lift ? 1.0 : 0.0};
}

// Inline wherever they are called: the lanes are compiled once per instruction set, and of a
// function out of line the linker would keep one copy for all of them, perhaps one that this
// processor lacks the instructions for.

/// e(d), m.
template <class Number>
[[gnu::always_inline]] inline Number beyond_stop(const StrutResistance<Number>& strut,
                                                 Number deflection) {
  return deflection > strut.extension_stop      ? deflection - strut.extension_stop
         : deflection < -strut.compression_stop ? deflection + strut.compression_stop
                                                : Number{};
}

/// F, N. sliding: tanh(v / v_s), which simulate() and the lanes each have a function for.
template <class Number>
[[gnu::always_inline]] inline Number strut_resistance(const StrutResistance<Number>& strut,
                                                      Number deflection, Number sliding) {
  return strut.friction * sliding + strut.stop_stiffness * beyond_stop(strut, deflection);
}

/// P, N, from the road's height and its rate.
template <class Number>
[[gnu::always_inline]] inline Number road_push(const TyreContact<Number>& tyre, Number height,
                                               Number rate) {
  return tyre.stiffness * height + tyre.damping * rate;
}

/// L, N, from the road's push and the wheel's height and rate.
template <class Number>
[[gnu::always_inline]] inline Number tyre_load(const TyreContact<Number>& tyre, Number push,
                                               Number height, Number rate) {
  return tyre.static_load + push - tyre.stiffness * height - tyre.damping * rate;
}

/// The part of the road's push that reaches the wheel under this load, N.
template <class Number>
[[gnu::always_inline]] inline Number push_on_wheel(const TyreContact<Number>& tyre, Number push,
                                                   Number load) {
  const Number pull = load < 0 ? load : Number{};
  return push - tyre.may_lift * pull;
}

}  // namespace dashpot
