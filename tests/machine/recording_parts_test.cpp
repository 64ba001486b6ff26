#include "dashpot/machine/recording_parts.h"

#include <cmath>

#include "dashpot/base/random.h"
#include "dashpot/machine/model_in_plant.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A mass of 2 kg on 5 N/mm, a dashpot of 30 N*s/m and friction of 4 N; 500 Hz. It is pushed by
/// `strength(t)` times a sum of cosines; both channels with noise of a thousandth or so.
template <class Strength>
PlantRecording pushed_by(Strength&& strength, double seconds) {
  constexpr double kStep = 1e-5;
  constexpr int kEvery = 200;
  PlantRecording recording{.name = "pushed", .sample_time = kEvery * kStep, .channels = {}};
  recording.channels = {{.name = "push", .unit = "N", .samples = {}, .origin = {}},
                        {.name = "x", .unit = "m", .samples = {}, .origin = {}}};
  Random random(4);
  double x = 0, v = 0;
  for (int k = 0; k < static_cast<int>(seconds / kStep); ++k) {
    double push = 0;
    for (int n = 1; n < 9; ++n) push += 12 * std::cos(6.0 * n * kStep * k + n * n);
    push *= strength(kStep * k);
    if (k % kEvery == 0) {
      recording.channels[0].samples.push_back(push + 0.02 * random.normal());
      recording.channels[1].samples.push_back(x + 1e-5 * random.normal());
    }
    v += kStep / 2 * (push - 5000 * x - 30 * v - 4 * std::tanh(v / 0.01));
    x += kStep * v;
  }
  recording.samples = recording.channels[0].samples.size();
  return recording;
}

InPlantSetup moved_setup() {
  InPlantSetup setup;
  setup.model = &find_machine("oscillator", "test");
  setup.known = {{"stiffness", 5000}};
  setup.unknown = {{"mass", 0.5, 8, 1.6}};
  setup.inputs = {{"push", {PlantInput::Force, 0}}};
  setup.sensors = {{.channel = "x", .place = {PlantQuantity::Displacement, 0}}};
  return setup;
}

double found_mass(const std::string& law, const PlantRecording& recording) {
  const std::vector<std::string> models{law};
  const InPlantReport report =
      identify_in_plant(models, moved_setup(), {recording}, {.grade = ""}).front().report;
  return report.has_models() ? report.plant.front().value : NAN;
}

}  // namespace

TEST_CASE("in plant: the ends at which a plant stands still are left out, and said") {
  const InPlantSetup setup = moved_setup();
  const auto waits = [](double t) { return t < 4 || t > 8 ? 0.0 : 1.0; };
  const std::vector<PlantRecording> whole{pushed_by(waits, 12)};
  const PlantRecording part = moving_parts(setup, whole).front();

  // 0.2 s of either end stay, and what rings on at the last one.
  CHECK(part.samples > 2000);
  CHECK(part.samples < 2000 + 2 * 150 + 200);
  CHECK(part.channels[1].samples.size() == part.samples);
  CHECK(contains(still_parts(setup, whole),
                 "Left out is where the plant stands still: pushed (0 to 3.8 s, 8."));
  CHECK(still_parts(setup, {part}).empty());
  CHECK(moving_parts(setup, {part}).front().samples == part.samples);

  // Less than a second is kept as it is, and so is a pause between.
  const auto pauses = [](double t) { return t < 0.9 || (t > 2 && t < 4) ? 0.0 : 1.0; };
  const std::vector<PlantRecording> paused{pushed_by(pauses, 6)};
  CHECK(still_parts(setup, paused).empty());
  CHECK(moving_parts(setup, paused).front().samples == paused.front().samples);
}

TEST_CASE("in plant: where nothing measures the road, a recording falls apart at its pauses") {
  InPlantSetup setup = moved_setup();
  setup.inputs = {{"", {PlantInput::Ground, 0}, 0, RoadPrior{}}};
  const auto pauses = [](double t) { return t > 3 && t < 6 ? 0.0 : 1.0; };
  const std::vector<PlantRecording> whole{pushed_by(pauses, 12)};
  const std::vector<PlantRecording> parts = moving_parts(setup, whole);
  REQUIRE(parts.size() == 2);
  CHECK(contains(parts[0].name, "pushed, 0 to 3."));
  CHECK(contains(parts[1].name, "pushed, 5.8 to 12 s"));
  CHECK(parts[1].channel("x").samples.front() == whole[0].channel("x").samples[2900]);
  CHECK(contains(still_parts(setup, whole), "pushed (3."));
  CHECK(moving_parts(setup, parts).size() == 2);

  // What is too short between two of them is not fitted.
  const auto hurries = [](double t) { return (t > 3 && t < 6) || (t > 7 && t < 9) ? 0.0 : 1.0; };
  CHECK(moving_parts(setup, {pushed_by(hurries, 12)}).size() == 2);
}

TEST_CASE("in plant: where a recording begins quietly, starts are looked for where it moves") {
  const InPlantSetup setup = moved_setup();
  const auto smooth = [](double t) { return t < 6 ? 0.1 : 1.0; };
  const PlantRecording recording = pushed_by(smooth, 20);
  const std::vector<PlantRecording> lively = lively_parts(setup, {recording}, 2500);
  REQUIRE(lively.size() == 1);

  // Behind the smooth part, and what is held back stays unseen.
  const std::size_t first = recording.samples - lively.front().samples;
  const std::size_t fitted = static_cast<std::size_t>(0.75 * double(lively.front().samples));
  CHECK(lively.front().channels[0].samples.front() == recording.channels[0].samples[3000]);
  CHECK(3000 + fitted <= 7501);
  CHECK(3000 + fitted >= 7499);
  CHECK(first > 500);

  CHECK(lively_parts(setup, {pushed_by([](double) { return 1.0; }, 20)}, 2500).empty());
  CHECK(lively_parts(setup, {recording}, 5000).empty());  // the horizon reaches as far as all
  CHECK(lively_parts(setup, {recording}, 5).empty());     // too few samples tell nothing, and end
  InPlantSetup rests = setup;
  rests.from_rest = true;
  CHECK(lively_parts(rests, {recording}, 2500).empty());
}

TEST_CASE("in plant: a still or a smooth beginning does not lead a fit astray" *
          doctest::test_suite("long")) {
  const auto waits = [](double t) { return t < 6 || t > 10 ? 0.0 : 1.0; };
  const auto smooth = [](double t) { return t < 5 ? 0.02 : 1.0; };
  for (const std::string law : {"tanh_guo", "bouc_wen"}) {
    CAPTURE(law);
    CHECK_CLOSE(found_mass(law, pushed_by(waits, 13)), 2, 0.03, 0);
    CHECK_CLOSE(found_mass(law, pushed_by(smooth, 13)), 2, 0.03, 0);
  }
}
