#include "dashpot/identify/rank/fit_store.h"

#include "dashpot/base/file.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/virtual_bench.h"
#include "dashpot/identify/judge/stress.h"
#include "dashpot/rank.h"
#include "support.h"

using namespace dashpot;
namespace fs = std::filesystem;

namespace {

Dataset campaign() {
  BenchOptions options;
  options.motions = {{0.01, 1}, {0.005, 3}};
  options.drive_levels = {0.5, 1};
  options.sample_rate = 100;
  options.cycles = 2;
  return run_virtual_bench(load_parameters("kwok2006"), DriveUnit::Ampere, options);
}

}  // namespace

TEST_CASE("a kept fit comes back whole, law or network") {
  const TemporaryFolder folder;
  const Dataset data = campaign();
  FitStore store(folder.path() / "fits.sqlite", "1");
  const IdentifyOptions options{.starts = 1};
  for (const std::string model : {"tanh_kwok", "mlp_one_sensor"}) {
    CAPTURE(model);
    const FitStore::Request request{model, data.records, DriveUnit::Ampere, options};
    CHECK(!store.load(request));
    const FitReport made = identify(model, data.records, DriveUnit::Ampere, options);
    store.save(request, made);
    const auto kept = store.load(request);
    REQUIRE(kept);
    CHECK(format_json(kept->model->to_json()) == format_json(made.model->to_json()));
    CHECK(kept->status == made.status);
    CHECK(kept->offsets == made.offsets);
    CHECK(kept->warnings == made.warnings);
    CHECK(kept->seconds == made.seconds);
    CHECK(kept->training_rmse == made.training_rmse);
    REQUIRE(kept->parameters.size() == made.parameters.size());
    for (std::size_t k = 0; k < made.parameters.size(); ++k) {
      CHECK(kept->parameters[k].name == made.parameters[k].name);
      CHECK(kept->parameters[k].low == made.parameters[k].low);
      CHECK(kept->parameters[k].weak == made.parameters[k].weak);
    }
  }
}

TEST_CASE("another program, sample, record, option or drive is another fit") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "fits.sqlite";
  const Dataset data = campaign();
  const std::string model = "bingham", other = "tanh_kwok";
  const DriveUnit ampere = DriveUnit::Ampere, volt = DriveUnit::Volt;
  const IdentifyOptions options;
  FitStore(file, "1").save({model, data.records, ampere, options},
                           identify(model, data.records, ampere, options));
  CHECK(!FitStore(file, "2").load({model, data.records, ampere, options}));

  const FitStore store(file, "1");
  REQUIRE(store.load({model, data.records, ampere, options}));
  CHECK(store.load(
      {model, data.records, ampere, IdentifyOptions{.threads = 3}}));  // changes no result
  CHECK(!store.load({other, data.records, ampere, options}));
  CHECK(!store.load({model, data.records, volt, options}));
  CHECK(!store.load({model, data.records, ampere, IdentifyOptions{.offset = OffsetMode::None}}));
  CHECK(!store.load({model, data.records, ampere, IdentifyOptions{.starts = 5}}));
  CHECK(!store.load({model, data.records, ampere, IdentifyOptions{.seed = 2}}));
  std::vector<Record> changed = data.records;
  changed[1].find("force")->samples[7] += 1e-9;
  CHECK(!store.load({model, changed, ampere, options}));
  changed = data.records;
  changed[1].warm_up += 1;
  CHECK(!store.load({model, changed, ampere, options}));
  changed = data.records;
  changed.pop_back();
  CHECK(!store.load({model, changed, ampere, options}));
}

TEST_CASE("a damaged fit is none, and is made again in its place") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "fits.sqlite";
  const Dataset data = campaign();
  const std::string model = "bingham";
  const DriveUnit unit = DriveUnit::Ampere;
  const IdentifyOptions options;
  const FitStore::Request request{model, data.records, unit, options};
  const FitReport fit = identify(model, data.records, unit, options);
  FitStore(file, "1").save(request, fit);

  std::string key, good;
  Store(file, FitStore::kFormat).for_each([&](std::string_view name, std::string_view bytes) {
    key = name;
    good = bytes;
  });
  for (const std::string& bad : {std::string(), good.substr(0, good.size() / 2), std::string("{}"),
                                 std::string("[1]"), std::string("{\"converged\": 3}")}) {
    Store(file, FitStore::kFormat).save(key, bad);
    CHECK(!FitStore(file, "1").load(request));
  }
  FitStore store(file, "1");
  store.save(request, fit);
  CHECK(store.load(request));
}

TEST_CASE("a ranking from kept fits is the ranking, bit for bit") {
  const TemporaryFolder folder;
  const Dataset data = campaign();
  FitStore store(folder.path() / "fits.sqlite", "1");
  const std::vector<std::string> models = {"bingham", "tanh_kwok"};
  const Ranking first = rank(models, data, {}, {}, &store),
                again = rank(models, data, {}, {}, &store);
  CHECK(first.kept_fits == 0);
  CHECK(again.kept_fits == 6);  // two models, two folds and a final fit each
  for (std::size_t k = 0; k < models.size(); ++k) {
    CHECK(again.models[k].name == first.models[k].name);
    CHECK(again.models[k].left_out.pooled.esr == first.models[k].left_out.pooled.esr);
    CHECK(again.models[k].training.pooled.rmse == first.models[k].training.pooled.rmse);
    CHECK(again.models[k].stress.largest_share == first.models[k].stress.largest_share);
    CHECK(again.models[k].stress.is_bounded());
  }
}
