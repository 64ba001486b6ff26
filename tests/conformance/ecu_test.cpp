#include <sstream>

#include "dashpot/base/file.h"
#include "dashpot/output/exporters/c_source.h"
#include "dashpot/output/exporters/export_run.h"
#include "output/exporters/example_models.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr std::size_t kSteps = 60;
constexpr double kClock = 168e6, kTime = 100e-6;  // Hz of a common ECU; s that a step may take

bool are_there(const std::vector<std::string>& programs) {
  for (const std::string& program : programs)
    if (run_program(program + " --version").exit_code != 0) {
      MESSAGE("SKIPPED: no " << program << " is here");
      return false;
    }
  return true;
}

/// The presets whose time is promised, and other kinds.
std::vector<ExampleModel> ecu_models() {
  std::vector<ExampleModel> models;
  for (ExampleModel& example : example_models())
    for (const char* name : {"bouc_wen", "modified_bouc_wen", "narx", "state_space", "fuzzy", "mlp"})
      if (example.name == name) models.push_back(std::move(example));
  const StateNetworkPreset& preset = find_state_network_preset("hysteresis_network");
  std::vector<BankNetwork> members;
  for (std::size_t m = 0; m < preset.members; ++m) {
    BankNetwork member;
    for (std::size_t k = 0; k < preset.path_states; ++k) member.bank.path_rates.push_back(20.0 * (k + 1));
    for (std::size_t k = 0; k < preset.velocity_lags; ++k)
      member.bank.velocity_rates.push_back(10.0 * (k + 1));
    for (std::size_t k = 0; k < preset.current_lags; ++k) member.bank.current_rates.push_back(30.0 * (k + 1));
    member.network.signals.resize(member.bank.signal_count());
    member.network.signals.front().scale = 0.2;
    member.network.currents = preset.current_lags;
    member.network.initialise(preset.hidden, m + 1);
    Random random(m + 100);
    for (double& weight : member.network.gates) weight = 0.2 * random.normal();
    member.network.output_scale = 1000;
    members.push_back(std::move(member));
  }
  models.push_back({"bank", std::make_shared<HysteresisNetwork>("hysteresis_network", std::move(members))});
  return models;
}

std::string table(const std::string& name, const std::vector<double>& values) {
  return "static const double " + name + "[] = " + c_numbers(values) + ";\n";
}

/// Sources of all models in both precisions, and the header that the board's program reads.
void write_models(const TemporaryFolder& folder) {
  std::string includes, list, tables;
  std::vector<DamperInput> run;
  for (const ExampleModel& example : ecu_models()) {
    const ExportedModel model = exported(*example.model);
    for (const CPrecision precision : {CPrecision::Double, CPrecision::Single}) {
      const std::string prefix = example.name + (precision == CPrecision::Single ? "_float" : "_double");
      const CSource source = c_source(model, {.name = prefix, .precision = precision, .sample_time = 1e-3});
      run = export_run(model.domain, source.sample_time, kSteps);
      folder.write(prefix + ".h", source.header);
      folder.write(prefix + ".c", source.source);
      includes += "#include \"" + prefix + ".h\"\n";
      list += " X(" + prefix + ")";
      tables += table(prefix + "_expected", force_along(*example.model, run, source.sample_time));
    }
  }
  std::string inputs;
  for (const DamperInput& input : run)
    inputs += "  " + c_numbers(std::vector{input.displacement, input.velocity, input.current}) + ",\n";
  folder.write("models.h", includes + "\n#define STEPS " + std::to_string(kSteps) + "\n#define MODELS(X)" +
                               list + "\n\nstatic const double kInputs[STEPS][3] = {\n" + inputs + "};\n" +
                               tables);
}

ProgramResult run_on_board(const TemporaryFolder& folder) {
  for (const char* name : {"board.h", "board.c", "main.c", "ecu.ld"})
    folder.write(name, read_file(project_file(std::string("tests/conformance/ecu/") + name)));
  return run_program(
      "cd '" + folder.path().string() +
      "' && arm-none-eabi-gcc -std=gnu99 -O2 -mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16 "
      "-ffunction-sections -Wl,--gc-sections -nostartfiles --specs=nosys.specs -T ecu.ld *.c -lm -o ecu.elf "
      "&& "
      // A tick of SysTick is 1/168 us; an instruction takes 32 ns of qemu's time: what counts is the ratio.
      "timeout 60 qemu-system-arm -M netduinoplus2 -nographic -monitor none -serial null -icount shift=5 "
      "-semihosting-config enable=on,target=native -kernel ecu.elf");
}

}  // namespace

TEST_CASE("exported C on a Cortex-M4F: the library's numbers, within 100 us a step") {
  if (!are_there({"arm-none-eabi-gcc", "qemu-system-arm"})) return;
  const TemporaryFolder folder;
  write_models(folder);
  const ProgramResult result = run_on_board(folder);
  CAPTURE(result.output);
  REQUIRE(result.exit_code == 0);
  std::istringstream lines(result.output);
  std::string name;
  double difference = 0, instructions = 0, stack = 0;
  std::size_t count = 0;
  for (; lines >> name >> difference >> instructions >> stack; ++count) {
    CAPTURE(name);
    const bool single = name.ends_with("_float");
    CHECK(difference <= (single ? 1e7 : 1));  // in 1e-12 of the span
    CHECK(stack > 0);
    CHECK(stack < 2048);
    // An instruction takes a cycle or, loads and branches, a few; single precision divides in 14.
    if (name == "mlp_float" || name == "bank_float") CHECK(instructions < kClock * kTime);
  }
  CHECK(count == 2 * ecu_models().size());
}
