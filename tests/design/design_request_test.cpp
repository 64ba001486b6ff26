#include "dashpot/design/design_request.h"

#include "support.h"

using namespace dashpot;

namespace {

std::string request(const std::string& vary,
                    const std::string& rest = "goals: [{minimise: mass}]") {
  return "damper: passenger_car\nvary:\n  " + vary + "\n" + rest + "\n";
}

std::string refusal(const std::string& text) {
  return message_of([&] { parse_request(text, "request.yaml"); });
}

}  // namespace

TEST_CASE("design request: units, steps, choices, places and bounds") {
  const DesignRequest parsed = parse_request(R"(
name: test
damper: passenger_car
at: {current: 500 mA, velocity: 20 cm/s}
vary:
  gap: {from: 0.5 mm, to: 2 mm}
  turns: {from: 10, to: 20, step: 2.5}
  wire_diameter: [0.3 mm, 0.5 mm]
  fluid: [122EG, 140CG]
follow: {core_length: {constant: 2 cm, pole_length: 2}}
tolerances: {gap: 0.3 mm}
robust: {share: 0.9, samples: 20}
constraints: [{quantity: force, current: 1 A, min: 1 kN, max: 2 kN}]
goals: [{maximise: dynamic_range}, {minimise: time constant}]
)",
                                             "request.yaml");
  REQUIRE(parsed.variables.size() == 4);
  CHECK(parsed.variables[0].levels() == 0);
  CHECK_CLOSE(parsed.variables[0].to, 2e-3, 1e-15, 0);
  CHECK(parsed.variables[1].levels() == 5);
  CHECK(parsed.variables[2].levels() == 2);
  CHECK(parsed.variables[3].fluids[1]->name == "140CG");
  REQUIRE(parsed.constraints.size() == 2);
  CHECK(parsed.constraints[0].at_least);
  CHECK_CLOSE(parsed.constraints[1].bound, 2000, 1e-15, 0);
  CHECK(parsed.constraints[0].at.current == 1);
  CHECK_CLOSE(parsed.constraints[0].at.velocity, 0.2, 1e-15, 0);
  CHECK(parsed.goals[1].quantity->name == "time_constant");
  CHECK(describe(parsed.constraints[0]) == "force at least 1000 N at 1 A, 0.2 m/s");
  CHECK(parsed.following[0].constant == 0.02);
}

TEST_CASE("design request: turns are whole where nothing else is said") {
  const auto turns = [](const std::string& damper, const std::string& range) {
    return parse_request(
               "damper: " + damper + "\nvary: {turns: " + range + "}\ngoals: [{minimise: mass}]\n",
               "request.yaml")
        .variables[0];
  };
  CHECK(turns("passenger_car", "{from: 40.5, to: 300}").from == 41);
  CHECK(turns("passenger_car", "{from: 40.5, to: 300}").step == 1);
  CHECK(turns("passenger_car", "{from: 40, to: 300, step: 2.5}").step == 2.5);
  CHECK(turns("family_prototype", "{from: 3000, to: 4000}").step == 0);  // of the paper's circuit
}

