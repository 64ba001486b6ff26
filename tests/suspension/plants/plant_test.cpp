#include "dashpot/plant.h"

#include <complex>

#include "dashpot/suspension/plants/linear.h"
#include "support.h"

using namespace dashpot;

namespace {

void check_modes(const Plant& plant, const std::vector<double>& expected) {
  const std::vector<double> modes = natural_frequencies(linear_plant(plant));
  REQUIRE(modes.size() == expected.size());
  for (std::size_t k = 0; k < modes.size(); ++k) CHECK_CLOSE(modes[k], expected[k], 5e-7, 0);
}

double square(double x) { return x * x; }

}  // namespace

TEST_CASE("quarter cars have the modes that their numbers give") {
  check_modes(load_plant_set("tudon_martinez2012").plant, {1.468799, 7.788395});
  check_modes(load_plant_set("savaresi_spelta").plant, {1.082538, 11.699497});
  check_modes(load_plant_set("renault_megane").plant, {1.440907, 12.730756});
}

TEST_CASE("the one-sensor paper's quarter car stands on 5164.965 N, 17.4965 mm into its tyre") {
  const Plant plant = load_plant_set("tudon_martinez2012").plant;
  CHECK_CLOSE(plant.tyres[0].static_load, 5164.9650, 1e-9, 0);
  CHECK_CLOSE(plant.tyres[0].static_load / plant.tyres[0].stiffness, 17.4965e-3, 3e-6, 0);
}

TEST_CASE("frequency response of the quarter car: TC-3.6b") {
  const Plant plant = load_plant_set("tudon_martinez2012").plant;
  const double f[] = {0.5, 1, 1.2, 1.5, 2, 5, 7, 8, 10, 15, 20};
  const double comfort[] = {11.160914,  66.382028,  118.955221, 210.675109, 205.277392, 334.235181,
                            711.575097, 749.786514, 418.21801,  177.49268,  116.217536};
  const double holding[] = {0.019385, 0.107284, 0.185243, 0.309414, 0.277015, 0.708551,
                            2.250454, 2.769881, 1.9875,   1.305685, 1.15333};
  for (int k = 0; k < 11; ++k) {
    const auto q = frequency_response(plant, {2280}, f[k]);
    CHECK_CLOSE(std::abs(q[0]) * square(2 * 3.14159265358979 * f[k]), comfort[k], 5e-8, 0);
    CHECK_CLOSE(std::abs(q[1] - 1.0), holding[k], 0, 6e-7);
  }
}

TEST_CASE("half car: TC-8.2") {
  const Plant plant = load_plant_set("half_car_a").plant;
  check_modes(plant, {1.056081, 1.287444, 11.186909, 11.726602});
  const LinearPlant linear = linear_plant(plant);
  const double first[] = {39000, 10900, -17000, -22000};
  for (int k = 0; k < 4; ++k)
    CHECK_CLOSE(linear.stiffness[static_cast<std::size_t>(k)], first[k], 1e-12, 0);
  CHECK_CLOSE(linear.stiffness[5], 78230, 1e-12, 0);
  CHECK_CLOSE(linear.stiffness[6], 22100, 1e-12, 0);
  CHECK_CLOSE(linear.stiffness[7], -33000, 1e-12, 0);
}

TEST_CASE("full car: TC-8.3, with a track of 1.5 m and of 3 m") {
  const Plant plant = load_plant_set("ikenaga2000").plant;
  check_modes(plant, {1.406763, 1.886633, 1.939923, 9.841259, 9.850488, 9.919362, 9.927982});
  check_modes(load_plant_set("ikenaga2000", {{"front_track", 3}, {"rear_track", 3}}).plant,
              {1.406763, 1.886633, 3.827939, 9.850488, 9.852998, 9.927982, 10.041892});
  const std::vector<double> k = linear_plant(plant).stiffness;
  CHECK_CLOSE(k[0], 146000, 1e-12, 0);
  CHECK_CLOSE(k[1], 31200, 1e-12, 0);
  CHECK_CLOSE(k[8], 356840, 1e-12, 0);
  CHECK_CLOSE(k[16], 82125, 1e-12, 0);
}

