// What a simulator does with an FMU beside stepping it, and what it does wrong.
#include <limits>

#include "dashpot/damper/registry.h"
#include "dashpot/export/export_run.h"
#include "export/fmu_importer.h"

using namespace dashpot;

namespace {

constexpr double kStep = 1e-3;
const double kNan = std::numeric_limits<double>::quiet_NaN();

const LawModel& bouc_wen() {
  static const LawModel model = example_law(find_law("bouc_wen"));
  return model;
}

/// Compiled once for all test cases.
const LoadedFmu& bouc_wen_fmu(int version) {
  static const std::array<std::string, 2> archives{fmu_of(exported(bouc_wen()), 2),
                                                   fmu_of(exported(bouc_wen()), 3)};
  static const LoadedFmu fmi2(archives[0]), fmi3(archives[1]);
  return version == 2 ? fmi2 : fmi3;
}

std::vector<DamperInput> run_of(const DamperModel& model, std::size_t count) {
  return export_run(exported(model).domain, kStep, count);
}

/// Steps from one place of a run to another; the force at each.
std::vector<double> simulate(FmuInstance& instance, const std::vector<DamperInput>& run,
                             std::size_t begin, std::size_t end) {
  std::vector<double> force;
  for (std::size_t k = begin + 1; k < end; ++k) {
    CHECK(instance.step(static_cast<double>(k - 1) * kStep, kStep) == 0);
    CHECK(instance.set(run[k]) == 0);
    force.push_back(instance.get("f"));
  }
  return force;
}

bool says(const FmuInstance& instance, const std::string& text) {
  CAPTURE(text);
  const bool found =
      !instance.messages.empty() && instance.messages.back().find(text) != std::string::npos;
  if (!found && !instance.messages.empty()) MESSAGE(instance.messages.back());
  return found;
}

template <class Test>
void for_both_versions(Test test) {
  if (!has_compiler()) return;
  for (const int version : {2, 3}) {
    CAPTURE(version);
    test(bouc_wen_fmu(version));
  }
}

}  // namespace

TEST_CASE("FMU: steps of any length, and the force for inputs that are held") {
  for_both_versions([](const LoadedFmu& fmu) {
    const std::vector<DamperInput> run = run_of(bouc_wen(), 30);
    std::vector<double> state(bouc_wen().state_size());
    bouc_wen().rest(run[0], state);
    FmuInstance instance(fmu, false);
    instance.initialize(run[0]);
    double time = 0;
    for (const auto& [to, length] : {std::pair{1, 0.3e-3}, {2, 1e-3}, {3, 0.25e-3}}) {
      // Before new inputs are set the old ones hold.
      CHECK(instance.step(time, length) == 0);
      std::vector<double> held = state;
      const auto& from = run[static_cast<std::size_t>(to - 1)];
      const auto& next = run[static_cast<std::size_t>(to)];
      bouc_wen().advance(from, from, length, held);
      CHECK_CLOSE(instance.get("f"), bouc_wen().force(from, held), 1e-12, 1e-12);
      CHECK(instance.set(next) == 0);
      bouc_wen().advance(from, next, length, state);
      CHECK_CLOSE(instance.get("f"), bouc_wen().force(next, state), 1e-12, 1e-12);
      time += length;
    }
    // A long step is made of pieces of the sample time along the straight line.
    CHECK(instance.step(time, 2 * kStep) == 0);
    CHECK(instance.set(run[9]) == 0);
    const DamperInput middle{(run[3].displacement + run[9].displacement) / 2,
                             (run[3].velocity + run[9].velocity) / 2,
                             (run[3].current + run[9].current) / 2};
    bouc_wen().advance(run[3], middle, kStep, state);
    bouc_wen().advance(middle, run[9], kStep, state);
    CHECK_CLOSE(instance.get("f"), bouc_wen().force(run[9], state), 1e-12, 1e-12);
    // A step of no length changes nothing but the inputs.
    CHECK(instance.step(time + 2 * kStep, 0) == 0);
    CHECK(instance.set(run[10]) == 0);
    CHECK_CLOSE(instance.get("f"), bouc_wen().force(run[10], state), 1e-12, 1e-12);
  });
}