TEST_CASE("design request: what is wrong is named") {
  const auto says = [](const std::string& text, const std::string& part) {
    const std::string message = refusal(text);
    CHECK_MESSAGE(message.find(part) != std::string::npos, message);
  };
  says(request("gpa: {from: 1 mm, to: 2 mm}"), "did you mean 'gap'");
  says(request("gap: {from: 2 mm, to: 1 mm}"), "the range of gap is empty: 0.002 m to 0.001 m");
  says(request("gap: {from: 1 mm, to: 20 mm}"), "gap is 0.02 m");
  says(request("gap: {from: 1 kg, to: 2 mm}"), "not a unit of it");
  says(request("gap: []"), "no gap to choose from");
  says(request("gap: {from: 1 mm, to: 2 mm, step: 0}"), "the step is 0");
  says(request("gap: {from: 1 mm, to: 2 mm}", ""), "there is no goal");
  says(request("gap: {from: 1 mm, to: 2 mm}", "goals: [{minimise: weight}]"),
       "unknown quantity 'weight'");
  says(request("gap: {from: 1 mm, to: 2 mm}", "goals: [{minimise: mass, maximise: force}]"),
       "one quantity");
  says(request("gap: {from: 1 mm, to: 2 mm}",
               "goals: [{minimise: mass}]\nconstraints: [{quantity: force}]"),
       "no bound");
  says(request("gap: {from: 1 mm, to: 2 mm}",
               "goals: [{minimise: mass}]\nconstraints: [{quantity: force, min: 2 kN, max: 1 kN}]"),
       "min above its max");
  for (const auto& [bound, part] :
       {std::pair{
            "velocity: -0.3 m/s, max: 2 kN",
            "force is negative at -0.3 m/s, so that every damper holds this; a negative bound, "
            "as min: -2000 N"},
        {"velocity: -0.3 m/s, min: 2 kN",
         "no damper holds this; a negative bound, as max: -2000 N"},
        {"velocity: 0.3 m/s, max: -2 kN",
         "no damper holds this; a positive bound, as min: 2000 N"}})
    says(request("gap: {from: 1 mm, to: 2 mm}",
                 "goals: [{minimise: mass}]\nconstraints: "
                 "[{quantity: force, " +
                     std::string(bound) + "}]"),
         part);
  CHECK(refusal(request("gap: {from: 1 mm, to: 2 mm}",
                        "goals: [{minimise: mass}]\nconstraints: [{quantity: force, velocity: "
                        "-0.3 m/s, min: -2 kN}]"))
            .empty());
  says(request("gap: {from: 1 mm, to: 2 mm}", "goals: [{minimise: mass}]\nrobust: {share: 0.9}"),
       "robust against nothing");
  says(request("gap: {from: 1 mm, to: 2 mm}",
               "goals: [{minimise: mass}]\nfollow: {gap: {pole_length: 1}}"),
       "both varies and follows");
  says(request("gap: {from: 1 mm, to: 2 mm}",
               "goals: [{minimise: mass}]\n"
               "follow: {core_length: {stroke: 1}, stroke: {core_length: 1}}"),
       "core_length, stroke follow each other in a circle; one of them a value");
  says(request("gap: {from: 1 mm, to: 2 mm}", "goals: [{maximise: force}]"),
       "force is asked at rest, where nothing flows; a velocity, as at: {");
  says(request("gap: {from: 1 mm, to: 2 mm}",
               "at: {current: 1 A}\ngoals: [{minimise: mass}]\n"
               "constraints: [{quantity: off_force, max: 1 kN}]"),
       "off_force is asked at rest");
  says(request("gap: {from: 1 mm, to: 2 mm}",
               "at: {velocity: 0.1 m/s}\ngoals: [{maximise: dynamic_range}]"),
       "dynamic_range is asked without a current");
  says(request("gap: {from: 1 mm, to: 2 mm}",
               "at: {velocity: 0.1 m/s}\ngoals: [{minimise: mass}]\n"
               "constraints: [{quantity: current_density, max: 10 A/mm^2}]"),
       "current_density is asked without a current, where it is the same for every damper");
  says(request("gap: {from: 1 mm, to: 2 mm}", "goals: [{minimise: mass}, {maximise: mass}]"),
       "the goals smallest mass and largest mass are of one figure");
  says(request("gap: {from: 1 mm, to: 2 mm}",
               "at: {current: 1 A, velocity: 0.1 m/s}\n"
               "goals: [{minimise: mass}, {maximise: force}, {maximise: force}]"),
       "are of one figure; one goal for each figure");
  says(request("fluid: [132DH]"), "unknown fluid");
  says("vary: {gap: [1 mm]}\ngoals: [{minimise: mass}]", "damper");
  says("damper: car\nvary: {gap: [1 mm]}", "unknown damper 'car'");
}

TEST_CASE("design request: a field that follows a follower has the value that this gets") {
  const DesignRequest parsed =
      parse_request(request("gap: {from: 1 mm, to: 2 mm}",
                            "goals: [{minimise: mass}]\n"
                            "follow: {core_length: {stroke: 1}, stroke: {pole_length: 5}, "
                            "pole_length: {gap: 10}}"),
                    "request.yaml");
  REQUIRE(parsed.following.size() == 3);
  CHECK(parsed.following[0].field->name == "pole_length");
  CHECK(parsed.following[1].field->name == "stroke");
  CHECK(parsed.following[2].field->name == "core_length");
}

TEST_CASE("design request: a figure at two places, or by two models, is two goals") {
  const DesignRequest parsed = parse_request(
      request("gap: {from: 1 mm, to: 2 mm}",
              "at: {current: 1 A, velocity: 0.1 m/s}\ngoals: [{maximise: force}, {maximise: force, "
              "current: 2 A}, {maximise: force, by: second}]"),
      "request.yaml");
  CHECK(parsed.goals.size() == 3);
}

TEST_CASE("design request: those that come with Dashpot are understood") {
  CHECK(request_names() == std::vector<std::string>{"family_prototype", "passenger_car"});
  for (const std::string& name : request_names()) CHECK(!named_request(name).variables.empty());
}
