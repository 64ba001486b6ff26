#include <algorithm>
#include <filesystem>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/value.h"
#include "program.h"

using namespace dashpot;
namespace fs = std::filesystem;

namespace {

std::string rank_of(const std::string& models, const fs::path& folder) {
  return "rank " + small_campaign().string() + " --models " + models + " --output " +
         folder.string();
}

}  // namespace

TEST_CASE(
    "rank: a table, a breakdown, a report, a CSV file; a second call goes on from kept fits") {
  const TemporaryFolder folder;
  const ProgramResult first = stdout_of_dashpot(rank_of("bingham,tanh_kwok", folder.path()));
  REQUIRE(first.exit_code == 0);
  for (const char* part : {"tanh_kwok", "Bounded", "pre-yield N", "1 V", "CPU time"})
    CHECK_MESSAGE(contains(first.output, part), part);
  CHECK(!contains(first.output, "kept from before"));
  for (const char* file : {"report.html", "report.json", "report.md", "report.csv",
                           "leaderboard.csv", "models/tanh_kwok.json"})
    CHECK_MESSAGE(fs::exists(folder.path() / file), file);
  const Value report = parse_json(read_file(folder.path() / "report.json"), "report.json");
  const Value& best = report.find("models")->items().front();
  CHECK(best.find("stress")->find("bounded")->as_bool());
  CHECK(best.find("left_out")->find("drive")->items().size() == 3);

  const std::string records = read_file(folder.path() / "report.csv");
  const ProgramResult again = stdout_of_dashpot(rank_of("bingham,tanh_kwok", folder.path()));
  CHECK(contains(again.output, "8 fits kept from before"));  // three folds and a final fit each
  CHECK(read_file(folder.path() / "report.csv") == records);
  const ProgramResult other = stdout_of_dashpot(rank_of("bingham --starts 2", folder.path()));
  CHECK(!contains(other.output, "kept from before"));
}

TEST_CASE("rank: fits that an older version kept stay as they are, and are made again beside them" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const fs::path older = folder.write("fits/bingham-d818ac6dd7c05e7b.json",
                                      "{\"format\": \"dashpot fit 1\", \"key\": \"0.1.0\"}");
  const std::string command = rank_of("bingham", folder.path()), before = read_file(older);
  const ProgramResult first = run_dashpot(command);
  CHECK(first.exit_code == 0);
  CHECK(contains(first.output, (folder.path() / "fits").string() +
                                   " holds fits of an older version of Dashpot; they stay as they "
                                   "are and are not used. New fits are kept in " +
                                   (folder.path() / "fits.sqlite").string()));
  CHECK(!contains(first.output, "kept from before"));
  const ProgramResult again = run_dashpot(command);
  CHECK(contains(again.output, "4 fits kept from before"));
  CHECK(!contains(again.output, "older version"));
  CHECK(read_file(older) == before);
}

TEST_CASE("rank: what is no file of fits is refused before anything is fitted") {
  const TemporaryFolder folder;
  const fs::path file = folder.write("fits.sqlite", std::string(2000, 'x'));
  const ProgramResult result = run_dashpot(rank_of("bingham", folder.path()));
  CHECK(result.exit_code == 1);
  CHECK(contains(result.output,
                 file.string() + ": is no file of fit results; give another --output"));
  CHECK(read_file(file) == std::string(2000, 'x'));
  CHECK(run_dashpot(rank_of("bingham --fresh", folder.path())).exit_code == 0);
}

TEST_CASE(
    "rank: an interruption ends it soon, with 130 and no report, and what is finished stays") {
  const TemporaryFolder folder;
  REQUIRE(run_dashpot(rank_of("bingham --leave-out fraction=0.3 --starts 1", folder.path()))
              .exit_code == 0);
  fs::remove(folder.path() / "report.html");
  const ProgramResult stopped = run_program(
      "timeout --preserve-status -s INT 1 " + program_path() + " " +
      rank_of("bingham,modified_bouc_wen --leave-out fraction=0.3 --starts 100000", folder.path()));
  CHECK(stopped.exit_code == 130);
  CHECK(contains(stopped.output, "interrupted"));
  CHECK(!fs::exists(folder.path() / "report.html"));
  const ProgramResult again =
      run_dashpot(rank_of("bingham,tanh_kwok --leave-out fraction=0.3 --starts 1", folder.path()));
  CHECK(contains(again.output, "1 fit kept from before"));
}

TEST_CASE(
    "rank --markdown prints a part of a page and nothing else on stdout; --json one document" *
    doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const ProgramResult page = stdout_of_dashpot(rank_of("bingham --markdown", folder.path()));
  CHECK(page.exit_code == 0);
  CHECK(page.output.starts_with("## virtual bench, "));
  CHECK(contains(page.output, "| bingham |"));
  CHECK(!contains(page.output, folder.path().string()));
  const ProgramResult json = stdout_of_dashpot(rank_of("bingham --json", folder.path()));
  CHECK(parse_json(json.output, "rank --json").find("models")->items().size() == 1);
}

