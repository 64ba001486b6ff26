#include "dashpot/physics/fluid.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/data_folder.h"
#include "dashpot/base/file_kind.h"
#include "dashpot/base/read_quantity.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/physics/flux_curve.h"
#include "dashpot/physics/named_file.h"
#include "dashpot/physics/read_points.h"

namespace dashpot {
namespace {

double more_than_zero(double value, const Value& at, const std::string& what) {
  if (value > 0 && std::isfinite(value)) return value;
  throw Error(at.where(), what + " is " + format_number(value), "more than 0");
}

/// What the fluids of MR dampers have, with room to both sides. A number outside was written
/// without its unit: 20 for 20 degC, 112 for 112 mPa*s, 40 for 40 kPa, 3 for 3 g/cm^3.
struct Usual {
  const char* what;
  double low, high;
  const char *unit, *example;
};
constexpr Usual kTemperature{"temperature", 200, 500, "K", "20 degC"},
    kViscosity{"viscosity", 1e-4, 20, "Pa*s", "0.11 Pa*s"},
    kDensity{"density", 500, 1e4, "kg/m^3", "3000 kg/m^3"},
    kGreatestYield{"greatest yield stress", 150, 1e6, "Pa", "42 kPa"};

double usual(double value, const Usual& range, const Value& at) {
  if (value >= range.low && value <= range.high) return value;
  const std::string unit = std::string(" ") + range.unit;
  throw Error(at.where(), std::string(range.what) + " is " + format_number(value) + unit,
              format_number(range.low) + " to " + format_number(range.high) + unit +
                  ", with its unit, as " + range.example);
}

/// A share of 0 to 1, as "8 %".
double read_share(const Value& value, const std::string& what) {
  const double share = read_quantity(value, "1");
  if (!(share >= 0 && share <= 1))
    throw Error(value.where(), what + " is " + format_number(share), "a share, 0 to 100 %");
  return share;
}

/// The coefficients of a polynomial, which state no units of their own.
std::vector<double> read_coefficients(const Value& polynomial, const std::string& right) {
  for (const Value& one : polynomial.items())
    if (one.kind() == Value::Kind::String)
      throw Error(one.where(), "is '" + one.as_string() + "', not a number",
                  "coefficients without units: " + right);
  return polynomial.as_numbers();
}

/// The polynomial may not fall where it is used.
void require_rising(const FamilyFluid& polynomial, const Value& at) {
  constexpr int kPlaces = 400;
  constexpr double kRounding = 1e-9;  // of the coefficients, in the turning point
  double before = polynomial.yield[0];
  for (int k = 1; k <= kPlaces; ++k) {
    const double field = polynomial.held_field * k / kPlaces;
    const double now = family_yield_stress(&polynomial, field);
    if (!(now >= before * (1 - kRounding)))
      throw Error(at.where(),
                  "the yield stress falls from " + format_number(before) + " to " +
                      format_number(now) + " Pa at " + format_number(field) + " A/m",
                  "a polynomial that rises up to its `up_to`, where it is held");
    before = now;
  }
  if (!(polynomial.yield[0] >= 0))
    throw Error(at.where(),
                "the yield stress without field is " + format_number(polynomial.yield[0]) + " Pa",
                "0 or more");
}

/// H over B: [c1, c3] of H = c1 B + c3 B^3, or points of A/m and T.
void read_flux_law(const Value& value, FluidLaw& law) {
  ObjectReader reader(value, "a field over the flux density");
  const Value *polynomial = reader.optional("polynomial"), *points = reader.optional("points");
  const Value* fraction = reader.optional("volume_fraction");
  if ((polynomial != nullptr) + (points != nullptr) + (fraction != nullptr) != 1)
    throw Error(value.where(), "the field over the flux density is not stated once",
                "one of volume_fraction, points and polynomial");
  if (fraction) law.volume_fraction = read_share(*fraction, "volume_fraction");
  if (points) law.flux_densities = read_flux_curve(*points);
  if (polynomial) {
    const std::vector<double> c =
        read_coefficients(*polynomial, "[c1, c3] of H = c1 B + c3 B^3 in A/m over T");
    if (c.size() != 2 || !(c[0] > 0 && c[1] >= 0 && std::isfinite(c[0] + c[1])))
      throw Error(polynomial->where(), "is no rising H = c1 B + c3 B^3",
                  "[c1, c3] in A/m over T and T^3, positive");
    std::ranges::copy(c, law.polynomial.field);
    law.has_field_polynomial = true;
  }
  reader.finish();
}

/// Refuses points whose columns are exchanged: dipoles of iron cannot make so steep a curve.
void require_fields_first(const CurvePoints& points, const Value& at) {
  constexpr double kSteepest = 1;  // Pa per A/m; MR fluids reach about 0.5
  const auto& [field, stress] = points.back();
  if (stress - points.front().second > kSteepest * field)
    throw Error(at.where(),
                "the yield stress is " + format_number(stress) + " Pa at a field of " +
                    format_number(field) + " A/m, which no MR fluid has",
                "pairs of A/m and Pa, in this order, or with their units");
}

/// tau over H: c0 to c3 up to a field, or points of A/m and Pa.
void read_yield(const Value& value, FluidLaw& law) {
  ObjectReader reader(value, "a yield stress over the field");
  const Value *polynomial = reader.optional("polynomial"), *points = reader.optional("points");
  if ((polynomial != nullptr) == (points != nullptr))
    throw Error(value.where(), "the yield stress over the field is not stated once",
                "either points or polynomial");

  // Points must rise, and be those of a fluid; so must a polynomial, up to where it ends.
  if (points) {
    law.yield_stresses = read_points(*points, "A/m", "Pa");
    require_rising(law.yield_stresses, *points, "the yield stress", false);
    usual(law.yield_stresses.back().second, kGreatestYield, *points);
    require_fields_first(law.yield_stresses, *points);
  }
  if (polynomial) {
    const std::string right = "1 to 4: tau = c0 + c1 H + c2 H^2 + c3 H^3 in Pa over A/m";
    const std::vector<double> c = read_coefficients(*polynomial, right);
    if (c.empty() || c.size() > 4)
      throw Error(polynomial->where(), "has " + std::to_string(c.size()) + " coefficients", right);
    std::ranges::copy(c, law.polynomial.yield);
    const Value& up_to = reader.required("up_to");
    law.polynomial.held_field = more_than_zero(read_quantity(up_to, "A/m"), up_to, "up_to");
    law.has_yield_polynomial = true;
    require_rising(law.polynomial, *polynomial);
  }
  reader.finish();
}

FluidLaw read_fluid_law(const std::string& name, const Value& value) {
  FluidLaw law;
  law.name = name;
  if (name.empty() ||
      name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") != std::string::npos)
    throw Error(value.where(), "'" + name + "' names no law", "a word of a to z, 0 to 9 and _");
  ObjectReader reader(value, "a law of a fluid");
  const Value *field = reader.optional("field"), *yield = reader.optional("yield_stress");
  if (const Value* fraction = reader.optional("volume_fraction")) {
    // Carlson's laws of both need nothing else.
    if (field || yield)
      throw Error(value.where(), "volume_fraction stands beside field or yield_stress",
                  "volume_fraction alone, which Carlson's laws take, or both of the others");
    law.volume_fraction =
        more_than_zero(read_share(*fraction, "volume_fraction"), *fraction, "volume_fraction");
  } else {
    read_flux_law(reader.required("field"), law);
    read_yield(reader.required("yield_stress"), law);
  }
  law.verified = reader.boolean("verified", true);
  if (const Value* scale = reader.optional("scale"))
    law.scale = more_than_zero(read_quantity(*scale, "1"), *scale, "scale");
  if (const Value* faults = reader.optional("faults"))
    for (const Value& fault : faults->items()) law.faults.push_back(fault.as_string());
  reader.finish();
  return law;
}

void read_density(const Value& value, Fluid& fluid) {
  if (value.kind() != Value::Kind::Object) {
    fluid.density_min = fluid.density_max = usual(read_quantity(value, "kg/m^3"), kDensity, value);
    return;
  }
  ObjectReader reader(value, "a range of densities");
  const Value &from = reader.required("from"), &to = reader.required("to");
  fluid.density_min = usual(read_quantity(from, "kg/m^3"), kDensity, from);
  fluid.density_max = usual(read_quantity(to, "kg/m^3"), kDensity, to);
  reader.finish();
  if (fluid.density_min > fluid.density_max)
    throw Error(value.where(), "the density is from more than to");
}

constexpr double kUsualTemperature = 313.15;  // K, at which data sheets give the viscosity

void read_viscosity(const Value& value, Fluid& fluid) {
  if (value.kind() == Value::Kind::Array)
    fluid.viscosities = read_points(value, "K", "Pa*s");
  else
    fluid.viscosities = {{kUsualTemperature, read_quantity(value, "Pa*s")}};
  for (const auto& [temperature, viscosity] : fluid.viscosities)
    usual(viscosity, kViscosity, value);
  for (const auto& [temperature, viscosity] : fluid.viscosities)
    usual(temperature, kTemperature, value);

  // No liquid thickens as it warms: a viscosity that rises stands beside another's temperature.
  for (std::size_t k = 1; k < fluid.viscosities.size(); ++k) {
    const auto &cold = fluid.viscosities[k - 1], &warm = fluid.viscosities[k];
    if (warm.second > cold.second)
      throw Error(value.where(),
                  "the viscosity rises from " + format_number(cold.second) + " to " +
                      format_number(warm.second) + " Pa*s as the temperature grows from " +
                      format_number(cold.first) + " to " + format_number(warm.first) + " K",
                  "one that falls or holds");
  }
}

}  // namespace

double FluidLaw::field(double flux_density) const {
  if (has_field_polynomial) return family_field(&polynomial, flux_density);
  if (flux_densities.empty()) return carlson_field(volume_fraction, flux_density);
  return field_on(flux_densities, flux_density);
}

double FluidLaw::yield_stress(double field, double carrier) const {
  if (has_yield_polynomial) return scale * family_yield_stress(&polynomial, field);
  if (!yield_stresses.empty()) return scale * curve_at(yield_stresses, field);
  return scale * carlson_yield_stress(volume_fraction, carrier, field);
}

double Fluid::viscosity(double temperature) const {
  if (viscosities.size() == 1) return viscosities.front().second;
  for (std::size_t k = 1; k < viscosities.size(); ++k) {
    const auto &a = viscosities[k - 1], &b = viscosities[k];
    if (temperature > b.first && k + 1 < viscosities.size()) continue;
    const double share = std::clamp((temperature - a.first) / (b.first - a.first), 0., 1.);
    return a.second * std::pow(b.second / a.second, share);
  }
  return viscosities.back().second;
}

const FluidLaw* Fluid::law(std::string_view named) const {
  if (named.empty()) return &laws.front();
  for (const FluidLaw& law : laws)
    if (law.name == named) return &law;
  return nullptr;
}

std::vector<std::string> fluid_names() { return data_names("fluids", ".yaml"); }

std::shared_ptr<const Fluid> find_fluid(std::string_view name, const std::string& where,
                                        const std::filesystem::path& folder) {
  return find_named<Fluid>({"fluid", "fluids", read_fluid}, name, where, folder);
}

Fluid read_fluid(const Value& value) {
  refuse_other_kind(value, "a fluid");
  ObjectReader reader(value, "a fluid");
  Fluid fluid;
  read_words(reader, fluid);
  read_density(reader.required("density"), fluid);
  if (const Value* solids = reader.optional("solids")) fluid.solids = read_share(*solids, "solids");
  read_viscosity(reader.required("viscosity"), fluid);

  // A stress that is no line of the shear rate.
  if (const Value* power = reader.optional("herschel_bulkley")) {
    ObjectReader herschel(*power, "a Herschel-Bulkley fluid");
    const Value& index = herschel.required("index");
    fluid.index = more_than_zero(read_quantity(index, "1"), index, "index");
    if (fluid.index > 3) throw Error(index.where(), "index is above 3", "about 0.3 to 1.5");
    const Value& rate = herschel.required("shear_rate");
    fluid.shear_rate = more_than_zero(read_quantity(rate, "1/s"), rate, "shear_rate");
    herschel.finish();
  }

  for (const auto& [name, law] : reader.required("laws").members())
    fluid.laws.push_back(read_fluid_law(name, law));
  if (fluid.laws.empty())
    throw Error(value.where(), "has no law of its yield stress",
                "laws: {measured: {field: ..., yield_stress: ...}}");
  if (const Value* uncertainty = reader.optional("uncertainty")) {
    ObjectReader shares(*uncertainty, "an uncertainty");
    if (const Value* share = shares.optional("yield_stress"))
      fluid.yield_uncertainty = read_share(*share, "the uncertainty");
    if (const Value* share = shares.optional("viscosity"))
      fluid.viscosity_uncertainty = read_share(*share, "the uncertainty");
    shares.finish();
  }
  reader.finish();
  return fluid;
}

namespace {

/// H over B as its file states it.
Value flux_json(const FluidLaw& law) {
  const double* const c = law.polynomial.field;
  if (law.has_field_polynomial)
    return Value::object({{"polynomial", Value::array(std::vector<double>(c, c + 2))}});
  if (law.flux_densities.empty()) return Value::object({{"volume_fraction", law.volume_fraction}});
  return Value::object({{"points", points_json(law.flux_densities)}});
}

/// tau over H, likewise.
Value yield_json(const FluidLaw& law) {
  const double* const c = law.polynomial.yield;
  if (law.has_yield_polynomial)
    return Value::object({{"polynomial", Value::array(std::vector<double>(c, c + 4))},
                          {"up_to", law.polynomial.held_field}});
  return Value::object({{"points", points_json(law.yield_stresses)}});
}

Value law_json(const FluidLaw& law) {
  Value out = Value::object();
  const bool carlson = !law.has_yield_polynomial && law.yield_stresses.empty();
  if (carlson) {
    out.add("volume_fraction", law.volume_fraction);
  } else {
    out.add("field", flux_json(law));
    out.add("yield_stress", yield_json(law));
  }
  if (!law.verified) out.add("verified", false);
  if (law.scale != 1) out.add("scale", law.scale);
  if (!law.faults.empty()) out.add("faults", Value::array(law.faults));
  return out;
}

}  // namespace

Value to_json(const Fluid& fluid) {
  Value out = words_json(fluid);
  out.add("density", Value::object({{"from", fluid.density_min}, {"to", fluid.density_max}}));
  if (fluid.solids > 0) out.add("solids", fluid.solids);
  out.add("viscosity", fluid.viscosities.size() == 1 ? Value(fluid.viscosities.front().second)
                                                     : points_json(fluid.viscosities));
  if (fluid.index != 1)
    out.add("herschel_bulkley",
            Value::object({{"index", fluid.index}, {"shear_rate", fluid.shear_rate}}));

  Value laws = Value::object();
  for (const FluidLaw& law : fluid.laws) laws.add(law.name, law_json(law));
  out.add("laws", std::move(laws));
  if (fluid.yield_uncertainty > 0 || fluid.viscosity_uncertainty > 0)
    out.add("uncertainty", Value::object({{"yield_stress", fluid.yield_uncertainty},
                                          {"viscosity", fluid.viscosity_uncertainty}}));
  return out;
}

}  // namespace dashpot
