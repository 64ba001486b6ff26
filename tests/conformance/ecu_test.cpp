#include <map>
#include <sstream>

#include "dashpot/base/file.h"
#include "dashpot/damper/kinds/hysteresis_network/presets.h"
#include "dashpot/damper/kinds/passive_network/presets.h"
#include "dashpot/export/c/c_controller.h"
#include "dashpot/export/c/c_observer.h"
#include "dashpot/export/c/c_source.h"
#include "dashpot/export/c/c_text.h"
#include "dashpot/export/export_run.h"
#include "export/example_models.h"
#include "export/observer_example.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr std::size_t kEcuSteps = 60;
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
    for (const char* name :
         {"bouc_wen", "modified_bouc_wen", "narx", "state_space", "fuzzy", "mlp"})
      if (example.name == name) models.push_back(std::move(example));
  const HysteresisNetworkPreset& preset = hysteresis_network_presets().front();
  std::vector<HysteresisNetwork> members;
  for (std::size_t m = 0; m < preset.members; ++m) {
    HysteresisNetwork member;
    for (std::size_t k = 0; k < preset.path_states; ++k)
      member.bank.path_rates.push_back(20.0 * (k + 1));
    for (std::size_t k = 0; k < preset.velocity_lags; ++k)
      member.bank.velocity_rates.push_back(10.0 * (k + 1));
    for (std::size_t k = 0; k < preset.current_lags; ++k)
      member.bank.current_rates.push_back(30.0 * (k + 1));
    member.network.signals.resize(member.bank.signal_count());
    member.network.signals.front().scale = 0.2;
    member.network.currents = preset.current_lags;
    member.network.initialise(preset.hidden, m + 1);
    Random random(m + 100);
    for (double& weight : member.network.gates) weight = 0.2 * random.normal();
    member.network.output_scale = 1000;
    members.push_back(std::move(member));
  }
  models.push_back(
      {"bank", std::make_shared<HysteresisNetworkModel>("hysteresis_network", std::move(members))});
  PassiveNetwork passive = example_passive_network();
  passive.sizes = find_preset(passive_network_presets(), "passive_network_one_sensor").sizes;
  passive.displacement_scale = 0;
  initialise(passive, 1);
  models.push_back({"passive", std::make_shared<PassiveNetworkModel>("passive_network_one_sensor",
                                                                     std::vector{passive})});
  return models;
}

std::string table(const std::string& name, const std::vector<double>& values) {
  return "static const double " + name + "[] = " + c_numbers(values) + ";\n";
}

/// What the board's program reads.
struct Board {
  std::string includes, list, functions;

  /// `next`: the body of a function of a model and k that returns what is expected at k.
  void add(const std::string& prefix, const std::vector<double>& expected,
           const std::string& next) {
    includes += "#include \"" + prefix + ".h\"\n";
    list += " X(" + prefix + ")";
    functions += table(prefix + "_expected", expected) + "static __attribute__((noipa)) double " +
                 prefix + "_next(" + prefix + "_model* model, int k) {\n" + next + "}\n";
  }
};

/// From an accelerometer to a command; from a demand to a current by search on a model and by a
/// network.
std::vector<std::pair<std::string, VehicleWords>> ecu_controllers() {
  const VehicleWords search{.dampers = {"spencer1997"},
                            .controller = "skyhook_modified",
                            .inverse = "numeric",
                            .sensors = {.in_car = true}};
  return {{"mix1", {.controller = "mix1", .sensors = {.in_car = true}}},
          {"lqr",
           {.plant = "ikenaga2000", .dampers = {"ideal"}, .controller = "clipped_lqr,force=1e-8"}},
          {"search", search}};
}

/// A block along its own samples, told by the first of its commands.
void add_block(const TemporaryFolder& folder, Board& board, const std::string& prefix,
               CPrecision precision, const CBlock& block) {
  for (const ExportedFile& file : c_block_sources(block, prefix, ""))
    folder.write(file.name, file.content);

  // What goes in and what comes out, step by step.
  std::string numbers, next;
  std::vector<double> expected;
  for (std::size_t k = 0; k < kEcuSteps; ++k) {
    numbers += "  " + c_numbers(block.samples[k].inputs) + ",\n";
    expected.push_back(block.samples[k].commands[0]);
  }
  std::size_t place = 0;
  for (const CPort& port : block.inputs)
    for (std::size_t k = 0; k < port.count; ++k)
      next += "  input." + port.at(k) + " = row[" + std::to_string(place++) + "];\n";
  board.functions += "static const double " + prefix + "_rows[][" + std::to_string(place) +
                     "] = {\n" + numbers + "};\n";

  std::size_t commands = 0;
  for (const CPort& port : block.commands) commands += port.count;
  board.add(prefix, expected,
            filled(R"(  const double* row = @prefix@_rows[k];
  static @prefix@_input input;
  @real@ commands[@commands@];
  if (k == 0) @prefix@_init(model);
@next@  @prefix@_step(model, &input, commands);
  return commands[0];
)",
                   {{"prefix", CText::own(prefix)},
                    {"real", CText::own(precision == CPrecision::Single ? "float" : "double")},
                    {"commands", CText::own(std::to_string(commands))},
                    {"next", CText::own(next)}}));
}

