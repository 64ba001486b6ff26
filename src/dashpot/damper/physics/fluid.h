#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/damper/physics/fluid_curves.h"

namespace dashpot {

/// From the same table of the family paper as kFamily140CG.
extern const FamilyFluid kFamily122EG;

/// A magnetorheological fluid that is known by name. Rows of a table that lives as long as the
/// program.
struct Fluid {
  std::string_view name;                ///< "140CG"
  double viscosity;                     ///< Pa*s at 40 degC, from its data sheet
  double density_min, density_max;      ///< kg/m^3, from its data sheet
  double solids;                        ///< share of the mass; recalled, not verified
  double volume_fraction;               ///< of iron, as Carlson's laws take it
  bool volume_fraction_verified;        ///< false: recalled, agrees with `solids`
  const FamilyFluid* family = nullptr;  ///< the family paper's polynomials, where it has them
};

/// All of them: 122EG, 132DG and 140CG.
std::span<const Fluid> fluids();
/// Throws Error "unknown fluid '140CH'; did you mean ...".
const Fluid& find_fluid(std::string_view name, const std::string& where = {});

/// Yield stress of 122EG, Pa, as the input files of the family paper's data set have it, in place
/// of the paper's polynomial: four points, straight between them, held beyond the last.
double measured_yield_stress_122eg(double field);

/// The faults of the family paper's polynomials for this fluid up to a field in A/m, a sentence
/// each.
std::vector<std::string> family_warnings(const Fluid& fluid, double largest_field);

}  // namespace dashpot
