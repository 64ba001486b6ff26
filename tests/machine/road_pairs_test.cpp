#include "dashpot/machine/road_pairs.h"

#include "dashpot/machine/in_plant_words.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Two masses on a ground at each of these places, whose roads are said by the input behind it.
InPlantSetup on_grounds(const std::vector<std::pair<std::string, std::string>>& places) {
  std::string ground, inputs;
  for (const auto& [place, input] : places) {
    ground += (ground.empty() ? "" : ", ") + place;
    inputs += (inputs.empty() ? "" : ", ") + input;
  }
  return parse_in_plant_setup(
      "plant: matrices\ncoordinates: [wheel, body]\n"
      "mass: [[50 kg, 0], [0, 400 kg]]\nstiffness: [[700 kN/m, -20 kN/m], [-20 kN/m, 20 kN/m]]\n"
      "damper: {from: wheel, to: body}\nground: [" +
          ground + "]\ninputs: [" + inputs +
          "]\nsensors: [{channel: az, quantity: acceleration, at: body}]\n",
      "grounds.yaml");
}
std::pair<std::string, std::string> place(const std::string& name, const std::string& more = "") {
  return {"{name: " + name + ", at: wheel, stiffness: 200 kN/m" + more + "}",
          "{kind: ground, at: " + name + ", class: C, speed: 20 m/s}"};
}
std::pair<std::string, std::string> measured(const std::string& name) {
  return {place(name).first, "{kind: ground, at: " + name + ", channel: road_" + name + "}"};
}

}  // namespace

TEST_CASE("road pairs: left and right of each axle, and no axle behind another") {
  const auto pairs = road_pairs(on_grounds({place("left"), place("right")}));
  REQUIRE(pairs.size() == 1);
  CHECK(pairs[0].left == 0);
  CHECK(pairs[0].right == 1);
  CHECK(road_pairs(on_grounds({place("front"), place("rear", ", behind: 2.8 m")})).empty());
  CHECK(road_pairs(on_grounds({measured("left"), measured("right")})).empty());
}

TEST_CASE("road pairs: the four wheels of a full car") {
  std::string text =
      "plant: full_car\n"
      "parameters: {mass: 1500 kg, pitch_inertia: 2160 kg*m^2, roll_inertia: 460 kg*m^2,\n"
      "  wheel_mass: 59 kg, front_stiffness: 35 kN/m, rear_stiffness: 38 kN/m,\n"
      "  tyre_stiffness: 190 kN/m, front_distance: 1.4 m, rear_distance: 1.7 m,\n"
      "  front_track: 1.5 m, rear_track: 1.5 m}\n"
      "sensors: [{channel: az, quantity: acceleration, at: body}]\ninputs:\n";
  for (const char* corner : {"rear_right", "front_left", "front_right", "rear_left"})
    text += std::string("  - {kind: ground, class: C, speed: 20 m/s, at: ") + corner + "}\n";
  const auto pairs = road_pairs(parse_in_plant_setup(text, "full.yaml"));
  REQUIRE(pairs.size() == 2);
  CHECK(pairs[0].left == 0);
  CHECK(pairs[0].right == 3);
  CHECK(pairs[1].left == 1);
  CHECK(pairs[1].right == 2);
}

TEST_CASE("road pairs: one of three, and one beside a measured one, are refused") {
  const auto refusal = [](const InPlantSetup& setup) {
    return message_of([&] { road_pairs(setup); });
  };
  CHECK(contains(refusal(on_grounds({place("a"), place("b"), place("c")})),
                 "is one of three side by side, and nothing measures them; behind:"));
  CHECK(contains(refusal(on_grounds({measured("left"), place("right")})),
                 "the road under the right is not measured, and the one beside it is"));
}
