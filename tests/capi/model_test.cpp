#include <cmath>
#include <limits>
#include <utility>

#include "dashpot/damper/parameter_set.h"
#include "dashpot/evaluate.h"
#include "handles.h"

namespace {

struct Sine {
  explicit Sine(std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
      const double phase = 0.05 * static_cast<double>(k);
      time.push_back(0.002 * static_cast<double>(k));
      inputs.push_back({0.01 * std::sin(phase), 0.25 * std::cos(phase), 1.0});
    }
  }
  std::vector<double> time;
  std::vector<dashpot::DamperInput> inputs;

  /// The inputs where they lie: one struct behind the other.
  dashpot_motion motion() const {
    dashpot_motion motion = {};
    motion.samples = inputs.size();
    motion.sample_time = 0.002;
    motion.displacement = {&inputs.data()->displacement, 3};
    motion.velocity = {&inputs.data()->velocity, 3};
    motion.current = {&inputs.data()->current, 3};
    return motion;
  }
};

std::string run_message(const dashpot_model* model, const dashpot_motion& motion) {
  std::vector<double> force(motion.samples);
  const dashpot_response response = {force.data(), nullptr, nullptr, 0};
  return message_of(DASHPOT_BAD_INPUT, dashpot_run(model, &motion, &response));
}

}  // namespace

TEST_CASE(
    "a whole motion gives the library's free run, bit for bit, from columns that lie anyhow") {
  const Model model = published();
  const Sine sine(500);
  const dashpot::FreeRun expected =
      dashpot::free_run(dashpot::load_parameters("spencer1997_bouc_wen"), sine.inputs, sine.time);
  std::vector<double> force(500);
  const dashpot_response response = {force.data(), nullptr, nullptr, 0};
  dashpot_motion motion = sine.motion();
  motion.time = {sine.time.data(), 1};
  REQUIRE(dashpot_run(model, &motion, &response) == DASHPOT_OK);
  CHECK(force == expected.force);
  // A current that is one value for all samples.
  const double current = 1;
  motion.current = {&current, 0};
  REQUIRE(dashpot_run(model, &motion, &response) == DASHPOT_OK);
  CHECK(force == expected.force);
}

TEST_CASE("a long motion is refused at the sample that cannot be, wherever that lies") {
  const Model model = published();
  for (const std::size_t bad : {1, 254, 255, 256, 510, 511, 599}) {
    Sine sine(600);
    dashpot_motion motion = sine.motion();
    motion.time = {sine.time.data(), 1};
    const std::string at = '[' + std::to_string(bad) + ']';
    const double time = std::exchange(sine.time[bad], sine.time[bad - 1]);
    CHECK(contains(run_message(model, motion), "time" + at));
    sine.time[bad] = time;
    sine.inputs[bad].velocity = kNaN;
    CHECK(contains(run_message(model, motion), "velocity" + at + ": is nan"));
  }
}

TEST_CASE("steps one by one and a motion in two parts give the same as the whole") {
  const Model model = published();
  dashpot_model_info info;
  REQUIRE(dashpot_model_get_info(model, &info) == DASHPOT_OK);
  REQUIRE(info.state_size > 0);
  const Sine sine(100);
  std::vector<double> whole(100), stepped(100), parts(100), state(info.state_size);
  const dashpot_motion motion = sine.motion();
  const dashpot_response response = {whole.data(), nullptr, nullptr, 0};
  REQUIRE(dashpot_run(model, &motion, &response) == DASHPOT_OK);

  const auto at = [&](std::size_t k) {
    return dashpot_input{sine.inputs[k].displacement, sine.inputs[k].velocity,
                         sine.inputs[k].current};
  };
  for (std::size_t k = 0; k < 100; ++k) {
    const dashpot_input now = at(k), before = at(k > 0 ? k - 1 : 0);
    REQUIRE((k == 0 ? dashpot_rest(model, &now, state.data(), state.size())
                    : dashpot_advance(model, &before, &now, 0.002, state.data(), state.size())) ==
            DASHPOT_OK);
    REQUIRE(dashpot_force(model, &now, state.data(), state.size(), &stepped[k]) == DASHPOT_OK);
  }
  CHECK(stepped == whole);

  const dashpot_input first = at(0);
  REQUIRE(dashpot_rest(model, &first, state.data(), state.size()) == DASHPOT_OK);
  dashpot_motion part = motion;
  part.samples = 60;
  dashpot_response kept = {parts.data(), nullptr, state.data(), state.size()};
  REQUIRE(dashpot_run(model, &part, &kept) == DASHPOT_OK);
  part.samples = 41;
  part.displacement.data += 59 * 3, part.velocity.data += 59 * 3, part.current.data += 59 * 3;
  kept.force = parts.data() + 59;
  REQUIRE(dashpot_run(model, &part, &kept) == DASHPOT_OK);
  CHECK(parts == whole);
}

TEST_CASE("a model's text and file give the same model again") {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "model.json").string();
  const Model model = published();
  Text text, again;
  REQUIRE(dashpot_model_text(model, &text) == DASHPOT_OK);
  Model parsed, loaded;
  REQUIRE(dashpot_model_parse(text, &parsed) == DASHPOT_OK);
  REQUIRE(dashpot_model_save(parsed, path.c_str()) == DASHPOT_OK);
  REQUIRE(dashpot_model_load(path.c_str(), &loaded) == DASHPOT_OK);
  REQUIRE(dashpot_model_text(loaded, &again) == DASHPOT_OK);
  CHECK(std::string(text) == std::string(again));
  dashpot_model_info info;
  REQUIRE(dashpot_model_get_info(loaded, &info) == DASHPOT_OK);
  CHECK(std::string(info.name) == "bouc_wen");
  CHECK(std::string(info.kind) == "law");
  CHECK(std::string(info.drive_unit) == "V");
  CHECK(info.needs_displacement == 1);
}

