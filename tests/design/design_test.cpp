#include "dashpot/design/design.h"

#include <algorithm>
#include <atomic>

#include "dashpot/base/text.h"
#include "support.h"

using namespace dashpot;

namespace {

// A valve of free width, whose fluid yields at a given stress: what Jolly's and Carlson's rule
// speaks of.
constexpr const char* kVolume = R"(
damper: passenger_car
at: {velocity: 0.2 m/s}
vary:
  gap: {from: 0.3 mm, to: 3 mm}
  pole_length: {from: 2 mm, to: 200 mm}
  gap_area: {from: 20 mm^2, to: 800 mm^2}
  yield_stress: [30 kPa]
  piston_area: [1500 mm^2]
  passive_length: [0]
  friction: [0]
constraints:
  - {quantity: control_ratio, min: 8}
  - {quantity: controllable_power, min: 300 W}
goals: [{minimise: active_volume}]
)";

// A front that is found at once.
constexpr const char* kFront = R"(
name: front
damper: passenger_car
at: {current: 2 A, velocity: 0.3 m/s}
vary:
  gap: {from: 0.6 mm, to: 2 mm}
  pole_length: {from: 8 mm, to: 40 mm}
  turns: {from: 40, to: 130, step: 10}
constraints:
  - {quantity: force, min: 1200 N}
  - {quantity: core_saturation, max: 0.8}
goals: [{maximise: dynamic_range}, {minimise: mass}]
)";

DesignReport designed(const std::string& text, DesignOptions options = {}) {
  options.threads = 1;
  return design(parse_request(text, "request.yaml"), options);
}

}  // namespace

TEST_CASE("design: the smallest active volume is that of Jolly and Carlson") {
  // V = (12 / c^2) (eta / tau^2) lambda W_m: TC-5.2c, recalled. With the pressures 12 eta L Q
  // / (w h^3) and c tau L / h it is an identity; here c = 2. 132DG: 0.112 Pa s.
  const DesignReport report = designed(kVolume);
  REQUIRE(report.designs.size() == 1);
  const double rule = 12. / 4 * 0.112 / (30e3 * 30e3) * 8 * 300;
  CHECK_CLOSE(report.designs[0].assessment.goals[0], rule, 1e-4, 0);
}

TEST_CASE("design: the gap of the largest control ratio under friction") {
  // Of a slot of fixed width, a h^-1 / (b h^-3 + f) is largest at h^3 = 2 b / f: there the viscous
  // force is half of the friction.
  const DesignReport report = designed(R"(
damper: passenger_car
at: {velocity: 0.2 m/s}
vary: {gap: {from: 0.3 mm, to: 8 mm}, yield_stress: [30 kPa], passive_length: [0], piston_area: [1500 mm^2], friction: [50 N]}
follow: {gap_area: {gap: 0.14}}
goals: [{maximise: control_ratio}]
)");
  REQUIRE(report.designs.size() == 1);
  const double flow = 1500e-6 * 0.2, pole = 0.024;
  const double b = 1500e-6 * 12 * 0.112 * pole * flow / 0.14;
  CHECK_CLOSE(report.designs[0].damper.gap, std::cbrt(2 * b / 50), 1e-3, 0);
}

TEST_CASE(
    "design: every design of a front holds every constraint when its file is read and assessed "
    "anew") {
  const DesignRequest request = parse_request(kFront, "request.yaml");
  DesignOptions options{.threads = 1, .points = 24, .generations = 30};
  const DesignReport report = design(request, options);
  CHECK(report.designs.size() == 24);
  CHECK(report.rejected == 0);
  for (const Design& own : report.designs) {
    const DamperDescription read = parse_description(format_description(own.damper), own.name);
    for (std::size_t k = 0; k < request.constraints.size(); ++k) {
      // By the physics alone: none of what the search uses.
      const DesignConstraint& asked = request.constraints[k];
      const DamperPhysics physics = evaluate_physics(read, asked.at);
      const double figure =
          asked.quantity->of({read, asked.at, physics, *make_design_model("physics", "")});
      CHECK((asked.at_least ? figure >= asked.bound : figure <= asked.bound));
      CHECK(figure == own.assessment.constraints[k]);
    }
    for (const Design& other : report.designs)  // largest dynamic range, smallest mass
      CHECK(!(other.assessment.goals[0] > own.assessment.goals[0] &&
              other.assessment.goals[1] < own.assessment.goals[1]));
  }
}

TEST_CASE("design: the same designs on any number of threads, others for another seed" *
          doctest::test_suite("long")) {
  DesignRequest request = named_request("family_prototype");
  request.samples = 8;
  const auto text = [&](std::uint64_t seed, int threads) {
    const DesignReport report = design(request, {.seed = seed, .threads = threads});
    REQUIRE(report.designs.size() == 1);
    return format_description(report.designs[0].damper);
  };
  const std::string one = text(1, 1);
  CHECK(text(1, 3) == one);
  CHECK(text(2, 1) != one);  // other dampers stand for those made
}

