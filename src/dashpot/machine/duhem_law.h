#pragma once
#include "dashpot/damper/law.h"

namespace dashpot {

/// A hysteresis without a name, for where no law is to be presumed: a first-order Duhem operator,
/// alike in both directions, whose slope is a polynomial of its state,
///   z' = v f(z) where v > 0, v f(-z) where v < 0
///   f(z) = 1 + a1 z + a2 z^2 + a3 z^3 + a4 z^4 + b1 |z| + b3 |z|^3
///   F = w z + c v + k3 x^3
/// beside the plant's own spring and dashpot. Dahl's and Bouc-Wen's hystereses of whole exponents
/// up to 4 are among those that it can be. Any signs are allowed, so that nothing keeps it from
/// feeding energy in. It is in no list of laws and no model file can hold it: it serves
/// identify_in_plant() alone. Source: B. Jayawardhana, H. Logemann, E. P. Ryan, Nonlinear Anal.
/// Real World Appl. 9 (2008), for the class; the polynomial is ours.
const Law& duhem_law();

}  // namespace dashpot
