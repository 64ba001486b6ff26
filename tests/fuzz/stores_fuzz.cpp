#include "dashpot/base/file.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/virtual_bench.h"
#include "dashpot/identify/rank/fit_store.h"
#include "dashpot/identify/search/trial_store.h"
#include "dashpot/suspension/sweep/request.h"
#include "dashpot/suspension/sweep/store.h"
#include "fuzz.h"
#include "studies/family/family_network.h"
#include "studies/family/training_store.h"

// Files that Dashpot keeps for itself and reads again after an interruption, whatever became of
// them since.

using namespace dashpot;
namespace fs = std::filesystem;

namespace {

/// An empty folder of this process.
fs::path own_folder(const std::string& name) {
  const fs::path folder = fuzz_file(name + ".made", "").parent_path() / name;
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

fs::path only_file(const fs::path& folder) { return fs::directory_iterator(folder)->path(); }

/// In the place of a file that was kept.
void put(const fs::path& file, const std::string& content) {
  fuzz_file((file.parent_path().filename() / file.filename()).string(), content);
}

const std::string kModel = "bingham";
const DriveUnit kDrive = DriveUnit::Ampere;

/// A store with one fit in it.
struct KeptFit {
  Dataset data;
  IdentifyOptions options{.starts = 1, .threads = 1};
  fs::path folder = own_folder("fits");
  FitStore store{folder, "1"};
  fs::path file;

  KeptFit() {
    BenchOptions bench;
    bench.motions = {{0.01, 1}};
    bench.drive_levels = {0.5, 1};
    bench.sample_rate = 50;
    bench.cycles = 1;
    data = run_virtual_bench(load_parameters("kwok2006"), kDrive, bench);
    store.save(request(), identify(kModel, data.records, kDrive, options));
    file = only_file(folder);
  }
  FitStore::Request request() const { return {kModel, data.records, kDrive, options}; }
};

void fit_store(const std::string& input) {
  static const KeptFit kept;
  put(kept.file, input);
  const auto fit = kept.store.load(kept.request());
  require_true(!fit || fit->model);
}

/// A store with one trained network in it.
struct KeptTraining {
  StudiedNetwork network{.mlp = {.layers = {2, 1, 1}, .parameters = {1, 2, 3, 4, 5}},
                         .history = {2, 1}};
  fs::path folder = own_folder("trainings");
  TrainingStore store{folder, "1", {}};
  fs::path file;

  KeptTraining() {
    store.save("key", network);
    file = only_file(folder);
  }
};

void training_store(const std::string& input) {
  static const KeptTraining kept;
  put(kept.file, input);
  StudiedNetwork network = kept.network;
  (void)kept.store.load("key", network);
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
  write_file(folder / "fit_store/kept", read_file(KeptFit().file));
  write_file(folder / "training_store/kept", read_file(KeptTraining().file));
  fs::create_directories(folder / "trial_store");
  TrialStore(folder / "trial_store/kept", kSearch).save(kTrial, {});
  fs::create_directories(folder / "sweep_store");
  SweepStore(folder / "sweep_store/kept", small_sweep(), "1").save({{0, 0, {}}, {1, 1, {}}});
}