TEST_CASE(
    "FMU: a state is saved, restored, serialised and taken over by another instance, bit for bit") {
  for_both_versions([](const LoadedFmu& fmu) {
    const std::string state_word = fmu.version == 2 ? "FMUstate" : "FMUState";
    const std::vector<DamperInput> run = run_of(bouc_wen(), 60);
    FmuInstance one(fmu, false), two(fmu, false);
    one.initialize(run[0]);
    two.initialize(run[7]);
    simulate(one, run, 0, 30);
    void *saved = nullptr, *copy = nullptr;
    REQUIRE(fmu.call("Get" + state_word, one.handle, &saved) == 0);
    const std::vector<double> expected = simulate(one, run, 29, 60);
    REQUIRE(fmu.call("Set" + state_word, one.handle, saved) == 0);
    CHECK(simulate(one, run, 29, 60) == expected);
    std::size_t size = 0;
    REQUIRE(fmu.call("Serialized" + state_word + "Size", one.handle, saved, &size) == 0);
    std::string bytes(size, '\0');
    REQUIRE(fmu.call("Serialize" + state_word, one.handle, saved, bytes.data(), size) == 0);
    const std::string read = (fmu.version == 2 ? "DeSerialize" : "Deserialize") + state_word;
    REQUIRE(fmu.call(read, two.handle, static_cast<const char*>(bytes.data()), size, &copy) == 0);
    REQUIRE(fmu.call("Set" + state_word, two.handle, copy) == 0);
    CHECK(simulate(two, run, 29, 60) == expected);
    // Bytes that are cut off or from elsewhere.
    CHECK(fmu.call(read, two.handle, static_cast<const char*>(bytes.data()), size - 1, &copy) == 3);
    CHECK(says(two, "values instead of"));
    bytes[3] = static_cast<char>(bytes[3] ^ 1);
    CHECK(fmu.call(read, two.handle, static_cast<const char*>(bytes.data()), size, &copy) == 3);
    CHECK(says(two, "not a state of this FMU"));
    for (void** block : {&saved, &copy}) {
      CHECK(fmu.call("Free" + state_word, one.handle, block) == 0);
      CHECK(*block == nullptr);
      CHECK(fmu.call("Free" + state_word, one.handle, block) == 0);
    }
    if (fmu.exchanges()) {
      FmuInstance exchange(fmu, true);
      CHECK(fmu.call("Get" + state_word, exchange.handle, &saved) == 0);
      CHECK(fmu.call("Set" + state_word, one.handle, saved) == 3);
      CHECK(fmu.call("Free" + state_word, exchange.handle, &saved) == 0);
    }
  });
}

TEST_CASE("FMU: reset starts anew; instances do not know of each other") {
  for_both_versions([](const LoadedFmu& fmu) {
    const std::vector<DamperInput> run = run_of(bouc_wen(), 20);
    FmuInstance one(fmu, false), two(fmu, false);
    one.initialize(run[0]);
    const std::vector<double> expected = simulate(one, run, 0, 20);
    two.initialize(run[5]);
    CHECK(fmu.call("Terminate", one.handle) == 0);
    CHECK(one.set(run[0]) == 3);
    CHECK(says(one, "must not be called after termination"));
    CHECK(fmu.call("Reset", one.handle) == 0);
    one.initialize(run[0]);
    simulate(two, run, 0, 9);
    CHECK(simulate(one, run, 0, 20) == expected);
  });
}

TEST_CASE("FMU: a law's parameters can be set, within their bounds, and hold from then on") {
  for_both_versions([](const LoadedFmu& fmu) {
    const Law& law = find_law("bouc_wen");
    Dependence changed = bouc_wen().parameters();
    const std::size_t alpha = law.index_of("alpha"), k0 = law.index_of("k0");
    changed.coefficients[alpha][0] *= 1.5;
    changed.coefficients[k0][0] *= 0.5;
    const LawModel other(law, changed, DriveUnit::Ampere, 60);
    const std::string alpha_a = coefficient_name("alpha", changed.forms[alpha], 0);
    const unsigned k0_reference =
        fmu.reference("parameter." + coefficient_name("k0", changed.forms[k0], 0));
    const std::vector<unsigned> references{fmu.reference("parameter." + alpha_a), k0_reference,
                                           fmu.reference("parameter.lag_rate")};
    const std::vector<double> values{changed.coefficients[alpha][0], changed.coefficients[k0][0],
                                     60};
    const std::vector<DamperInput> run = run_of(bouc_wen(), 40);
    // Before the start: another damper.
    FmuInstance fresh(fmu, false);
    CHECK(fresh.set(references, values) == 0);
    fresh.initialize(run[0]);
    const std::vector<double> expected = force_along(other, run, kStep),
                              force = simulate(fresh, run, 0, 40);
    for (std::size_t k = 0; k < force.size(); ++k)
      CHECK_CLOSE(force[k], expected[k + 1], 1e-12, 1e-9);
    // On the way: the steps that are done were those of the old one.
    FmuInstance instance(fmu, false);
    instance.initialize(run[0]);
    simulate(instance, run, 0, 20);
    CHECK(instance.set(references, values) == 0);
    std::vector<double> state(bouc_wen().state_size());
    bouc_wen().rest(run[0], state);
    for (std::size_t k = 1; k < 20; ++k) bouc_wen().advance(run[k - 1], run[k], kStep, state);
    other.advance(run[19], run[20], kStep, state);
    CHECK_CLOSE(simulate(instance, run, 19, 21).back(), other.force(run[20], state), 1e-12, 1e-9);
    // At a communication point before its inputs: the step that ends there keeps the old one, and
    // sees inputs that are linear all the same.
    FmuInstance early(fmu, false);
    early.initialize(run[0]);
    simulate(early, run, 0, 19);
    CHECK(early.step(18 * kStep, kStep) == 0);
    CHECK(early.set(references, values) == 0);
    CHECK(early.set(run[19]) == 0);
    CHECK(early.get("parameter.lag_rate") == 60);
    CHECK_CLOSE(simulate(early, run, 19, 21).back(), other.force(run[20], state), 1e-12, 1e-9);
    // Outside the bounds of the law's table nothing changes.
    CHECK(instance.set({1, references[2]}, {0.5, -1.0}) == 3);
    CHECK(says(instance, "parameter.lag_rate = -1 is outside 0.001 ... 1e+06"));
    CHECK(instance.get("s") == run[20].displacement);
    CHECK(instance.get("parameter.lag_rate") == 60);
  });
}