TEST_CASE("design: what was found stands when stopped") {
  std::atomic<bool> stop = true;
  DesignOptions options{.threads = 1};
  options.monitor.stop = &stop;
  const DesignReport nothing = designed(kFront, options);
  CHECK(nothing.stopped);
  CHECK(nothing.designs.empty());
  CHECK(!nothing.conflict);
  stop = false;
  options.generations = 100000;
  options.points = 8;
  options.monitor.on_progress = [&](const Progress& progress) {
    if (progress.stage.starts_with("front of 8")) stop = true;
  };
  const DesignReport some = designed(kFront, options);
  CHECK(some.stopped);
  CHECK(some.designs.size() == 8);
}

TEST_CASE("design: a front that goes on from an earlier one is nowhere worse than it") {
  DesignOptions options{.points = 8, .generations = 3};
  const DesignReport before = designed(kFront, options);
  for (const Design& design : before.designs) options.starts.push_back(design.damper);

  // A design that fails a constraint now is nothing to go on from.
  options.starts.emplace_back(named_description("passenger_car"));
  options.starts.back().gap = 2e-3;
  const DesignReport after = designed(kFront, options);
  REQUIRE(!before.designs.empty());
  REQUIRE(!after.designs.empty());
  for (const Design& old : before.designs)
    CHECK(std::ranges::any_of(after.designs, [&](const Design& now) {
      const auto &was = old.assessment.goals, &is = now.assessment.goals;
      return !(was[0] > is[0] && was[1] < is[1]);  // largest dynamic range, smallest mass
    }));
  const auto best = [](const DesignReport& report) {
    return std::ranges::max_element(report.designs, {},
                                    [](const Design& design) { return design.assessment.goals[0]; })
        ->assessment.goals[0];
  };
  CHECK(best(after) >= best(before));
}

TEST_CASE("design: of conflicting constraints the fewest are named, with what can be reached") {
  // Power is R I^2 and the current density I / A of the same wire: 1 A/mm^2 at 2 A asks for 1.6 mm.
  // The others hold everywhere.
  const DesignReport report = designed(R"(
damper: passenger_car
at: {current: 2 A, velocity: 0.3 m/s}
vary:
  gap: {from: 0.8 mm, to: 1.5 mm}
  wire_diameter: {from: 0.2 mm, to: 2 mm}
constraints:
  - {quantity: force, min: 100 N}
  - {quantity: current_density, max: 1 A/mm^2}
  - {quantity: coil_fill, max: 0.6}
  - {quantity: stroke, min: 100 mm}
goals: [{minimise: mass}]
)");
  CHECK(report.designs.empty());
  REQUIRE(report.conflict);
  CHECK(report.conflict->members == std::vector<std::size_t>{1, 2});
  // 120 turns in 60 mm^2: A <= 0.3 mm^2; and with A >= 2 mm^2 the fill is 4.
  CHECK_CLOSE(report.conflict->reached[0], 2 / 0.3e-6, 1e-3, 0);
  CHECK_CLOSE(report.conflict->reached[1], 4, 1e-3, 0);
}

TEST_CASE("design: ranges of which no damper can be drawn are told from constraints") {
  const DesignReport report = designed(
      "damper: passenger_car\nvary: {rod_diameter: {from: 46 mm, to: 60 mm}}\ngoals: [{minimise: "
      "mass}]\n");
  REQUIRE(report.conflict);
  CHECK(report.conflict->undrawable);
  CHECK(contains(describe(*report.conflict, report.request), "rod_diameter is "));

  // A core of 22 m fits into nothing, but that is not why.
  const DesignReport core = designed(
      "damper: passenger_car\nvary: {gap: {from: 1 mm, to: 2 mm}}\n"
      "follow: {core_length: {constant: 22}}\ngoals: [{minimise: mass}]\n");
  REQUIRE(core.conflict);
  CHECK(contains(describe(*core.conflict, core.request),
                 "can be drawn: core_length is 22 m; 0.0001 ... 10 m"));

  // A gap of 1 mm can be drawn, and with +-3 mm not be made.
  const DesignReport made = designed(
      "damper: passenger_car\nvary: {gap: {from: 0.9 mm, to: 1.1 mm}}\ngoals: [{minimise: mass}]\n"
      "tolerances: {gap: 3 mm}\nrobust: {share: 0.9, samples: 20}\n");
  REQUIRE(made.conflict);
  CHECK(describe(*made.conflict, made.request)
            .starts_with("no damper of these ranges can be made within its tolerances"));
}

