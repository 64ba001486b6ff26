#include "wrong_input.h"

using namespace dashpot;

namespace {

std::string dataset_file(const std::string& entry) {
  return "files:\n  - match: '*.csv'\n    " + entry + '\n';
}

}  // namespace

TEST_CASE("dataset files that cannot be used" * doctest::test_suite("long")) {
  const auto with = [](const std::string& text) {
    return std::vector<std::pair<std::string, std::string>>{{"r_1A.csv", csv()},
                                                            {"dataset.yaml", text}};
  };
  const Wrong table[] = {
      {"an unknown key",
       with(dataset_file("chanels: {}")),
       "inspect DIR",
       1,
       {"dataset.yaml:3", "unknown key 'chanels'; did you mean 'channels'?"}},
      {"an unknown unit",
       with(dataset_file("channels: {force: {column: F_N, unit: Nm2}}")),
       "inspect DIR",
       1,
       {"dataset.yaml:3", "'Nm2'"}},
      {"a unit of another quantity",
       with(dataset_file("channels: {force: {column: F_N, unit: mm}}")),
       "inspect DIR",
       1,
       {"unit 'mm' does not fit force", "N"}},
      {"a column that counts something else by its name",
       with(dataset_file("channels: {displacement: {column: F_N}}")),
       "inspect DIR",
       1,
       {"dataset.yaml:3", "column 'F_N' counts N by its name, and displacement is in m",
        "'force: {column: "}},
      {"a column that is not there",
       with(dataset_file("channels: {force: {column: Load}}")),
       "inspect DIR",
       1,
       {"r_1A.csv: has no column 'Load'", "dataset.yaml:3"}},
      {"text for a number",
       with(dataset_file("channels: {force: {column: F_N, scale: much}}")),
       "inspect DIR",
       1,
       {"dataset.yaml:3: 'scale' is text, not a number"}},
      {"nothing", with(""), "inspect DIR", 1, {"dataset.yaml", "mapping"}},
      {"binary", with("\x80\x81\x82"), "inspect DIR", 1, {"dataset.yaml"}},
  };
  for (const Wrong& wrong : table) check(wrong);
}
