#include "dashpot/design/quantities.h"

#include <set>

#include "support.h"

using namespace dashpot;

namespace {

double figure(const std::string& name, const DamperDescription& damper, const DamperOperation& at) {
  static const std::unique_ptr<DesignModel> model = make_design_model("physics", "");
  const DamperPhysics physics = model->evaluate(damper, at);
  return find_design_quantity(name, "").of({damper, at, physics, *model});
}

}  // namespace

TEST_CASE("design quantities: every name once, each can be found and told") {
  std::set<std::string_view> names;
  const DamperDescription damper = named_description("passenger_car");
  for (const DesignQuantity& quantity : design_quantities()) {
    CHECK(names.insert(quantity.name).second);
    CHECK(!quantity.unit.empty());
    const bool of_ride = quantity.name == kRideComfort;  // and there is none
    CHECK(std::isfinite(figure(std::string(quantity.name), damper, {1, 0.2})) == !of_ride);
  }
  for (const PhysicsQuantity& quantity : physics_quantities())
    if (quantity.name != "as the family paper prints it")
      CHECK_NOTHROW(find_design_quantity(quantity.name, ""));
  CHECK(message_of([] { find_design_quantity("forces", "here"); }).find("did you mean 'force'") !=
        std::string::npos);
}

TEST_CASE("design quantities: sizes by hand") {
  DamperDescription damper = named_description("passenger_car");
  const DamperOperation at{1, 0.2};
  CHECK_CLOSE(figure("body_length", damper, at), 0.150 + 0.024 + 0.016, 1e-14, 0);
  // The ring between the bore, 46 mm, and the outer diameter has the core's 450 mm^2.
  const double outer = figure("outer_diameter", damper, at);
  CHECK_CLOSE(3.14159265358979 / 4 * (outer * outer - 0.046 * 0.046), 450e-6, 1e-12, 0);
  CHECK_CLOSE(figure("copper_mass", damper, at),
              8960 * 120 * 0.1 * 0.25 * 3.14159265358979 * 0.25e-6, 1e-12, 0);
}

TEST_CASE("design quantities: the response of a linear coil is that of its time constant") {
  // Steel that neither saturates nor resists, a given force law: with air in the circuit L is
  // constant, and the time to the current of 90 % of the force is -tau ln(1 - i/I).
  DamperDescription damper = named_description("family_prototype");
  damper.saturation = 3;
  damper.turns = 10;  // far from the knee
  const DamperOperation at{0.01, 0.034};
  const std::unique_ptr<DesignModel> model = make_design_model("physics", "");
  const DamperPhysics on = model->evaluate(damper, at);
  double low = 0, high = at.current;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    const double force = model->evaluate(damper, {middle, at.velocity}).force;
    (force < on.off_force + 0.9 * (on.force - on.off_force) ? low : high) = middle;
  }
  CHECK_CLOSE(figure("response_time", damper, at),
              -on.time_constant * std::log(1 - low / at.current), 2e-3, 0);
}