TEST_CASE("design: among several fluids the best is no worse than that of one of them" *
          doctest::test_suite("long")) {
  const auto reached = [](const std::string& fluids) {
    const DesignReport report = designed(
        "damper: passenger_car\nat: {current: 2 A, velocity: 0.3 m/s}\n"
        "vary: {gap: {from: 0.7 mm, to: 2 mm}, pole_length: {from: 8 mm, to: 40 mm}, "
        "turns: {from: 40, to: 300, step: 1}, core_area: {from: 200 mm^2, to: 700 mm^2}, "
        "wire_diameter: [0.3 mm, 0.4 mm, 0.5 mm, 0.6 mm, 0.8 mm], fluid: " +
        fluids +
        "}\n"
        "follow: {core_length: {constant: 22 mm, pole_length: 2}}\n"
        "constraints: [{quantity: force, min: 1800 N}, {quantity: off_force, velocity: 1 m/s, max: "
        "2000 N}, {quantity: core_saturation, max: 0.8}, {quantity: current_density, max: 10 "
        "A/mm^2}, {quantity: coil_fill, max: 0.6}, {quantity: power, max: 20 W}, {quantity: "
        "response_time, max: 60 ms}, {quantity: outer_diameter, max: 56 mm}]\n"
        "goals: [{maximise: dynamic_range}]\n");
    REQUIRE(report.designs.size() == 1);
    return report.designs[0].assessment.goals[0];
  };
  const double alone = reached("[122EG]");
  CHECK(reached("[122EG, 140CG]") > 0.999 * alone);
  CHECK(reached("[122EG, 132DG, 140CG]") > 0.999 * alone);
}

TEST_CASE("design: what physics warns of in a design is told") {
  const std::string request =
      "damper: passenger_car\nat: {current: 2 A, velocity: 0.3 m/s}\n"
      "vary: {wire_diameter: {from: 0.2 mm, to: 1 mm}}\ngoals: [{minimise: copper_mass}]\n";
  const auto notes = [](const std::string& text) { return join(designed(text).notes, "\n"); };

  // 2 A in 0.2 mm; 10 A/mm^2 is what a wire bears.
  CHECK(contains(notes(request), "design_001: the wire carries 63.7 A/mm^2"));
  CHECK(!contains(notes(request + "constraints: [{quantity: current_density, max: 9.9 A/mm^2}]\n"),
                  "the wire carries"));

  // Of a front those that stand out, under one warning.
  const std::string front = notes(
      "damper: passenger_car\nat: {current: 1 A, velocity: 0.3 m/s}\n"
      "vary: {gap: {from: 0.6 mm, to: 2 mm}, fluid: [122EG]}\n"
      "goals: [{maximise: force}, {minimise: off_force}]\n");
  CHECK(contains(front, ": the volume fraction of 122EG is recalled, not from its data sheet"));
  CHECK(contains(front, "design_001, "));
}

TEST_CASE("design: the share of dampers made moves the optimum inside by the tolerance") {
  // Area of the wire >= 0.2 mm^2 as the current density at 2 A; of those made within +-0.02 mm nine
  // in ten must.
  const std::string text = R"(
damper: passenger_car
at: {current: 2 A}
vary: {wire_diameter: {from: 0.2 mm, to: 1 mm}}
tolerances: {wire_diameter: 0.02 mm}
constraints: [{quantity: current_density, max: 10 A/mm^2}]
goals: [{minimise: wire_diameter}]
)";
  const double least = std::sqrt(0.2e-6 * 4 / 3.14159265358979);
  const DesignReport drawn = designed(text);
  REQUIRE(drawn.designs.size() == 1);
  CHECK_CLOSE(drawn.designs[0].damper.wire_diameter, least, 1e-5, 0);
  CHECK_CLOSE(drawn.designs[0].sensitivity->holding, 0.5, 0, 0.05);
  const DesignReport robust = designed(text + "robust: {share: 0.9, samples: 60}\n");
  REQUIRE(robust.designs.size() == 1);
  // The lowest tenth of a uniform distribution begins at -0.8 of the tolerance.
  CHECK_CLOSE(robust.designs[0].damper.wire_diameter, least + 0.8 * 0.02e-3, 0, 0.0008e-3);
  CHECK_CLOSE(robust.designs[0].sensitivity->holding, 0.9, 0, 0.04);
}

TEST_CASE("design: a second model stands beside, with the largest difference" *
          doctest::test_suite("long")) {
  const DesignReport report =
      design(named_request("family_prototype"), {.threads = 1, .second = "physics:plate"});
  REQUIRE(report.designs.size() == 1);
  const Design& own = report.designs[0];
  DamperDescription other = own.damper;
  other.flow_law = FlowLaw::Plate;
  const double here = evaluate_physics(own.damper, {1, 0.034}).force;
  const double there = evaluate_physics(other, {1, 0.034}).force;
  CHECK(own.second[1] == there);
  CHECK(own.disagreement >= std::abs(there - here) / here);
  CHECK(message_of([] { make_design_model("physic", "--second"); }).find("did you mean") !=
        std::string::npos);
}
