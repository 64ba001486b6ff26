#include "dashpot/base/file.h"
#include "wrong_input.h"

using namespace dashpot;

namespace {

const std::string kRank = "rank DIR --models bingham --quiet --output DIR/results";
const std::string kFit = "identify DIR --models bingham --quiet --output DIR/results";

}  // namespace

TEST_CASE("recordings that no model can be fitted to" * doctest::test_suite("long")) {
  const Wrong table[] = {
      {"no current beside one",
       {{"a_1Hz.csv", csv(drop_current, 300, "t_s,x_mm,F_N\n")}, {"b_2Hz.csv", csv()}},
       kFit,
       1,
       {"a_1Hz: has no known current; 1 of 2 records has one", "manifest.csv", "'drive: none'"}},
      {"no displacement, and none to be had",
       {{"a.csv", csv(
                      [](int k, auto& row) {
                        if (k > 99) row[0] = format_number(k * 0.005 + 0.015, 9);
                      },
                      300, "t_s,v_mm_s,F_N,i_A\n")}},
       "identify DIR --models tanh_kwok --quiet --leave-out blocks=2 --output DIR/results",
       1,
       {"a: has no displacement, which tanh_kwok needs", "as bingham"}},
      {"constant force",
       {{"a_1Hz.csv", csv(scaled(2, 0))}, {"b_2Hz.csv", csv(scaled(2, 0))}},
       kFit,
       1,
       {"the force is constant"}},
      {"no motion",
       {{"a_1Hz.csv", csv(scaled(1, 0))}, {"b_2Hz.csv", csv(scaled(1, 0))}},
       kFit,
       1,
       {"nothing moves in any of them"}},
      {"one record",
       {{"a_1Hz.csv", csv()}},
       kFit + " --leave-out condition",
       1,
       {"cannot be divided", "fraction=0.3"}},
      {"rank: constant force",
       {{"a_1Hz.csv", csv(scaled(2, 0))}, {"b_2Hz.csv", csv(scaled(2, 0))}},
       kRank,
       1,
       {"the force is constant"}},
      {"rank: one record",
       {{"a_1Hz.csv", csv()}},
       kRank + " --leave-out condition",
       1,
       {"cannot be divided", "fraction=0.3"}},
      {"rank: no files", {}, "rank DIR", 1, {"the folder holds no files"}},
      {"rank: a folder that cannot be made",
       {{"a_1Hz.csv", csv()}, {"b_2Hz.csv", csv()}, {"results", "old"}},
       kRank,
       1,
       {"results/models: cannot make this folder"}},
  };
  for (const Wrong& wrong : table) check(wrong);
}

TEST_CASE("options that no model to be fitted takes" * doctest::test_suite("long")) {
  const auto fit = [](const std::string& option, const std::string& said) {
    return Wrong{option, {{"a_1Hz.csv", csv()}, {"b_2Hz.csv", csv()}}, kFit + option, 2, {said}};
  };
  const Wrong table[] = {
      fit(" --models bingam", "unknown model 'bingam'; did you mean 'bingham'?"),
      fit(" --fix c1=3", "--fix: no model to be fitted has a parameter 'c1'; did you mean"),
      fit(" --prior c0=3mm+-1mm", "--prior, c0: 'mm' is not a unit of it; it is counted in N*s/m"),
      fit(" --bounds c0=-5:5", "c0: its bounds -5 ... 5 N*s/m reach beyond the law's"),
  };
  for (const Wrong& wrong : table) check(wrong);
}

TEST_CASE("a results folder that cannot be written is refused before the fit") {
  const TemporaryFolder folder;
  const std::string file = folder.write("results", "old").string();
  const ProgramResult result =
      run_dashpot("identify " + small_campaign().string() + " --models bingham --output " + file);
  CHECK(result.exit_code == 1);
  CHECK(contains(result.output, "results/models: cannot make this folder"));
  CHECK(!contains(result.output, "fitting"));
  CHECK(read_file(file) == "old");
}

TEST_CASE("a budget that is no time is refused before anything is read" *
          doctest::test_suite("long")) {
  const auto fit = [](const std::string& budget, const std::string& said) {
    return Wrong{budget,
                 {{"a_1Hz.csv", csv()}, {"b_2Hz.csv", csv()}},
                 "identify DIR --quiet --output DIR/results --budget " + budget,
                 2,
                 {"--budget", said}};
  };
  for (const Wrong& wrong : {fit("-1", "-1"), fit("soon", "soon"), fit("nan", "nan")}) check(wrong);
}