void write_controllers(const TemporaryFolder& folder, Board& board) {
  for (const auto& [name, words] : ecu_controllers()) {
    const Vehicle vehicle = make_vehicle(words);
    for (const CPrecision precision : {CPrecision::Double, CPrecision::Single}) {
      const std::string prefix = name + (precision == CPrecision::Single ? "_float" : "_double");
      add_block(folder, board, prefix, precision,
                c_controller_block(vehicle, {.name = prefix, .precision = precision}));
    }
  }
}

/// Sources of all models in both precisions, and the header that the board's program reads.
void write_models(const TemporaryFolder& folder) {
  Board board;
  std::vector<DamperInput> run;
  for (const ExampleModel& example : ecu_models()) {
    const ExportedModel model = exported(*example.model);
    for (const CPrecision precision : {CPrecision::Double, CPrecision::Single}) {
      const std::string prefix =
          example.name + (precision == CPrecision::Single ? "_float" : "_double");
      const CSource source =
          c_source(model, {.name = prefix, .precision = precision, .sample_time = 1e-3});
      run = export_run(model.domain, source.sample_time, kEcuSteps);
      folder.write(prefix + ".h", source.header);
      folder.write(prefix + ".c", source.source);
      board.add(
          prefix, force_along(*example.model, run, source.sample_time),
          filled(R"(  const @prefix@_input input = {kInputs[k][0], kInputs[k][1], kInputs[k][2]};
  if (k > 0) return @prefix@_step(model, &input);
  @prefix@_reset(model, &input);
  return @prefix@_force(&input, model->state);
)",
                 {{"prefix", CText::own(prefix)}}));
    }
  }
  std::string inputs;
  for (const DamperInput& input : run)
    inputs +=
        "  " + c_numbers(std::vector{input.displacement, input.velocity, input.current}) + ",\n";
  write_controllers(folder, board);
  folder.write("models.h", board.includes + "\n#define STEPS " + std::to_string(kEcuSteps) +
                               "\n#define MODELS(X)" + board.list +
                               "\n\nstatic const double kInputs[STEPS][3] = {\n" + inputs + "};\n" +
                               board.functions);
}

/// Observers of a car in both precisions, with a damper without a memory and with one that has
/// three states, alone on the board.
struct ObservedOnBoard {
  const char *name, *damper;
  double shift;  ///< m/s, of the velocity by which the force goes
};
constexpr ObservedOnBoard kObservedDampers[] = {{"kwok2006", "kwok2006", 0},
                                                {"kwok2006_shifted", "kwok2006", 0.004},
                                                {"spencer1997", "spencer1997", 0}};

/// The same with a network, whose states are carried along, as large as `identify` makes them.
ExampleObserver network_observer() {
  std::vector<ExampleModel> models = ecu_models();
  const auto network = std::ranges::find(models, "bank", &ExampleModel::name);
  return example_observer_in(kExampleCar + "current: coil\n", network->model, usual_domain(0, 2));
}

void write_observers(const TemporaryFolder& folder) {
  Board board;
  const auto add = [&](const std::string& name, const ExampleObserver& example) {
    for (const CPrecision precision : {CPrecision::Double, CPrecision::Single}) {
      const std::string prefix = name + (precision == CPrecision::Single ? "_float" : "_double");
      add_block(folder, board, prefix, precision,
                c_observer_block(example.observer, example.names, "",
                                 {.name = prefix, .precision = precision}));
    }
  };
  for (const auto& [name, damper, shift] : kObservedDampers)
    add(name, example_observer(damper, shift));
  add("hysteresis_network", network_observer());
  folder.write("models.h", board.includes + "\n#define STEPS " + std::to_string(kEcuSteps) +
                               "\n#define MODELS(X)" + board.list + "\n\n" + board.functions);
}

