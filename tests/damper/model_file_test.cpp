#include "dashpot/model_file.h"

#include "damper/kinds/hybrid/hybrid_model_example.h"
#include "damper/kinds/state_space/state_space_example.h"
#include "dashpot/base/file.h"
#include "dashpot/damper/kinds/fuzzy/fuzzy_model.h"
#include "dashpot/damper/kinds/hybrid/hybrid_model.h"
#include "dashpot/damper/kinds/hysteresis_network/hysteresis_network_model.h"
#include "dashpot/damper/kinds/network/network_model.h"
#include "dashpot/damper/parameter_set.h"
#include "support.h"

using namespace dashpot;

namespace {

ModelFile example(std::unique_ptr<DamperModel> model, DriveUnit drive_unit) {
  ModelFile file;
  file.model = std::move(model);
  file.drive_unit = drive_unit;
  file.sample_time = 1.0 / 3004.8;
  file.domain = {-0.015, 0.015, -0.3, 0.3, 0, 2.25};
  file.provenance = {"2026-01-02T03:04:05Z",
                     "dashpot identify data",
                     "campaign",
                     "someone",
                     {{"a.csv", "00ff"}},
                     {"r1"}};
  file.quality = Value::object({{"esr", 0.1 + 0.2}});
  return file;
}

ModelFile spencer() {
  return example(std::make_unique<LawModel>(load_parameters("spencer1997")), DriveUnit::Volt);
}

Mlp small_network() {
  Mlp mlp;
  mlp.layers = {2, 3, 1};
  for (int k = 0; k < 13; ++k) mlp.parameters.push_back(std::sin(k + 1.0) / 3);
  mlp.input_mean = {0.1, 0.7};
  mlp.input_scale = {0.3, 1.1};
  mlp.output_mean = -3;
  mlp.output_scale = 812.5;
  return mlp;
}

std::string message_after(const std::string& from, const std::string& to) {
  std::string text = format_model(spencer());
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  text.replace(at, from.size(), to);
  return message_of([&] { parse_model(text, "m.json"); });
}

}  // namespace

TEST_CASE("a file keeps the verdict on its model, and one without is measured") {
  ModelFile file = spencer();
  CHECK(dissipation_of(file).dissipates());
  file.dissipation = {.is_tested = true, .frequency = 40, .share = -INFINITY, .active_to = 200};
  const ModelFile again = parse_model(format_model(file), "m.json");
  CHECK(format_model(again) == format_model(file));
  CHECK(dissipation_of(again).share == -INFINITY);
  CHECK(contains(activity(dissipation_of(again), DriveUnit::Volt), "it diverges at 40 Hz"));
}

TEST_CASE(
    "a file keeps the noise that was found beside its model, and says what is wrong with it") {
  ModelFile file = spencer();
  CHECK(parse_model(format_model(file), "m.json").noise_found.empty());
  file.noise_found = {{"az_body", "m/s^2", 0.1 + 0.2, 0.5}};
  const ModelFile again = parse_model(format_model(file), "m.json");
  CHECK(format_model(again) == format_model(file));
  REQUIRE(again.noise_found.size() == 1);
  CHECK(again.noise_found[0].deviation == 0.1 + 0.2);
  file.noise_found[0].deviation = 0;
  CHECK(contains(message_of([&] { parse_model(format_model(file), "m.json"); }),
                 "deviation is not above 0"));
}

TEST_CASE("a law's file comes back as it was, to the last bit") {
  const TemporaryFolder folder;
  const ModelFile saved = spencer();
  save_model(saved, folder.path() / "m.json");
  const ModelFile loaded = load_model(folder.path() / "m.json");
  CHECK(format_model(loaded) == format_model(saved));
  CHECK(loaded.sample_time == 1.0 / 3004.8);
  CHECK(loaded.domain.current_max == 2.25);
  CHECK(loaded.provenance.files.at(0).sha256 == "00ff");
  CHECK(loaded.quality.find("esr")->as_number() == 0.1 + 0.2);
  const auto& law = dynamic_cast<const LawModel&>(*loaded.model);
  CHECK(law.parameters().coefficients == load_parameters("spencer1997").parameters().coefficients);
}

TEST_CASE("a network's file comes back as it was, to the last bit") {
  const ModelFile saved =
      example(std::make_unique<NetworkModel>("mlp_one_sensor",
                                             std::vector<std::string>{"velocity", "current"},
                                             std::vector{small_network()}, 4.5),
              DriveUnit::Ampere);
  const ModelFile loaded = parse_model(format_model(saved), "m.json");
  CHECK(format_model(loaded) == format_model(saved));
  for (const double v : {-0.2, 0.0, 0.13})
    CHECK(loaded.model->force({0, v, 0.5}, {}) == saved.model->force({0, v, 0.5}, {}));
}

TEST_CASE("a fuzzy model's file comes back as it was, to the last bit") {
  const Sugeno sugeno{.inputs = {{0.1, 0.3, -2, 2}},
                      .memberships = {{Membership::Shape::Bell, 0, 0.7 / 3, 1.1, 2.3}},
                      .rules = {{0}},
                      .consequents = {0.1 + 0.2, 4},
                      .output_mean = -3,
                      .output_scale = 812.5};
  const ModelFile saved = example(
      std::make_unique<FuzzyModel>("anfis", FuzzyInputs({"velocity"}, {}, "test"), sugeno, 4.5),
      DriveUnit::Ampere);
  const ModelFile loaded = parse_model(format_model(saved), "m.json");
  CHECK(format_model(loaded) == format_model(saved));
  CHECK(loaded.model->force({0, 0.13, 0.5}, {}) == saved.model->force({0, 0.13, 0.5}, {}));
}

