#pragma once
#include <memory>
#include <span>
#include <string_view>

#include "dashpot/damper_model.h"

namespace dashpot {

/// A damper as it is built, for studies that must know the truth: none of the models has all of
/// its parts, most have none of the parts that make one row of true_dampers() differ from the next.
/// SI.
///
///   rod ---+--- spring --- valve ---+--- gas, friction in parallel with both
///
/// Valve: |f| below the yield force: f = preyield w; above: yield + viscous (|w| - w_y) + orifice
/// (|w| - w_y)^2, w_y = yield / preyield; yield = yield_off + yield_per_ampere I / sqrt(1 + (I /
/// saturation)^2) of the coil's current I. In compression all of it times `compression`.
struct TrueDamperParts {
  std::string_view name, what;  ///< "series_spring"; how it is built
  double preyield = 4e4;        ///< N*s/m
  double viscous = 900;         ///< N*s/m
  double orifice = 0;           ///< N*s^2/m^2
  double yield_off = 80, yield_per_ampere = 550, saturation = 2;  ///< N, N/A, A
  double compression = 1;   ///< valve force in compression over that in rebound
  double spring = 0;        ///< N/m, between rod and valve (compressible oil, bushings); 0: rigid
  double friction = 0;      ///< N, of the seals, an elastic bristle
  double bristle = 1e-4;    ///< m of way until they slide
  double coil_lag = 0;      ///< s, of the current behind its command
  double gas = 0;           ///< N at the middle of the stroke; pushes the rod out
  double gas_length = 0.1;  ///< m of compression that would use up the gas
  double bypass = 0;        ///< the valve's force grows by this over 20 mm from the middle
  double fading = 0;        ///< the valve's force falls by this share per kJ taken up, and
  double cooling = 20;      ///< recovers within this time, s
};

/// They differ in kind. The error model was chosen on the first kChosenOn of them; the others
/// judge it.
std::span<const TrueDamperParts> true_dampers();
inline constexpr std::size_t kChosenOn = 4;

std::shared_ptr<const DamperModel> make_true_damper(const TrueDamperParts& parts);

}  // namespace dashpot
