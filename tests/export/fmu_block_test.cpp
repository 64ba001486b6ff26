// When an FMU of a controller or of an inverse takes its samples, and what else it answers.
#include <limits>

#include "dashpot/damper/inverse/registry.h"
#include "dashpot/export/c/c_controller.h"
#include "dashpot/export/c/c_inverse.h"
#include "export/fmu_importer.h"

using namespace dashpot;

namespace {

constexpr double kControlStep = 2e-3;  // s, the controller's

/// An accelerometer's integral decides: every sample that is lost, doubled or late changes what
/// follows.
const CBlockMaker& skyhook() {
  static const Vehicle vehicle = make_vehicle(
      {.controller = "skyhook_modified", .sample_time = kControlStep, .sensors = {.in_car = true}});
  static const CBlockMaker maker = [](const ExportOptions& options) {
    return c_controller_block(vehicle, options);
  };
  return maker;
}

/// Compiled once for all test cases.
const LoadedFmu& skyhook_fmu(int version) {
  static const std::array<std::string, 2> archives{fmu_of(skyhook(), 2), fmu_of(skyhook(), 3)};
  static const LoadedFmu fmi2(archives[0]), fmi3(archives[1]);
  return version == 2 ? fmi2 : fmi3;
}

const CBlock& block() {
  static const CBlock made = skyhook()({});
  return made;
}

template <class Test>
void for_both_skyhooks(Test test) {
  if (!has_compiler()) return;
  for (const int version : {2, 3}) {
    CAPTURE(version);
    test(skyhook_fmu(version));
  }
}

const std::vector<double>& inputs_at(std::size_t k) { return block().samples[k].inputs; }

std::vector<double> between(const std::vector<double>& from, const std::vector<double>& to,
                            double share) {
  std::vector<double> values(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) values[i] = from[i] + share * (to[i] - from[i]);
  return values;
}

/// The commands along the run with `parts` communication steps to a sample.
void check_fine_steps(const LoadedFmu& fmu, std::size_t parts) {
  FmuInstance instance(fmu, false);
  instance.initialize_at(inputs_at(0));
  const double length = kControlStep / static_cast<double>(parts);
  for (std::size_t k = 1; k < block().samples.size(); ++k)
    for (std::size_t part = 1; part <= parts; ++part) {
      REQUIRE(instance.step(static_cast<double>((k - 1) * parts + part - 1) * length, length) == 0);
      const double share = static_cast<double>(part) / static_cast<double>(parts);
      REQUIRE(instance.set_inputs(between(inputs_at(k - 1), inputs_at(k), share)) == 0);
      const double expected = block().samples[part == parts ? k : k - 1].commands[0];
      CHECK_CLOSE(instance.get("command"), expected, 0, 1e-9 * block().range);
    }
}

}  // namespace

TEST_CASE("FMU of a block: between samples commands are held, however short the steps") {
  for_both_skyhooks([](const LoadedFmu& fmu) {
    for (const std::size_t parts : {1, 2, 3, 10}) {
      CAPTURE(parts);
      check_fine_steps(fmu, parts);
    }
  });
}

TEST_CASE("FMU of a block: samples within a longer step see inputs that are linear") {
  for_both_skyhooks([](const LoadedFmu& fmu) {
    // Three samples to a step in one, step by step in the other.
    FmuInstance longer(fmu, false), shorter(fmu, false);
    longer.initialize_at(inputs_at(0));
    shorter.initialize_at(inputs_at(0));
    for (std::size_t k = 3; k < block().samples.size(); k += 3) {
      const double time = static_cast<double>(k - 3) * kControlStep;
      REQUIRE(longer.step(time, 3 * kControlStep) == 0);
      REQUIRE(longer.set_inputs(inputs_at(k)) == 0);
      for (int part = 1; part <= 3; ++part) {
        REQUIRE(shorter.step(time + (part - 1) * kControlStep, kControlStep) == 0);
        REQUIRE(shorter.set_inputs(part == 3
                                       ? inputs_at(k)
                                       : between(inputs_at(k - 3), inputs_at(k), part / 3.0)) == 0);
      }
      CHECK_CLOSE(longer.get("command"), shorter.get("command"), 0, 1e-9 * block().range);
    }
  });
}