TEST_CASE("identify fits the usual models unless it is told otherwise; rank fits all" *
          doctest::test_suite("long")) {
  const std::string help = run_dashpot("identify --help").output;
  CHECK(contains(help, "(default: usual)"));
  CHECK(contains(run_dashpot("rank --help").output, "(default: all)"));
  const TemporaryFolder folder;
  const std::string data = (folder.path() / "data").string();
  REQUIRE(run_dashpot(
              "bench --motions 15x1,5x3 --levels 0,1 --cycles 1 --sample-rate 100 --output " + data)
              .exit_code == 0);
  const ProgramResult result =
      run_dashpot("identify " + data +
                  " --models bingham,usual --network members=1,epochs=3 --starts 1 --allow-active "
                  "--leave-out fraction=0.3 --no-report --output " +
                  folder.path().string());
  CHECK(result.exit_code == 0);
  for (const char* model : {"bingham", "tanh_kwok", "modified_bouc_wen", "large_scale_bouc_wen",
                            "passive_network", "hysteresis_network"})
    CHECK_MESSAGE(fs::exists(folder.path() / "models" / (std::string(model) + ".json")), model);
}

TEST_CASE("rank --plant: a second order, by the ride, on the screen, in JSON and in CSV" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const ProgramResult result =
      stdout_of_dashpot(rank_of("bingham,viscous_dahl", folder.path()) +
                        " --plant savaresi_spelta --controller skyhook --duration 2 --draws 2");
  REQUIRE(result.exit_code == 0);
  for (const char* part : {"Ranking by the ride", "Ride error %", "stands for the damper"})
    CHECK_MESSAGE(contains(result.output, part), part);
  const Value report = parse_json(read_file(folder.path() / "report.json"), "report.json");
  CHECK(report.find("ride")->find("controller")->as_string() == "skyhook");
  CHECK(report.find("ride")->find("order")->items().size() == 2);
  const Value& error =
      *report.find("models")->items().front().find("ride")->find("ride_error_percent");
  CHECK(error.find("low")->as_number() <= error.find("high")->as_number());
  const std::string csv = read_file(folder.path() / "leaderboard.csv");
  const std::vector<std::string> lines = split(csv, '\n');
  CHECK(contains(lines[0], ",ride_error_percent,ride_error_percent_low,"));
  CHECK(split(lines[0], ',').size() == split(lines[1], ',').size());

  // The screen has the units that are asked for, of the ride as well.
  const ProgramResult inches = stdout_of_dashpot(
      rank_of("bingham,viscous_dahl", folder.path()) +
      " --plant savaresi_spelta --controller skyhook --duration 2 --draws 2" + " --units lbf,in/s");
  CHECK(contains(result.output, "a_w m/s^2"));
  CHECK(contains(inches.output, "a_w in/s^2"));
  CHECK(contains(read_file(folder.path() / "report.md"), "Travel in |"));
}

TEST_CASE("rank --plant: what cannot be ridden is refused before the first fit" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& options, int code, const std::string& message) {
    const ProgramResult result = run_dashpot(rank_of("bingham", folder.path()) + " " + options);
    CAPTURE(result.output);
    CHECK(result.exit_code == code);
    CHECK(contains(result.output, message));
    CHECK(!contains(result.output, "fitted bingham"));
  };
  for (const char* ride : {"--road iso8608", "--controller skyhook", "--draws 5", "--current 1",
                           "--duration 5", "--in-car", "--set sprung_mass=300kg"})
    refused(ride, 2, "there is no vehicle to ride in; name one with --plant");
  refused("--plant dyke_spencer1996", 1, "has no tyres, so that it does not ride");
  refused("--plant savaresi", 1, "did you mean 'savaresi_spelta'?");
  refused("--plant savaresi_spelta --controller skyhok", 1, "skyhook");
  refused("--plant savaresi_spelta --road iso8608,class=Z", 1, "class");
  refused("--plant savaresi_spelta --in-car", 2, "--in-car: serves a controller");
}

TEST_CASE("rank: its progress as JSON has each model when it ends, and parameters as they move" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_dashpot(rank_of("bingham,tanh_kwok", folder.path()) + " --fresh --progress json");
  REQUIRE(result.exit_code == 0);
  const std::string leaderboard = read_file(folder.path() / "leaderboard.csv");
  std::vector<std::string> judged;
  std::size_t moved = 0;
  for (const std::string& line : split(result.output, '\n')) {
    if (!line.starts_with('{')) continue;
    const Value said = parse_json(line, "progress");
    if (const Value* row = said.find("judged")) {
      judged.push_back(row->find("model")->as_string());
      // What is told of a model is what the leaderboard says of it in the end.
      CHECK(contains(leaderboard, judged.back() + ",yes," +
                                      format_exact(row->find("esr_percent")->as_number())));
    }
    if (const Value* parameters = said.find("parameters")) {
      ++moved;
      CHECK(!parameters->items().empty());
    }
  }
  std::ranges::sort(judged);
  CHECK(judged == std::vector<std::string>{"bingham", "tanh_kwok"});
  CHECK(moved > 0);
}
