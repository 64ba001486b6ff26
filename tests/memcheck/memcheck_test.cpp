// What is exported, under valgrind. DASHPOT_RUN_WITH=... of c_compile.h does the same to any other
// test of exported C.
#include <filesystem>

#include "conformance/c_compile.h"
#include "conformance/control_cases.h"
#include "dashpot/export/c/c_source.h"
#include "export/example_models.h"
#include "support.h"

using namespace dashpot;

namespace {

const std::string kMemcheck = "valgrind --quiet --error-exitcode=9 --leak-check=full";
// allocation_test.cpp replaces some operators of the test program, which valgrind takes for a
// mismatch.
const std::string kOfTests =
    kMemcheck + " --show-mismatched-frees=no --child-silent-after-fork=yes";

void write(const TemporaryFolder& folder, const std::vector<ExportedFile>& files) {
  for (const ExportedFile& file : files) folder.write(file.name, file.content);
}

}  // namespace

TEST_CASE(
    "valgrind finds nothing in exported C: a model of each kind, an inverse and a controller") {
  if (!is_there("cc") || !is_there("valgrind")) return;
  const TemporaryFolder folder;
  for (const ExampleModel& example : example_models())
    for (const char* name :
         {"bouc_wen", "narx", "hysteresis_network", "state_space", "passive_network", "hybrid"})
      if (example.name == name)
        write(folder, write_c_source(exported(*example.model), {.name = example.name + "_x"}));
  int blocks = 0;
  for (const std::vector<BlockCase>& cases : {controller_cases(), inverse_cases()})
    for (const BlockCase& one : cases)
      if (one.name == "spencer_numeric" || one.name == "bouc_wen_numeric_lag") {
        write(folder, write_c_block(one.block({}), ""));
        ++blocks;
      }
  CHECK(blocks == 2);
  check_that_it_runs(folder, "-O1 -g", kMemcheck);
}

TEST_CASE(
    "valgrind finds nothing where the test importer takes FMUs of FMI 2 and 3 through their "
    "lives") {
  if (!is_there("cc") || !is_there("valgrind")) return;
  const ProgramResult result =
      run_program(kOfTests + " '" + std::filesystem::read_symlink("/proc/self/exe").string() +
                  "' --source-file=*fmu_use_test.cpp");
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
  CHECK(result.output.find("Status: SUCCESS") != std::string::npos);
}

TEST_CASE("valgrind's findings reach the test") {
  if (!is_there("cc") || !is_there("valgrind")) return;
  const TemporaryFolder folder;
  folder.write("x.c", "void x(void);\nvoid x(void) {}\n");
  folder.write("x_test.c",
               "#include <stdlib.h>\nint main(void) { char* a = malloc(1); return a[1] == 7; }\n");
  const ProgramResult result = compile_and_run(folder, "", kMemcheck);
  CHECK(result.exit_code != 0);
  CHECK(result.output.find("Invalid read") != std::string::npos);
}
