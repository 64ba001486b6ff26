// The FMU of a family's damper: its geometry, fluid and build are tunable parameters.
#include "export/fmu_importer.h"

using namespace dashpot;

TEST_CASE("FMU of a family: another gap, length, yield stress or build is another member") {
  if (!has_compiler()) return;
  constexpr double kStep = 1e-3;
  const FamilyModel model = example_family_physics();
  for (const int version : {2, 3}) {
    CAPTURE(version);
    const LoadedFmu fmu(fmu_of(exported(model), version));
    CHECK(!fmu.exchanges());
    const double last = model.member().yield.stresses.back();
    FamilyMember other = model.member();
    other.gap = 1.3e-3;
    other.pole_length = 8e-3;
    other.piston_area *= 1.1;
    other.viscosity *= 0.8;
    other.build = -1;
    for (double& stress : other.yield.stresses) stress *= 0.5;
    const auto member = model.with_member(other);

    FmuInstance instance(fmu, false);
    CHECK(instance.enter_initialization() == 0);
    const auto set = [&](const std::string& name, double value) {
      CHECK(instance.set({fmu.reference("parameter." + name)}, {value}) == 0);
    };
    set("gap", other.gap);
    set("pole_length", other.pole_length);
    set("piston_area", other.piston_area);
    set("viscosity", other.viscosity);
    set("build", other.build);
    set("yield_stress", 0.5 * last);
    DamperInput now{0, 0, 0.8};
    CHECK(instance.set(now) == 0);
    CHECK(instance.exit_initialization() == 0);
    std::vector<double> state(member->state_size());
    member->rest(now, state);
    double largest = 0;
    for (int k = 1; k <= 60; ++k) {
      const DamperInput next{1e-4 * k, 0.1 * std::sin(0.2 * k), k < 30 ? 0.8 : 0.2};
      CHECK(instance.step((k - 1) * kStep, kStep) == 0);
      CHECK(instance.set(next) == 0);
      member->advance(now, next, kStep, state);
      CHECK_CLOSE(instance.get("f"), member->force(next, state), 1e-10, 1e-10);
      largest = std::max(largest, std::abs(member->force(next, state)));
      now = next;
    }
    CHECK(largest > 1);

    // Out of its range a number is refused, and changes nothing.
    CHECK(instance.set({fmu.reference("parameter.gap")}, {1.}) == 3);
    CHECK(instance.get("parameter.gap") == other.gap);
    CHECK(instance.set({fmu.reference("parameter.gap")}, {-1.}) == 3);
  }
}
