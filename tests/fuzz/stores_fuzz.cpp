#include "dashpot/base/file.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/virtual_bench.h"
#include "dashpot/identify/rank/fit_store.h"
#include "dashpot/identify/search/trial_store.h"
#include "dashpot/suspension/sweep/request_file.h"
#include "dashpot/suspension/sweep/store.h"
#include "fuzz.h"
#include "studies/family/family_network.h"
#include "studies/family/training_store.h"

// Files that Dashpot keeps for itself and reads again after an interruption, whatever became of
// them since.

using namespace dashpot;
namespace fs = std::filesystem;

namespace {

/// The path of a file of this process that is not there.
fs::path own_file(const std::string& name) {
  fs::path file = fuzz_file(name, "");
  fs::remove(file);
  return file;
}

/// A file with one result in it, and that result.
struct Kept {
  fs::path file;
  StoreFormat format;
  Store::Result result;

  Kept(fs::path path, const StoreFormat& of) : file(std::move(path)), format(of) {
    Store(file, format).for_each([&](std::string_view key, std::string_view bytes) {
      result = {std::string(key), std::string(bytes)};
    });
  }
  /// Puts other bytes in the place of the result's.
  void put(const std::string& bytes) const { Store(file, format).save(result.key, bytes); }
};

const std::string kModel = "bingham";
constexpr DriveUnit kDrive = DriveUnit::Ampere;

/// A fit, and what it was made from.
struct FitExample {
  Dataset data;
  IdentifyOptions options{.starts = 1, .threads = 1};

  FitExample() {
    BenchOptions bench;
    bench.motions = {{0.01, 1}};
    bench.drive_levels = {0.5, 1};
    bench.sample_rate = 50;
    bench.cycles = 1;
    data = run_virtual_bench(load_parameters("kwok2006"), kDrive, bench);
  }
  FitStore::Request request() const { return {kModel, data.records, kDrive, options}; }
  Kept keep() const {
    const fs::path file = own_file("fits.sqlite");
    FitStore(file, "1").save(request(), identify(kModel, data.records, kDrive, options));
    return {file, FitStore::kFormat};
  }
};

void fit_store(const std::string& input) {
  static const FitExample example;
  static const Kept kept = example.keep();
  kept.put(input);
  const auto fit = FitStore(kept.file, "1").load(example.request());
  require_true(!fit || fit->model);
}

const StudiedNetwork kNetwork{.mlp = {.layers = {2, 1, 1}, .parameters = {1, 2, 3, 4, 5}},
                              .history = {2, 1}};

Kept keep_training() {
  const fs::path file = own_file("trainings.sqlite");
  TrainingStore(file, "1", {}).save("key", kNetwork);
  return {file, TrainingStore::kFormat};
}

void training_store(const std::string& input) {
  static const Kept kept = keep_training();
  kept.put(input);
  StudiedNetwork network = kNetwork;
  (void)TrainingStore(kept.file, "1", {}).load("key", network);
  require_true(network.mlp.parameters.size() == 5);
}

const NamedTexts kSearch{{"data", "a"}, {"seed", "1"}};
const TrialStore::Key kTrial{"hidden=5", 1, 0};

void trial_store(const std::string& input) {
  const fs::path file = fuzz_file("search.sqlite", input);
  TrialStore store(file, kSearch);
  (void)store.load(kTrial);
  (void)store.size();
  store.save({"hidden=6", 1, 0}, {});
}

SweepRequest small_sweep() {
  SweepRequest request = named_sweep("comfort");
  request.samples = 2;
  return request;
}

void sweep_store(const std::string& input) {
  static const SweepRequest request = small_sweep();
  const fs::path file = fuzz_file("sweep.sqlite", input);
  SweepStore store(file, request, "1");
  for (const SweepStore::Ride& ride : store.load())
    require_true(ride.controller < request.controllers.size() && ride.vehicle < request.vehicles());
}

const FuzzTarget targets[] = {{"fit_store", fit_store},
                              {"training_store", training_store},
                              {"trial_store", trial_store},
                              {"sweep_store", sweep_store}};

}  // namespace

void write_store_seeds(const fs::path& folder) {
  write_file(folder / "fit_store/kept", FitExample().keep().result.bytes);
  write_file(folder / "training_store/kept", keep_training().result.bytes);
  fs::create_directories(folder / "trial_store");
  TrialStore(folder / "trial_store/kept", kSearch).save(kTrial, {});
  fs::create_directories(folder / "sweep_store");
  SweepStore(folder / "sweep_store/kept", small_sweep(), "1").save({{0, 0, {}}, {1, 1, {}}});
}