TEST_CASE("FMU: directional derivatives are those of the equations") {
  for_both_versions([](const LoadedFmu& fmu) {
    const LawModel& model = bouc_wen();
    FmuInstance instance(fmu, true);
    const DamperInput input{0.004, 0.05, 0.7};
    instance.initialize(input);
    CHECK(fmu.call("EnterContinuousTimeMode", instance.handle) == 0);
    std::vector<double> state(model.state_size());
    model.rest(input, state);
    // The same difference by hand, with steps of its own.
    const double h = 1e-6;
    const auto force_at = [&](double way) {
      std::vector<double> moved = state;
      moved[0] += 0.5 * way;
      return model.force({input.displacement, input.velocity + way, input.current}, moved);
    };
    const double expected = (force_at(h) - force_at(-h)) / (2 * h);
    const std::array<unsigned, 1> unknowns{fmu.reference("f")};
    const std::array<unsigned, 2> knowns{2, 5};
    const std::array<double, 2> seed{1, 0.5};
    double slope = 0;
    const auto derivative = [&](const unsigned* unknown, const unsigned* known) {
      return fmu.version == 2 ? fmu.call("GetDirectionalDerivative", instance.handle, unknown,
                                         std::size_t{1}, known, std::size_t{2}, seed.data(), &slope)
                              : fmu.call("GetDirectionalDerivative", instance.handle, unknown,
                                         std::size_t{1}, known, std::size_t{2}, seed.data(),
                                         std::size_t{2}, &slope, std::size_t{1});
    };
    CHECK(derivative(unknowns.data(), knowns.data()) == 0);
    CHECK_CLOSE(slope, expected, 1e-6, 0);
    CHECK(derivative(knowns.data(), knowns.data()) == 3);
    CHECK(says(instance, "is not an unknown"));
    CHECK(derivative(unknowns.data(), std::array<unsigned, 2>{2, 4}.data()) == 3);
    CHECK(says(instance, "is not a known"));
    CHECK(derivative(nullptr, knowns.data()) == 3);
    CHECK(says(instance, "null pointer"));
  });
}

