#include "dashpot/machine/plant_fit_store.h"

#include <atomic>
#include <cmath>

#include "dashpot/machine/in_plant_result.h"
#include "dashpot/machine/model_in_plant.h"
#include "support.h"

using namespace dashpot;
namespace fs = std::filesystem;

namespace {

/// A mass of 2 kg on 5 N/mm, a dashpot of 30 N*s/m and friction of 4 N, pushed; 500 Hz.
PlantRecording pushed_mass() {
  constexpr double kStep = 1e-5;
  PlantRecording recording{.name = "pushed", .sample_time = 200 * kStep, .channels = {}};
  recording.channels = {{.name = "push", .unit = "N", .samples = {}, .origin = {}},
                        {.name = "x", .unit = "m", .samples = {}, .origin = {}}};
  double x = 0, v = 0;
  for (int k = 0; k < 200000; ++k) {
    double push = 0;
    for (int n = 1; n < 9; ++n) push += 12 * std::cos(6.0 * n * kStep * k + n * n);
    if (k % 200 == 0) {
      recording.channels[0].samples.push_back(push);
      recording.channels[1].samples.push_back(x);
    }
    v += kStep / 2 * (push - 5000 * x - 30 * v - 4 * std::tanh(v / 0.01));
    x += kStep * v;
  }
  recording.samples = recording.channels[0].samples.size();
  return recording;
}

InPlantSetup kept_setup() {
  InPlantSetup setup;
  setup.model = &find_machine("oscillator", "test");
  setup.known = {{"stiffness", 5000}};
  setup.unknown = {{"mass", 0.5, 8, 1.6}};
  setup.inputs = {{"push", {PlantInput::Force, 0}}};
  setup.sensors = {{.channel = "x", .place = {PlantQuantity::Displacement, 0}}};
  return setup;
}

InPlantOptions kept_options() {
  InPlantOptions options{.starts = 2, .profiles = {"mass"}};
  options.network.members = 1;
  options.network.epochs = 60;
  return options;
}

std::string told(const InPlantFit& fit) { return format_json(to_json(fit.report, fit.model)); }

}  // namespace

TEST_CASE("in plant: an interrupted identification goes on behind its last model, as if never" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::vector<PlantRecording> recordings{pushed_mass()};
  const InPlantSetup setup = kept_setup();
  const std::vector<std::string> models{"tanh_guo", "hysteresis_network"};
  PlantFitStore store(folder.path() / "plant-fits.sqlite", "1");

  // Stopped as soon as the second model is on its way.
  std::atomic<bool> stop = false;
  InPlantOptions stopped = kept_options();
  stopped.monitor.stop = &stop;
  stopped.monitor.on_progress = [&](const Progress& progress) {
    if (progress.stage.starts_with("hysteresis_network")) stop = true;
  };
  CHECK_THROWS_AS(identify_in_plant(models, setup, recordings, stopped, &store), Interrupted);

  // The network learns along what the file has of the law just as along the law itself.
  const auto again = identify_in_plant(models, setup, recordings, kept_options(), &store);
  const auto kept = identify_in_plant(models, setup, recordings, kept_options(), &store);
  const auto without = identify_in_plant(models, setup, recordings, kept_options());
  REQUIRE(again.size() == 2);
  CHECK(again[0].was_kept);
  CHECK_FALSE(again[1].was_kept);
  for (std::size_t k = 0; k < 2; ++k) {
    CAPTURE(models[k]);
    CHECK(kept[k].was_kept);
    CHECK(told(kept[k]) == told(again[k]));
    REQUIRE(without[k].report.has_models());
    CHECK(format_json(kept[k].report.kinds.front().model->to_json()) ==
          format_json(without[k].report.kinds.front().model->to_json()));
    CHECK(kept[k].report.method == without[k].report.method);
    CHECK(kept[k].report.kinds.front().domain.velocity_max ==
          without[k].report.kinds.front().domain.velocity_max);
    CHECK(has_interval(kept[k].report.plant[0]) == has_interval(without[k].report.plant[0]));
    REQUIRE(kept[k].report.traces.size() == 1);
    CHECK(kept[k].report.traces[0].modelled == without[k].report.traces[0].modelled);
    CHECK(kept[k].report.traces[0].dampers[0].force ==
          without[k].report.traces[0].dampers[0].force);
  }
}

TEST_CASE("in plant: another program, plant, sample, option or law before it is another fit") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "plant-fits.sqlite";
  const std::vector<PlantRecording> recordings{pushed_mass()};
  const InPlantSetup setup = kept_setup();
  const std::string law = "tanh_guo", other = "tanh_kwok", none;
  const InPlantOptions options = kept_options();
  const auto fits = identify_in_plant(std::vector{law}, setup, recordings, options);
  PlantFitStore(file, "1").save({law, none, setup, recordings, options}, fits[0].report);
  CHECK_FALSE(PlantFitStore(file, "2").load({law, none, setup, recordings, options}));

  const PlantFitStore store(file, "1");
  CHECK(store.load({law, none, setup, recordings, options}));
  CHECK_FALSE(store.load({other, none, setup, recordings, options}));
  CHECK_FALSE(store.load({law, other, setup, recordings, options}));
  InPlantSetup heavier = setup;
  heavier.unknown[0].about = 1.7;
  CHECK_FALSE(store.load({law, none, heavier, recordings, options}));
  std::vector<PlantRecording> changed = recordings;
  changed[0].channels[1].samples[9] += 1e-9;
  CHECK_FALSE(store.load({law, none, setup, changed, options}));
  InPlantOptions asked = options;
  asked.threads = 3;  // changes no result
  CHECK(store.load({law, none, setup, recordings, asked}));
  asked.profiles.clear();
  CHECK_FALSE(store.load({law, none, setup, recordings, asked}));
  asked = options;
  asked.seed = 2;
  CHECK_FALSE(store.load({law, none, setup, recordings, asked}));
}

TEST_CASE("in plant: a damaged fit is none, and is made again in its place") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "plant-fits.sqlite";
  const std::vector<PlantRecording> recordings{pushed_mass()};
  const InPlantSetup setup = kept_setup();
  const std::string law = "tanh_guo", none;
  const InPlantOptions options = kept_options();
  const PlantFitStore::Request request{law, none, setup, recordings, options};
  const std::vector<InPlantFit> fits =
      identify_in_plant(std::vector{law}, setup, recordings, options);
  PlantFitStore(file, "1").save(request, fits[0].report);

  std::string key, good;
  Store(file, PlantFitStore::kFormat).for_each([&](std::string_view name, std::string_view bytes) {
    key = name;
    good = bytes;
  });
  for (const std::string& bad :
       {std::string(), good.substr(0, good.size() / 2), std::string(64, '\xff')}) {
    Store(file, PlantFitStore::kFormat).save(key, bad);
    CHECK_FALSE(PlantFitStore(file, "1").load(request));
  }
  PlantFitStore store(file, "1");
  CHECK_FALSE(identify_in_plant(std::vector{law}, setup, recordings, options, &store)[0].was_kept);
  CHECK(identify_in_plant(std::vector{law}, setup, recordings, options, &store)[0].was_kept);
}
