#include "dashpot/report/text_table.h"

#include "support.h"

using namespace dashpot;

TEST_CASE("columns line up by characters, not bytes") {
  CHECK(text_table({{"Model"}, {"ESR %", true}}, {{"Dämpfer", "1.2"}, {"b", "10.0"}}, 80) ==
        "Model    ESR %\n"
        "--------------\n"
        "Dämpfer    1.2\n"
        "b         10.0\n");
}

TEST_CASE("a table that is too wide shortens names, then leaves out the least important column") {
  const std::vector<TextColumn> columns{
      {"Model", false, 0, true}, {"A", true, 0}, {"Bee", true, 2}, {"See", true, 1}};
  const std::vector<std::vector<std::string>> rows{{"abcdefghijklmnopqrstuvwxyz", "1", "2", "3"}};
  CHECK(text_table(columns, rows, 36) ==
        "Model                    A  Bee  See\n"
        "------------------------------------\n"
        "abcdefghijklmnopqrstu..  1    2    3\n");
  CHECK(text_table(columns, rows, 28) ==
        "Model                 A  See\n"
        "----------------------------\n"
        "abcdefghijklmnopqr..  1    3\n");
}

TEST_CASE("a long title stands on several lines before anything is shortened or left out") {
  const std::vector<TextColumn> columns{
      {"Measure", false, 0, true}, {"with a passive damper", true}, {"ratio", true, 1}};
  const std::vector<std::vector<std::string>> rows{{"greatest drift, floor 1", "5.486", "0.144"}};
  CHECK(text_table(columns, rows, 43) ==
        "                              with a\n"
        "                             passive\n"
        "Measure                       damper  ratio\n"
        "-------------------------------------------\n"
        "greatest drift, floor 1        5.486  0.144\n");
  CHECK(columns_without_room(columns, rows, 43).empty());
  CHECK(columns_without_room(columns, rows, 30) == std::vector<std::string>{"ratio"});
}

TEST_CASE("columns of one title, one beside each of several others, are left out together") {
  CHECK(text_table({{"day"}, {"force", true}, {"sum", true, 1}, {"gas", true}, {"sum", true, 1}},
                   {{"monday", "-0.01", "3.5", "12", "1.5"}}, 24) ==
        "day     force  gas\n"
        "------------------\n"
        "monday  -0.01   12\n");
}

TEST_CASE("names that begin alike keep their ends when they are shortened") {
  const std::vector<TextColumn> columns{{"Measure", false, 0, true}, {"A", true, 0}};
  CHECK(text_table(columns,
                   {{"dynamic over static tyre load, rms", "1"},
                    {"dynamic over static tyre load, greatest", "2"},
                    {"travel", "3"}},
                   25) ==
        "Measure                 A\n"
        "-------------------------\n"
        "dynamic ov.. load, rms  1\n"
        "dynamic ov.., greatest  2\n"
        "travel                  3\n");
}