TEST_CASE("a hysteresis network's file comes back as it was, to the last bit") {
  const HysteresisNetwork member{
      .bank = {.path_rates = {100 / 3.0}, .velocity_rates = {}, .current_rates = {50}},
      .network = {.signals = {{0, 0.2, -3, 3}, {0, 1, -1, 1}, {1, 1, -1, 1}},
                  .currents = 1,
                  .neurons = {0.1 + 0.2, 1, -1, 0.5},
                  .gates = std::vector<double>(12, 0.7 / 3),
                  .output_scale = 812.5}};
  const ModelFile saved =
      example(std::make_unique<HysteresisNetworkModel>("hysteresis_network",
                                                       std::vector<HysteresisNetwork>{member}, 4.5),
              DriveUnit::Ampere);
  const ModelFile loaded = parse_model(format_model(saved), "m.json");
  CHECK(format_model(loaded) == format_model(saved));
  const std::vector<double> state{0.3, 0.6};
  CHECK(loaded.model->force({0, 0.13, 0.5}, state) == saved.model->force({0, 0.13, 0.5}, state));
}

TEST_CASE("a state space's file comes back as it was, to the last bit") {
  const ModelFile saved =
      example(std::make_unique<StateSpaceModel>("neural_state_space",
                                                std::vector{example_state_space()}, 4.5),
              DriveUnit::Ampere);
  const ModelFile loaded = parse_model(format_model(saved), "m.json");
  CHECK(format_model(loaded) == format_model(saved));
  const std::vector<double> state{0.3, 0.6, -0.2, 0.1};
  CHECK(loaded.model->force({0, 0.13, 0.5}, state) == saved.model->force({0, 0.13, 0.5}, state));
}

TEST_CASE("a hybrid's file comes back as it was, to the last bit, and its law keeps its bounds") {
  const ModelFile saved = example(std::make_unique<HybridModel>(example_hybrid()), DriveUnit::Volt);
  const ModelFile loaded = parse_model(format_model(saved), "m.json");
  CHECK(format_model(loaded) == format_model(saved));
  std::vector<double> state(saved.model->state_size());
  saved.model->rest({0.01, 0, 0.5}, state);
  CHECK(loaded.model->force({0.01, 0.13, 0.5}, state) ==
        saved.model->force({0.01, 0.13, 0.5}, state));
  CHECK(message_of([&] {
          parse_model(format_model(example(std::make_unique<HybridModel>(example_hybrid()),
                                           DriveUnit::Ampere)),
                      "m.json");
        }).find("drive_unit is V, but A for the file") != std::string::npos);
}

TEST_CASE(
    "a file that an earlier version wrote, with its kind's former name, is read and renamed") {
  const ModelFile old = load_model(project_file("tests/damper/state_network_model.json"));
  CHECK(old.model->kind() == ModelKind::HysteresisNetwork);
  const std::string text = format_model(old);
  CHECK(text.find("\"kind\": \"hysteresis_network\"") != std::string::npos);
  CHECK(format_model(parse_model(text, "m.json")) == text);
}

TEST_CASE("a model file that cannot be used says where and why") {
  const auto mentions = [](const std::string& text, const char* part) {
    CAPTURE(text);
    return text.find("m.json") == 0 && text.find(part) != std::string::npos;
  };
  CHECK(mentions(message_after("dashpot-model", "other"), "write dashpot-model"));
  CHECK(
      mentions(message_after("\"version\": 1", "\"version\": 2"), "this Dashpot reads version 1"));
  CHECK(mentions(message_after("\"kind\": \"law\"", "\"kind\": \"laws\""), "did you mean 'law'"));
  CHECK(mentions(message_after("\"kind\": \"law\"", "\"kind\": \"spline\""),
                 "known: law, network, narx, hysteresis_network, state_space, passive_network, "
                 "fuzzy, hybrid, passive_hybrid, family"));
  CHECK(mentions(message_after("\"sample_time\"", "\"sampletime\""), "needs 'sample_time'"));
  CHECK(mentions(message_after("\"quality\"", "\"qualities\""), "unknown key 'qualities'"));
  CHECK(mentions(message_after("\"unit\": \"m/s\"", "\"unit\": \"mm/s\""), "write m/s"));
  CHECK(mentions(message_after("\"min\": -0.3", "\"min\": 0.5"), "min is above max"));
  CHECK(mentions(message_after("\"drive_unit\": \"V\"", "\"drive_unit\": \"A\""), ""));
  CHECK(mentions(message_after("\"max\": 2.25", "\"max\": 1e9"), "alpha is"));
  CHECK(mentions(message_of([] { parse_model("{\"format\": \"dashpot-model\"", "m.json"); }), ""));
  CHECK(message_of([] { load_model("/nowhere/m.json"); }).find("/nowhere/m.json") !=
        std::string::npos);
}
