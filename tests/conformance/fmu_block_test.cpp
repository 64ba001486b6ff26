// FMUs of controllers and inverses, driven along the runs that their C is checked along.
#include <set>

#include "control_cases.h"
#include "dashpot/base/parallel.h"
#include "export/fmu_importer.h"

using namespace dashpot;

namespace {

/// Sets what is known at each sample, then reads the commands there.
void check_commands(const LoadedFmu& fmu, const CBlock& block) {
  const std::size_t inputs = block.samples[0].inputs.size(),
                    commands = block.samples[0].commands.size();
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
      REQUIRE(instance.step(static_cast<double>(k - 1) * block.sample_time, block.sample_time) ==
              0);
      REQUIRE(instance.set_inputs(sample.inputs) == 0);
    }
    REQUIRE(instance.get(outputs, read) == 0);
    for (std::size_t i = 0; i < commands && sample.matters; ++i)
      CHECK_CLOSE(read[i], sample.commands[i], 0, 1e-12 * block.range);
  }
  CHECK(instance.messages.empty());
}

}  // namespace

TEST_CASE("FMUs of every controller and inverse give the library's commands" *
          doctest::test_suite("long")) {
  if (!has_compiler()) return;
  std::vector<BlockCase> cases = block_cases();
  // Blocks of as many inputs and commands differ in names and in their C alone, which is run for
  // each without an FMU: one of them is enough.
  std::set<std::vector<std::size_t>> known;
  std::erase_if(cases, [&](const BlockCase& one) {
    const CBlock block = one.block({});
    std::vector<std::size_t> ports;
    for (const std::vector<CPort>& side : {block.inputs, block.commands})
      for (const CPort& port : side) ports.push_back(port.count);
    return !known.insert(ports).second;
  });
  MESSAGE(cases.size() << " of them");
  CHECK(cases.size() >= 5);
  std::vector<std::string> archives(cases.size());
  parallel_for(cases.size(), 0,
               [&](std::size_t k) { archives[k] = fmu_of(cases[k].block, k % 2 == 0 ? 2 : 3); });
  for (std::size_t k = 0; k < cases.size(); ++k) {
    CAPTURE(cases[k].name);
    const LoadedFmu fmu(archives[k]);
    CHECK(!fmu.exchanges());
    check_commands(fmu, cases[k].block({}));
  }
}
