// FMUs of controllers and inverses, driven along the runs that their C is checked along.
#include "dashpot/base/parallel.h"
#include "output/exporters/control_cases.h"
#include "output/exporters/fmu_importer.h"

using namespace dashpot;

namespace {

struct Task {
  std::string name;
  CBlockMaker block;
  int version = 2;
  std::string archive = {};
};

/// FMI 2 and FMI 3 in turn.
std::vector<Task> tasks() {
  std::vector<Task> all;
  const auto add = [&](const std::string& name, CBlockMaker block) {
    all.push_back({name, std::move(block), all.size() % 2 == 0 ? 2 : 3});
  };
  for (const ControlCase& one : control_cases())
    add(one.name, [vehicle = std::make_shared<const Vehicle>(make_vehicle(one.words))](
                      const ExportOptions& options) { return c_controller_block(*vehicle, options); });
  for (const InverseCase& one : inverse_cases())
    if (!one.name.ends_with("_lag"))  // the same but for the C, which is run without an FMU
      add(one.name, [one](const ExportOptions& options) { return c_inverse_block(one.exported(), options); });
  return all;
}

/// Sets what is known at each sample, then reads the commands there.
void check_commands(const LoadedFmu& fmu, const CBlock& block) {
  const std::size_t inputs = block.samples[0].inputs.size(), commands = block.samples[0].commands.size();
  std::vector<unsigned> outputs(commands);
  std::iota(outputs.begin(), outputs.end(), static_cast<unsigned>(1 + inputs));
  FmuInstance instance(fmu, false);
  REQUIRE(instance.handle);
  std::vector<double> read;
  for (std::size_t k = 0; k < block.samples.size(); ++k) {
    const CBlock::Sample& sample = block.samples[k];
    if (k == 0) {
      instance.initialize_at(sample.inputs);
    } else {
      REQUIRE(instance.step(static_cast<double>(k - 1) * block.sample_time, block.sample_time) == 0);
      REQUIRE(instance.set_inputs(sample.inputs) == 0);
    }
    REQUIRE(instance.get(outputs, read) == 0);
    for (std::size_t i = 0; i < commands && sample.matters; ++i)
      CHECK_CLOSE(read[i], sample.commands[i], 0, 1e-12 * block.range);
  }
  CHECK(instance.messages.empty());
}

}  // namespace

TEST_CASE("FMUs of every controller and inverse give the library's commands") {
  if (!has_compiler()) return;
  std::vector<Task> all = tasks();
  parallel_for(all.size(), 0, [&](std::size_t k) { all[k].archive = fmu_of(all[k].block, all[k].version); });
  for (const Task& task : all) {
    CAPTURE(task.name);
    const LoadedFmu fmu(task.archive);
    CHECK(!fmu.exchanges());
    check_commands(fmu, task.block({}));
  }
}