TEST_CASE(
    "FMU of a block: inputs set before the command is read are the sample's, else those of "
    "before") {
  for_both_skyhooks([](const LoadedFmu& fmu) {
    FmuInstance set(fmu, false), held(fmu, false), late(fmu, false);
    for (FmuInstance* instance : {&set, &held, &late}) {
      instance->initialize_at(inputs_at(0));
      REQUIRE(instance->step(0, kControlStep) == 0);
    }
    REQUIRE(set.set_inputs(inputs_at(40)) == 0);
    REQUIRE(held.set_inputs(inputs_at(0)) == 0);
    CHECK(late.get("command") == held.get("command"));
    REQUIRE(late.set_inputs(inputs_at(40)) == 0);
    CHECK(late.get("command") == set.get("command"));
    CHECK(set.get("command") != held.get("command"));
    // No sample: what is set now waits.
    REQUIRE(set.step(kControlStep, 0.4 * kControlStep) == 0);
    const double command = set.get("command");
    REQUIRE(set.set_inputs(inputs_at(0)) == 0);
    CHECK(set.get("command") == command);
  });
}

TEST_CASE(
    "FMU of a block: over 1e6 steps of a tenth or a third of the sample time no sample is lost or "
    "doubled" *
    doctest::test_suite("long")) {
  if (!has_compiler()) return;
  // A switch: full where the wanted force and the velocity have the same sign.
  static const LawModel damper = example_law(find_law("bingham"));
  const auto inverse = find_inverse("heaviside").make(damper, {0, 2, 1e-3, 0});
  const LoadedFmu fmu(fmu_of(
      [&](const ExportOptions& options) {
        return c_inverse_block({.model = *inverse, .domain = {-0.02, 0.02, -0.3, 0.3, 0, 2}},
                               options);
      },
      3));
  const std::vector<unsigned> wanted{1}, command{6};
  for (const int parts : {10, 3}) {
    FmuInstance instance(fmu, false);
    instance.initialize_at({1.0, 0.0, 0.1, 0.0, 0.0});
    const double length = 1e-3 / parts;
    double time = 0;  // added up, as many importers do
    int wrong = 0;
    std::vector<double> read;
    for (int k = 1; k <= 1'000'000; ++k) {
      wrong += instance.step(time, length);
      time += length;
      // Only the sample's own instant sees the sign that makes its command: 2 at even samples, 0 at
      // odd ones.
      const int sample = k / parts, place = k % parts;
      if (place < 2) instance.set(wanted, {(sample % 2 == 0) == (place == 0) ? 1.0 : -1.0});
      if (place != 0 && place != parts - 1) continue;
      instance.get(command, read);
      wrong += read[0] != (sample % 2 == 0 ? 2.0 : 0.0);
    }
    CAPTURE(parts);
    CHECK(wrong == 0);
  }
}

TEST_CASE("FMU of a block: a state taken between two samples goes on as if nothing had been") {
  for_both_skyhooks([](const LoadedFmu& fmu) {
    const std::string word = fmu.version == 2 ? "FMUstate" : "FMUState";
    FmuInstance one(fmu, false), two(fmu, false);
    one.initialize_at(inputs_at(0));
    two.initialize_at(inputs_at(9));
    const auto run = [](FmuInstance& instance, int from, int to) {
      std::vector<double> commands;
      for (int k = from; k < to; ++k) {
        CHECK(instance.step(0.7 * kControlStep * k, 0.7 * kControlStep) == 0);
        CHECK(instance.set_inputs(inputs_at(static_cast<std::size_t>(k))) == 0);
        commands.push_back(instance.get("command"));
      }
      return commands;
    };
    run(one, 0, 51);
    void *saved = nullptr, *copy = nullptr;
    REQUIRE(fmu.call("Get" + word, one.handle, &saved) == 0);
    const std::vector<double> expected = run(one, 51, 190);
    REQUIRE(fmu.call("Set" + word, one.handle, saved) == 0);
    CHECK(run(one, 51, 190) == expected);
    std::size_t size = 0;
    REQUIRE(fmu.call("Serialized" + word + "Size", one.handle, saved, &size) == 0);
    std::string bytes(size, '\0');
    REQUIRE(fmu.call("Serialize" + word, one.handle, saved, bytes.data(), size) == 0);
    REQUIRE(fmu.call((fmu.version == 2 ? "DeSerialize" : "Deserialize") + word, two.handle,
                     static_cast<const char*>(bytes.data()), size, &copy) == 0);
    REQUIRE(fmu.call("Set" + word, two.handle, copy) == 0);
    CHECK(run(two, 51, 190) == expected);
    for (void** each : {&saved, &copy}) CHECK(fmu.call("Free" + word, one.handle, each) == 0);
  });
}

