#include "c_compile.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/dataset.h"
#include "dashpot/export/tables/force_map.h"
#include "dashpot/record/record_file.h"
#include "export/example_models.h"
#include "support.h"

using namespace dashpot;

namespace {

ProgramResult octave(const TemporaryFolder& folder, const std::string& script) {
  folder.write("check.m", script);
  return run_program("cd '" + folder.path().string() + "' && octave-cli --norc --quiet check.m");
}

}  // namespace

TEST_CASE("Octave reads the tables and recordings that Dashpot writes as MAT") {
  if (!is_there("octave-cli")) return;
  const TemporaryFolder folder;
  const LawModel model = example_law(find_law("bingham"));
  for (const ExportedFile& file : write_tables(exported(model), {.name = "map"}))
    write_file(folder.path() / file.name, file.content);
  const auto csv =
      folder.write("run.csv",
                   "t[s],displacement[m],velocity[m/s],current[A],force[N]\n0,-0.1,1,0.5,3\n"
                   "0.1,0,2,0.5,5\n0.2,0.2,1,0.5,2.25\n");
  save_mat(load_dataset({csv}).records.front(), folder.path() / "run.mat");
  const ProgramResult result = octave(folder, R"(map = load('map.mat');
table = csvread('map_force.csv');
assert(map.force, table(2:end, 2:end));
assert(map.velocity, table(2:end, 1));
assert(map.current', table(1, 2:end));
inverse = csvread('map_current.csv');
assert(map.inverse_current, inverse(2:end, 2:end));
run = load('run.mat');
assert(run.force(:), [3; 5; 2.25]);
assert(run.displacement(:), [-0.1; 0; 0.2]);
)");
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
}

TEST_CASE("Dashpot reads the recordings that Octave saves, -v6 and -v7") {
  if (!is_there("octave-cli")) return;
  const TemporaryFolder folder;
  const ProgramResult result = octave(folder, R"(t = (0:0.001:1)';
displacement = 0.01 * sin(10 * t);
velocity = 0.1 * cos(10 * t);
current = 0.5 + 0 * t;
force = 1000 * velocity + 20 * current;
save('-v6', 'six.mat', 't', 'displacement', 'velocity', 'current', 'force');
save('-v7', 'seven.mat', 't', 'displacement', 'velocity', 'current', 'force');
)");
  CAPTURE(result.output);
  REQUIRE(result.exit_code == 0);
  for (const char* name : {"six.mat", "seven.mat"}) {
    const Record record = load_dataset({folder.path() / name}).records.front();
    const std::vector<double>& force = record.channel("force").samples;
    REQUIRE(force.size() == 1001);
    for (const std::size_t k : {0, 500, 1000}) {
      const double t = 1e-3 * static_cast<double>(k);
      CHECK_CLOSE(force[k], 100 * std::cos(10 * t) + 10, 1e-15, 1e-12);
      CHECK_CLOSE(record.channel("displacement").samples[k], 0.01 * std::sin(10 * t), 1e-15, 1e-17);
    }
  }
}