TEST_CASE("FMU: wrong calls end in an error and a message") {
  for_both_versions([](const LoadedFmu& fmu) {
    FmuInstance instance(fmu, false);
    CHECK(instance.step(0, kStep) == 3);
    CHECK(says(instance, "DoStep: must not be called before initialization mode"));
    CHECK(instance.exit_initialization() == 3);
    CHECK(instance.enter_initialization(kNan) == 3);
    CHECK(says(instance, "cannot run from"));
    CHECK(instance.set({1}, {kNan}) == 3);
    CHECK(says(instance, "the value for s is not a finite number"));
    CHECK(instance.set({4}, {1}) == 3);
    CHECK(says(instance, "f is neither an input nor a parameter"));
    CHECK(instance.set({4711}, {1}) == 3);
    CHECK(says(instance, "no variable with value reference 4711"));
    std::vector<double> values;
    CHECK(instance.get({4711}, values) == 3);
    instance.initialize({0, 0, 0});
    CHECK(instance.enter_initialization() == 3);
    CHECK(instance.step(0, -kStep) == 3);
    CHECK(instance.step(0, kNan) == 3);
    CHECK(instance.step(0, 1e9) == 3);
    CHECK(says(instance, "a step of 1e+09 s is impossible"));
    CHECK(instance.step(1, kStep) == 3);
    CHECK(says(instance, "begins at 1 s but the last step ended at 0 s"));
    CHECK(fmu.call("SetTime", instance.handle, 0.0) == 3);
    CHECK(says(instance, "must not be called in co-simulation"));
    CHECK(fmu.call("EnterContinuousTimeMode", instance.handle) == 3);
    const std::string reading = fmu.version == 2 ? "GetReal" : "GetFloat64";
    const unsigned force = 4;
    double value = 0;
    const auto* none = static_cast<const unsigned*>(nullptr);
    auto* nowhere = static_cast<double*>(nullptr);
    const std::size_t one = 1, two = 2;
    if (fmu.version == 2) {
      CHECK(fmu.call(reading, instance.handle, none, one, &value) == 3);
      CHECK(fmu.call(reading, instance.handle, &force, one, nowhere) == 3);
      CHECK(fmu.call("GetInteger", instance.handle, &force, one, &value) == 3);
      CHECK(fmu.call("GetInteger", instance.handle, none, std::size_t{0}, nowhere) == 0);
      CHECK(fmu.call("CancelStep", instance.handle) == 3);
    } else {
      CHECK(fmu.call(reading, instance.handle, none, one, &value, one) == 3);
      CHECK(fmu.call(reading, instance.handle, &force, one, nowhere, one) == 3);
      CHECK(fmu.call(reading, instance.handle, &force, one, &value, two) == 3);
      CHECK(says(instance, "got 2 values instead of 1"));
      CHECK(fmu.call("GetInt32", instance.handle, &force, one, &value, one) == 3);
      CHECK(fmu.call("GetInt32", instance.handle, none, std::size_t{0}, nowhere, std::size_t{0}) ==
            0);
      CHECK(fmu.call("EnterConfigurationMode", instance.handle) == 3);
    }
    CHECK(says(instance, "not supported"));
    CHECK(fmu.call(fmu.version == 2 ? "GetFMUstate" : "GetFMUState", instance.handle,
                   static_cast<void**>(nullptr)) == 3);
    CHECK(fmu.call(fmu.version == 2 ? "SetFMUstate" : "SetFMUState", instance.handle,
                   static_cast<void*>(nullptr)) == 3);
    void* nobody = nullptr;
    CHECK(fmu.call("DoStep", nobody, 0.0, kStep, 0) == 3);
    CHECK(fmu.call("Terminate", nobody) == 3);
    CHECK(fmu.call("Reset", nobody) == 3);
    fmu.call<void>("FreeInstance", nobody);
    FmuInstance stranger(fmu, false, "{not this one}");
    CHECK(stranger.handle == nullptr);
    CHECK(says(stranger, "is not that of this FMU, {"));
  });
}

TEST_CASE("FMU: model exchange refuses what does not fit its states") {
  for_both_versions([](const LoadedFmu& fmu) {
    FmuInstance instance(fmu, true);
    std::vector<double> states(bouc_wen().state_size() + 1, 0.0);
    const auto set_states = [&](std::size_t count) {
      return fmu.call("SetContinuousStates", instance.handle,
                      static_cast<const double*>(states.data()), count);
    };
    CHECK(set_states(states.size() - 1) == 3);
    CHECK(says(instance, "must not be called before initialization mode"));
    instance.initialize({0, 0, 1});
    CHECK(fmu.call("EnterContinuousTimeMode", instance.handle) == 0);
    CHECK(set_states(states.size()) == 3);
    states[0] = kNan;
    CHECK(set_states(states.size() - 1) == 3);
    CHECK(says(instance, "value 0 is not a finite number"));
    CHECK(instance.set({fmu.reference("parameter.lag_rate")}, {50}) == 3);
    CHECK(says(instance, "parameters change in event mode only"));
    CHECK(instance.step(0, kStep) == 3);
    CHECK(fmu.call("GetEventIndicators", instance.handle, static_cast<double*>(nullptr),
                   std::size_t{0}) == 0);
    CHECK(fmu.call("EnterEventMode", instance.handle) == 0);
    CHECK(instance.set({fmu.reference("parameter.lag_rate")}, {50}) == 0);
    std::vector<double> nominal(states.size() - 1);
    CHECK(fmu.call("GetNominalsOfContinuousStates", instance.handle, nominal.data(),
                   nominal.size()) == 0);
    for (const double value : nominal) CHECK(value > 0);
  });
}
