#include "dashpot/base/file.h"
#include "wrong_input.h"

using namespace dashpot;

TEST_CASE("model files that cannot be used" * doctest::test_suite("long")) {
  const TemporaryFolder fitted;
  const std::string folder = fitted.path().string();
  REQUIRE(run_dashpot("identify " + small_campaign().string() +
                      " --quiet --models bingham --no-report --output " + folder)
              .exit_code == 0);
  const std::string good = read_file(fitted.path() / "models/bingham.json");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return std::vector<std::pair<std::string, std::string>>{
        {"m.json", text.replace(at, from.size(), to)}};
  };
  const std::string run = "evaluate DIR/m.json " + small_campaign().string();
  const Wrong table[] = {
      {"an unknown key",
       with("\"version\"", "\"colour\": 1, \"version\""),
       run,
       1,
       {"m.json", "unknown key 'colour'"}},
      {"another version",
       with("\"version\": 1", "\"version\": 2"),
       run,
       1,
       {"version 2 is not known here", "reads version 1"}},
      {"an unknown law",
       with("\"law\": \"bingham\"", "\"law\": \"bing\""),
       run,
       1,
       {"m.json", "'bing'", "bingham"}},
      {"a negative mass",
       with("\"sample_time\": ", "\"moving_mass_kg\": -1, \"sample_time\": "),
       run,
       1,
       {"m.json, moving_mass_kg: is negative"}},
      {"a negative sample time",
       with("\"sample_time\": ", "\"sample_time\": -"),
       run,
       1,
       {"m.json, sample_time: is negative"}},
      {"cut off",
       {{"m.json", good.substr(0, good.size() / 2)}},
       run,
       1,
       {"m.json:", "not valid JSON"}},
      {"empty", {{"m.json", ""}}, run, 1, {"m.json:1: is not valid JSON"}},
      {"deep", {{"m.json", std::string(100000, '[')}}, run, 1, {"m.json: is nested more than"}},
      {"a folder", {}, "evaluate DIR DIR", 1, {"is a folder, not a file; one of the model files"}},
  };
  for (const Wrong& wrong : table) check(wrong);
}
