#include "dashpot/physics/flux_curve.h"

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/physics/fluid_curves.h"

namespace dashpot {

namespace {
constexpr double kMostPolarisation = 3;  // T; iron with cobalt has 2.45
}

CurvePoints read_flux_curve(const Value& value) {
  CurvePoints curve = read_points(value, "A/m", "T");
  require_rising(curve, value, "the flux density", true);
  if (curve.front().second != 0)
    throw Error(value.where(), "there is a flux density without field", "a first point [0, 0]");
  for (std::size_t k = 1; k < curve.size(); ++k)
    if (const auto& [field, flux] = curve[k]; flux - DASHPOT_MU0 * field > kMostPolarisation)
      throw Error(value.items()[k].where(),
                  "a flux density of " + format_number(flux) + " T at a field of " +
                      format_number(field) + " A/m, which no material has",
                  "pairs of A/m and T, in this order");
  return curve;
}

double field_on(const CurvePoints& curve, double flux_density) noexcept {
  const auto& last = curve.back();
  if (flux_density >= last.second) return last.first + (flux_density - last.second) / DASHPOT_MU0;
  for (std::size_t k = 1;; ++k) {
    const auto &a = curve[k - 1], &b = curve[k];
    if (flux_density < b.second)
      return a.first + (b.first - a.first) * (flux_density - a.second) / (b.second - a.second);
  }
}

}  // namespace dashpot