ProgramResult run_on_board(const TemporaryFolder& folder) {
  for (const char* name : {"board.h", "board.c", "main.c", "ecu.ld"})
    folder.write(name, read_file(project_file(std::string("tests/conformance/ecu/") + name)));
  return run_program("cd '" + folder.path().string() +
                     "' && arm-none-eabi-gcc -std=gnu99 -O2 -mcpu=cortex-m4 -mthumb "
                     "-mfloat-abi=hard -mfpu=fpv4-sp-d16 "
                     "-ffunction-sections -Wl,--gc-sections -nostartfiles --specs=nosys.specs -T "
                     "ecu.ld *.c -lm -o ecu.elf "
                     "&& "
                     // A tick of SysTick is 1/168 us; an instruction takes 32 ns of qemu's time:
                     // what counts is the ratio.
                     "timeout 60 qemu-system-arm -M netduinoplus2 -nographic -monitor none -serial "
                     "null -icount shift=5 "
                     "-semihosting-config enable=on,target=native -kernel ecu.elf");
}

/// B that each NAME_next may take, by the project's own script; it reads the program that ran.
std::map<std::string, double> stack_bounds(const TemporaryFolder& folder,
                                           const std::string& output_of_run) {
  std::string command = "'" + project_file("scripts/stack_bound") + "' '" +
                        (folder.path() / "ecu.elf").string() + "'";
  std::istringstream lines(output_of_run);
  for (std::string line; std::getline(lines, line);)
    command += ' ' + line.substr(0, line.find(' ')) + "_next";
  const ProgramResult result = run_program(command);
  CAPTURE(result.output);
  REQUIRE(result.exit_code == 0);

  std::map<std::string, double> bounds;
  std::istringstream rows(result.output);
  std::string function;
  for (double bound = 0; rows >> function >> bound;) bounds[function] = bound;
  return bounds;
}

}  // namespace

TEST_CASE("exported C on a Cortex-M4F: the library's numbers, within 100 us a step" *
          doctest::test_suite("long")) {
  if (!are_there({"arm-none-eabi-gcc", "qemu-system-arm"})) return;
  const TemporaryFolder folder;
  write_models(folder);
  const ProgramResult result = run_on_board(folder);
  CAPTURE(result.output);
  REQUIRE(result.exit_code == 0);
  const std::map<std::string, double> bounds = stack_bounds(folder, result.output);
  std::istringstream lines(result.output);
  std::string name;
  double difference = 0, instructions = 0, stack = 0;
  std::size_t count = 0;
  for (; lines >> name >> difference >> instructions >> stack; ++count) {
    CAPTURE(name);
    const double bound = bounds.at(name + "_next");
    CHECK(stack <= bound);
    CHECK(bound <= 2 * stack + 400);  // by what may be, not by what was
    MESSAGE(name << ": " << instructions << " instructions, stack " << stack << " B, at most "
                 << bound);
    const bool single = name.ends_with("_float");
    CHECK(difference <= (single ? 1e7 : 1));  // in 1e-12 of the span
    CHECK(stack > 0);
    CHECK(stack < 2048);
    // An instruction takes a cycle or, loads and branches, a few; single precision divides in 14.
    if (name == "mlp_float" || name == "bank_float") CHECK(instructions < kClock * kTime);
  }
  CHECK(count == 2 * (ecu_models().size() + ecu_controllers().size()));
}

TEST_CASE("an exported observer on a Cortex-M4F: the library's force, and its instructions" *
          doctest::test_suite("long")) {
  constexpr double kObserverTime = 1e-3;  // s that a step may take
  if (!are_there({"arm-none-eabi-gcc", "qemu-system-arm"})) return;
  const TemporaryFolder folder;
  write_observers(folder);
  const ProgramResult result = run_on_board(folder);
  CAPTURE(result.output);
  REQUIRE(result.exit_code == 0);
  std::istringstream lines(result.output);
  std::string name;
  double difference = 0, instructions = 0, stack = 0;
  std::size_t count = 0;
  for (; lines >> name >> difference >> instructions >> stack; ++count) {
    CAPTURE(name);
    MESSAGE(name << ": " << instructions << " instructions a step, "
                 << (instructions < kClock * kObserverTime ? "inside" : "beyond")
                 << " 1 ms at 168 MHz; stack " << stack << " B");
    CHECK(stack > 0);
    CHECK(difference <= (name.ends_with("_double") ? 1e3 : 1e9));  // in 1e-12 of the span
    // In single precision, for which the board has arithmetic, all of them fit.
    if (name.ends_with("_float")) CHECK(instructions < kClock * kObserverTime);
  }
  CHECK(count == 2 * (std::size(kObservedDampers) + 1));
}
