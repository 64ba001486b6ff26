#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dashpot/physics/fluid_curves.h"
#include "dashpot/value.h"

namespace dashpot {

/// One way in which a fluid's yield stress follows the field, and the field the flux density: by
/// Carlson's laws of its volume fraction of iron, by polynomials, or by points that are joined by
/// straight lines and held beyond the last.
struct FluidLaw {
  std::string name;  ///< by which a drawing's `yield` chooses it
  double volume_fraction = 0;
  bool verified = true;  ///< false: the volume fraction is recalled, not from a data sheet

  /// Points of A/m against T and of Pa against A/m, ascending from 0; empty: the polynomial, or
  /// with a volume fraction Carlson's.
  std::vector<std::pair<double, double>> flux_densities, yield_stresses;
  bool has_field_polynomial = false, has_yield_polynomial = false;
  FamilyFluid polynomial{};
  double scale = 1;                 ///< times which the yield stress is taken
  std::vector<std::string> faults;  ///< what a user of it should know, a sentence each

  /// A/m in the fluid at a flux density >= 0, T.
  double field(double flux_density) const;
  /// Pa at a field >= 0. carrier: factor of Carlson's law, see carlson_yield_stress.
  double yield_stress(double field, double carrier) const;
};

/// A magnetorheological fluid, as its file states it; SI. docs/physics.md describes the file.
struct Fluid {
  std::string name, source, note;
  double density_min = 0, density_max = 0;  ///< kg/m^3
  double solids = 0;                        ///< share of the mass; 0: not stated
  /// K and Pa*s, ascending: the logarithm is straight between them, held beyond. One: at 40 degC.
  std::vector<std::pair<double, double>> viscosities;
  /// tau = tau_y + K rate^index, where the viscosity is what K rate^index comes to at shear_rate,
  /// 1/s, over that. 1: a Bingham fluid.
  double index = 1, shear_rate = 0;
  std::vector<FluidLaw> laws;  ///< the first one is taken unless a drawing names another
  /// Standard deviations, as shares.
  double yield_uncertainty = 0, viscosity_uncertainty = 0;

  double viscosity(double temperature) const;
  /// Of the name; "": the first. nullptr where it has none of that name.
  const FluidLaw* law(std::string_view named) const;
};

/// Names of the fluids that come with Dashpot, data/fluids.
std::vector<std::string> fluid_names();
/// A fluid by the name of one that comes with Dashpot; by its file, relative to the folder, where
/// the text ends in .yaml or .yml; read once where it comes with Dashpot. Throws Error "unknown
/// fluid '140CH'; did you mean ...", and what parse_fluid does.
std::shared_ptr<const Fluid> find_fluid(std::string_view name, const std::string& where = {},
                                        const std::filesystem::path& folder = {});
/// Throws Error that names file and line: an unknown key or unit, a yield stress that falls with
/// the field, points out of order, a viscosity that is not positive.
Fluid read_fluid(const Value& value);
/// What read_fluid reads back as the same, to the bit.
Value to_json(const Fluid& fluid);

}  // namespace dashpot
