#include "dashpot/damper/physics/fluid.h"

#include <algorithm>
#include <array>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {

const FamilyFluid kFamily122EG = {
    {233.446e3, 205.765e3}, {3886, 0.039, 1.267e-8, -6.876e-15}, 2120e3};

namespace {

constexpr std::array kFluids{
    Fluid{"122EG", 0.042, 2280, 2480, 0.72, 0.22, false, &kFamily122EG},
    Fluid{"132DG", 0.112, 2950, 3150, 0.8098, 0.32, true, nullptr},
    Fluid{"140CG", 0.280, 3540, 3740, 0.8544, 0.40, false, &kFamily140CG},
};

std::string kilo(double value, const std::string& unit) {
  return format_number(value / 1000) + " k" + unit;
}

}  // namespace

std::span<const Fluid> fluids() { return kFluids; }

const Fluid& find_fluid(std::string_view name, const std::string& where) {
  std::vector<std::string> known;
  for (const Fluid& fluid : kFluids) {
    if (fluid.name == name) return fluid;
    known.emplace_back(fluid.name);
  }
  throw Error(where, "unknown fluid '" + std::string(name) + "'", suggest(name, known));
}

double measured_yield_stress_122eg(double field) {
  struct Point {
    double field, stress;
  };
  // The fields are those of the data set's currents 0, 0.25, 0.5 and 0.75 A by the paper's chain.
  constexpr std::array<Point, 4> kPoints{
      {{0, 779.93}, {102.83e3, 21101.58}, {188.43e3, 30174.10}, {261.83e3, 33500}}};
  for (std::size_t k = 1; k < kPoints.size(); ++k) {
    const Point &a = kPoints[k - 1], &b = kPoints[k];
    if (field < b.field)
      return a.stress + (b.stress - a.stress) * (field - a.field) / (b.field - a.field);
  }
  return kPoints.back().stress;
}

std::vector<std::string> family_warnings(const Fluid& fluid, double largest_field) {
  std::vector<std::string> warnings;
  if (!fluid.family) return warnings;

  // The table's own faults.
  const FamilyFluid& table = *fluid.family;
  const std::string name(fluid.name);
  if (fluid.family == &kFamily122EG)
    warnings.push_back(
        "the yield stress of " + name +
        " in the paper's table 1 is lower than Carlson's law and the authors' own data set by a "
        "factor of 2 to 2.7; use either of these");
  else
    warnings.push_back("the yield stress of " + name + " without field, " +
                       kilo(table.yield[0], "Pa") +
                       ", comes from the polynomial's fit, not from the fluid");

  // Use beyond its range.
  if (largest_field > table.held_field)
    warnings.push_back("the yield stress of " + name + " is held at " +
                       kilo(family_yield_stress(&table, largest_field), "Pa") + " above " +
                       kilo(table.held_field, "A/m") + ", where the polynomial of the paper falls");
  return warnings;
}

}  // namespace dashpot