TEST_CASE("null pointers give a status and a message in every function of a model") {
  const Model model = published();
  const dashpot_input input = {};
  double force = 0;
  dashpot_model* none = nullptr;
  char* text = nullptr;
  const dashpot_status statuses[] = {dashpot_model_load(nullptr, &none),
                                     dashpot_model_load("a", nullptr),
                                     dashpot_model_parse(nullptr, &none),
                                     dashpot_model_parse("{}", nullptr),
                                     dashpot_model_published(nullptr, &none),
                                     dashpot_model_published("spencer1997", nullptr),
                                     dashpot_model_save(nullptr, "a"),
                                     dashpot_model_save(model, nullptr),
                                     dashpot_model_text(nullptr, &text),
                                     dashpot_model_text(model, nullptr),
                                     dashpot_model_get_info(nullptr, nullptr),
                                     dashpot_model_get_info(model, nullptr),
                                     dashpot_rest(nullptr, &input, &force, 1),
                                     dashpot_rest(model, nullptr, &force, 1),
                                     dashpot_rest(model, &input, nullptr, 1),
                                     dashpot_advance(nullptr, &input, &input, 1e-3, &force, 1),
                                     dashpot_advance(model, nullptr, &input, 1e-3, &force, 1),
                                     dashpot_advance(model, &input, nullptr, 1e-3, &force, 1),
                                     dashpot_advance(model, &input, &input, 1e-3, nullptr, 1),
                                     dashpot_force(nullptr, &input, &force, 1, &force),
                                     dashpot_force(model, nullptr, &force, 1, &force),
                                     dashpot_force(model, &input, nullptr, 1, &force),
                                     dashpot_force(model, &input, &force, 1, nullptr),
                                     dashpot_run(nullptr, nullptr, nullptr),
                                     dashpot_run(model, nullptr, nullptr)};
  for (const dashpot_status status : statuses) {
    CHECK(status == DASHPOT_BAD_INPUT);
    CHECK(contains(dashpot_last_error(), "null"));
  }
  dashpot_model_free(nullptr);
  dashpot_model_free(&none);
  dashpot_text_free(nullptr);
  dashpot_text_free(&text);
}

TEST_CASE("wrong sizes, steps and numbers are told by name") {
  const Model model = published();
  const dashpot_input input = {};
  double state[3] = {};
  CHECK(contains(message_of(DASHPOT_BAD_INPUT, dashpot_rest(model, &input, state, 3)),
                 "state_size: is 3; bouc_wen has 1 states"));
  for (const double dt : {0.0, -1e-3, kNaN, kInfinity})
    CHECK(contains(
        message_of(DASHPOT_BAD_INPUT, dashpot_advance(model, &input, &input, dt, state, 1)), "dt"));
  const dashpot_input broken = {0, kNaN, 0};
  CHECK(contains(message_of(DASHPOT_BAD_INPUT, dashpot_rest(model, &broken, state, 1)),
                 "velocity: is nan"));

  Sine sine(10);
  sine.inputs[7].current = kInfinity;
  CHECK(contains(run_message(model, sine.motion()), "current[7]: is inf"));
  sine.inputs[7].current = 1;
  sine.inputs[2].velocity = 1.6e308, sine.inputs[2].displacement = 1.6e308;
  CHECK(contains(run_message(model, sine.motion()), "sample[2]: holds numbers too large"));
  dashpot_motion motion = Sine(10).motion();
  motion.sample_time = 0;
  const Sine whole(10);
  motion.velocity = {&whole.inputs.data()->velocity, 3};
  motion.displacement = {nullptr, 0};
  CHECK(contains(run_message(model, motion), "bouc_wen needs it"));
  motion.displacement = motion.current = motion.velocity;
  CHECK(contains(run_message(model, motion), "sample_time"));
  std::vector<double> stopped = {0, 1, 1, 2, 3, 4, 5, 6, 7, 8};
  motion.time = {stopped.data(), 1};
  CHECK(contains(run_message(model, motion), "time[2]"));
  motion.velocity = {nullptr, 1};
  CHECK(contains(run_message(model, motion), "velocity: is null"));
  std::vector<double> force(10);
  const dashpot_motion good = whole.motion();
  const dashpot_response banded = {force.data(), force.data(), nullptr, 0};
  CHECK(contains(message_of(DASHPOT_BAD_INPUT, dashpot_run(model, &good, &banded)), "has no band"));
}

TEST_CASE("a state that is no number gives a status, not a force") {
  const Model model = published();
  const dashpot_input input = {0, 0.1, 1};
  const double state = kNaN;
  double force = 0;
  CHECK(contains(message_of(DASHPOT_NOT_USABLE, dashpot_force(model, &input, &state, 1, &force)),
                 "diverged"));
}

TEST_CASE(
    "files that are no models, and names that nothing has, are refused with what would be right") {
  const TemporaryFolder folder;
  dashpot_model* model = nullptr;
  CHECK(contains(message_of(DASHPOT_BAD_INPUT, dashpot_model_load("/nowhere/model.json", &model)),
                 "nowhere"));
  for (const char* text : {"", "{", "[]", "{\"format\": \"dashpot-model\"}", "\xff\xfe"})
    CHECK(dashpot_model_parse(text, &model) == DASHPOT_BAD_INPUT);
  CHECK(contains(message_of(DASHPOT_BAD_INPUT, dashpot_model_published("spenser1997", &model)),
                 "did you mean 'spencer1997'"));
  CHECK(model == nullptr);
  const Model good = published();
  CHECK(dashpot_model_save(good, folder.path().c_str()) == DASHPOT_BAD_INPUT);
}