TEST_CASE("a full car on a plate follows it; one raised wheel twists it: TC-8.3") {
  Plant plant = load_plant_set("ikenaga2000").plant;
  const std::vector<double> none(4);
  const auto level = frequency_response(plant, none, 1e-6);
  CHECK_CLOSE(level[0].real(), 1, 1e-9, 0);
  CHECK_CLOSE(level[1].real(), 0, 0, 1e-9);
  // Only the front left wheel: the others' roads stay at 0 when their tyres are springs of the
  // plant.
  const std::vector<double> unit{0.2742, -0.1613, 0.3218, 0.9598, 0.0402, 0.0402, -0.0402};
  for (std::size_t t = 1; t < 4; ++t)
    for (std::size_t i = 0; i < 7; ++i)
      for (std::size_t j = 0; j < 7; ++j)
        plant.stiffness[i * 7 + j] +=
            plant.tyres[t].stiffness * plant.tyres[t].row[i] * plant.tyres[t].row[j];
  plant.tyres.resize(1);
  const auto twisted = frequency_response(plant, none, 1e-6);
  for (std::size_t k = 0; k < 7; ++k) CHECK_CLOSE(twisted[k].real(), unit[k], 0, 6e-5);
}

TEST_CASE("seated driver: TC-8.4") {
  const Plant plant = load_plant_set("boileau_rakheja1998").plant;
  check_modes(plant, {5.114507, 18.606161, 35.41644, 42.516486});
  const double f[] = {1, 2, 4, 5, 8, 10, 20};
  const double head[] = {1.043077, 1.178925, 1.696258, 1.759492, 0.951277, 0.670401, 0.307602};
  const double mass[] = {57.251533, 63.708346, 87.513050, 88.607623,
                         45.118608, 30.872972, 12.506316};
  for (int k = 0; k < 7; ++k) {
    const auto q = frequency_response(plant, {}, f[k]);
    CHECK_CLOSE(std::abs(q[3]), head[k], 0, 6e-7);
    std::complex<double> apparent = 0;
    for (std::size_t j = 0; j < 4; ++j) apparent += plant.mass[5 * j] * q[j];
    CHECK_CLOSE(std::abs(apparent), mass[k], 2e-8, 0);
  }
}

TEST_CASE("the three-storey building has the modes of the benchmark") {
  const PlantSet set = load_plant_set("dyke_spencer1996");
  check_modes(set.plant, {5.456591, 15.810796, 23.637824});
  CHECK(set.plant.ground.size() == 3);
  CHECK(load_plant_set("building", {{"storeys", 5}}).plant.size() == 5);
}

TEST_CASE("every set that comes with Dashpot can be loaded, and says whether it was verified") {
  const std::vector<std::string> names = plant_set_names();
  CHECK(names.size() >= 10);
  for (const std::string& name : names) {
    CAPTURE(name);
    const PlantSet set = load_plant_set(name);
    CHECK(!set.source.empty());
    CHECK(!set.reason.empty());
    CHECK(set.plant.mass.size() == square(static_cast<double>(set.plant.size())));
  }
}