TEST_CASE("FMU of a block: what it cannot do ends in an error and a message") {
  for_both_skyhooks([](const LoadedFmu& fmu) {
    FmuInstance exchange(fmu, true);
    CHECK(exchange.handle == nullptr);
    CHECK(exchange.messages.size() == 1);
    FmuInstance instance(fmu, false);
    instance.initialize_at(inputs_at(0));
    const auto says = [&](const std::string& text) {
      return !instance.messages.empty() && instance.messages.back().find(text) != std::string::npos;
    };
    const unsigned command = fmu.reference("command"), input = 1;
    const double seed = 1;
    double slope = 0;
    const std::size_t one = 1;
    const int status = fmu.version == 2
                           ? fmu.call("GetDirectionalDerivative", instance.handle, &command, one,
                                      &input, one, &seed, &slope)
                           : fmu.call("GetDirectionalDerivative", instance.handle, &command, one,
                                      &input, one, &seed, one, &slope, one);
    CHECK(status == 3);
    CHECK(says("GetDirectionalDerivative: is not supported"));
    CHECK(instance.set({command}, {1}) == 3);
    CHECK(says("command is neither an input nor a parameter"));
    CHECK(instance.set({1}, {std::numeric_limits<double>::infinity()}) == 3);
    CHECK(says("the value for body_acceleration is not a finite number"));
    for (const double length : {1e9, HUGE_VAL, -kControlStep}) {
      CHECK(instance.step(0, length) == 3);
      CHECK(says("is impossible"));
    }
    CHECK(instance.set({command + 1}, {1}) == 3);
    CHECK(says("no variable with value reference"));
    CHECK(instance.get("command") == block().samples[0].commands[0]);
  });
}

TEST_CASE("FMU of a block: names, units and kinds of its variables") {
  const Vehicle car = make_vehicle(
      {.plant = "ikenaga2000", .dampers = {"ideal"}, .controller = "clipped_lqr,force=1e-8"});
  const CBlockMaker maker = [&](const ExportOptions& options) {
    return c_controller_block(car, options);
  };
  for (const int version : {2, 3}) {
    const LoadedFmu fmu(fmu_of(maker, version, {.sources_only = true}));
    std::map<std::string, pugi::xml_node> found;
    for (const pugi::xml_node variable : fmu.root().child("ModelVariables"))
      found[variable.attribute("name").value()] = variable;
    const auto unit = [&](const std::string& name) {
      const pugi::xml_node variable = found.at(name);
      return std::string(
          (version == 2 ? variable.child("Real") : variable).attribute("unit").value());
    };
    CHECK(found.size() == 1 + 4 + 14 + 4);
    CHECK(unit("deflection_velocity[4]") == "m/s");
    CHECK(unit("plant_state[2]") == "rad");
    CHECK(unit("plant_state[9]") == "rad/s");
    CHECK(unit("command[1]") == "");
    CHECK(std::string(found["plant_state[9]"].attribute("description").value())
              .starts_with("pitch: "));
    CHECK(std::string(found["command[1]"].attribute("variability").value()) == "discrete");
    CHECK(std::string(found["plant_state[1]"].attribute("variability").value()) == "continuous");
    const pugi::xml_node kind = fmu.root().child("CoSimulation");
    CHECK(!kind.attribute("providesDirectionalDerivative"));
    CHECK(!kind.attribute("providesDirectionalDerivatives"));
    CHECK(!fmu.exchanges());
    if (version == 3) CHECK(kind.attribute("fixedInternalStepSize").as_double() == 1e-3);
  }
}