TEST_CASE("a plant that cannot be is refused, with what would be right") {
  const auto refusal = [](const std::string& name, const NamedValues& values) {
    return message_of([&] { load_plant_set(name, values); });
  };
  CHECK(refusal("quarter_car", {{"sprung_mass", -5}}).find("sprung_mass is -5 kg; between 1 and") !=
        std::string::npos);
  CHECK(refusal("quarter_car", {{"sprng_mass", 5}}).find("did you mean 'sprung_mass'") !=
        std::string::npos);
  CHECK(refusal("savaresi", {}).find("did you mean") != std::string::npos);
  CHECK(refusal("dyke_spencer1996", {{"mass", 5}}).find("has matrices") != std::string::npos);
  const auto text = [](const std::string& mass) {
    return message_of([&] {
      parse_plant_set(
          R"({"title":"t","source":"s","verified":true,"reason":"r","matrices":{"floors":["a","b"],
        "mass":)" +
              mass + R"(,"damping":[[0,0],[0,0]],"stiffness":[[1,0],[0,1]],"dampers":[]}})",
          "my.json", "mine");
    });
  };
  CHECK(text("[[1,0]]").find("has 1 rows") != std::string::npos);
  CHECK(text("[[1,0],[1,1]]").find("is not symmetric") != std::string::npos);
  CHECK(text("[[1,0],[0,1]]").empty());

  // All that is missing at once.
  CHECK(message_of([] { parse_plant_set(R"({"title":"t"})", "my.json", "mine"); }) ==
        "my.json: a plant needs 'source', 'verified', 'reason', 'plant', 'parameters'");
}

TEST_CASE("a plant with its sensors is a plant, once all of its numbers are known or found") {
  const auto file = [](const std::string& tyre) {
    return R"({"plant": "quarter_car", "parameters": {"unsprung_mass": "40 kg",
      "spring_stiffness": 20000, "sprung_mass": {"found": 377, "low": 374, "high": 380},
      "tyre_stiffness": )" +
           tyre + R"(}, "inputs": [{"channel": "road", "kind": "ground"}],
      "sensors": [{"channel": "a", "quantity": "acceleration", "at": "body"}]})";
  };
  const PlantSet found = parse_plant_set(file("200000"), "found.json", "found");
  const Plant same = make_plant(find_plant_model("quarter_car"), {{"unsprung_mass", 40},
                                                                  {"spring_stiffness", 20000},
                                                                  {"sprung_mass", 377},
                                                                  {"tyre_stiffness", 200000}});
  CHECK(found.plant.mass == same.mass);
  CHECK(found.plant.stiffness == same.stiffness);
  CHECK(found.kind == "quarter_car");

  // The same as YAML, one number set otherwise, and what nobody knows.
  const PlantSet stated = parse_plant_set(
      "plant: quarter_car\n"
      "parameters: {unsprung_mass: 40 kg, spring_stiffness: 20 N/mm, sprung_mass: 300 kg, "
      "tyre_stiffness: 200 kN/m}\n"
      "inputs: [{channel: road, kind: ground}]\n",
      "car.yaml", "car", {{"sprung_mass", 377}});
  CHECK(stated.plant.mass == same.mass);
  for (const std::string unknown : {R"("unknown")", R"({"about": 200000})"})
    CHECK(message_of([&] { parse_plant_set(file(unknown), "found.json", "found"); }) ==
          "found.json, parameters.tyre_stiffness: 'tyre_stiffness' is unknown; its value: "
          "'dashpot identify --in' writes the plant as it was found into plants/");
}

TEST_CASE("a plant's file that states some numbers states all: none is another vehicle's") {
  const auto made = [](const std::string& parameters, const NamedValues& changes = {}) {
    return message_of([&] {
      parse_plant_set(R"({"title":"t","source":"s","verified":true,"reason":"r",)"
                      R"("plant":"quarter_car","parameters":)" +
                          parameters + "}",
                      "my.json", "mine", changes);
    });
  };
  const std::string three =
      R"({"sprung_mass":450,"spring_stiffness":"22 N/mm","tyre_stiffness":"220 N/mm")";
  CHECK(
      made(three + "}") ==
      "my.json, parameters: quarter_car needs 'unsprung_mass' (kg) too; state all that it has, or "
      "{} for the numbers of the table");
  CHECK(contains(made(R"({"sprung_mass":450,"spring_stiffness":"22 N/mm"})"),
                 "needs 'unsprung_mass' (kg), 'tyre_stiffness' (N/m) too"));
  CHECK(made(three + R"(,"unsprung_mass":45})").empty());
  CHECK(made(three + "}", {{"unsprung_mass", 45}}).empty());
  CHECK(made("{}").empty());
}
