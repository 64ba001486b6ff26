#include "dashpot/record/trial_parts.h"

#include "dashpot/split.h"
#include "support.h"

using namespace dashpot;

namespace {

Record record(const std::string& condition, std::optional<double> level,
              std::size_t samples = 110) {
  Record r;
  r.name = condition;
  r.condition = condition;
  r.drive_level = level;
  r.time.resize(samples);
  r.warm_up = 10;
  return r;
}

std::vector<std::size_t> records_of(const ScoredParts& parts) {
  std::vector<std::size_t> records;
  for (const ScoredPart& part : parts) records.push_back(part.record);
  return records;
}

}  // namespace

TEST_CASE("conditions are held back in turn, and so is each inner level") {
  const std::vector<Record> training = {record("a", 0), record("a", 1), record("a", 2),
                                        record("b", 0), record("b", 2)};
  const std::vector<TrialParts> trials = trial_parts(training);
  REQUIRE(trials.size() == 3);
  CHECK(records_of(trials[0].held_back) == std::vector<std::size_t>{0, 1, 2});
  CHECK(records_of(trials[0].training) == std::vector<std::size_t>{3, 4});
  CHECK(records_of(trials[1].held_back) == std::vector<std::size_t>{3, 4});
  CHECK(records_of(trials[2].held_back) == std::vector<std::size_t>{1});
  CHECK(trials[2].held_back[0].first == 10);
  CHECK(trials[2].held_back[0].last == 110);
}

TEST_CASE("six conditions make four trials") {
  std::vector<Record> training;
  for (const char* condition : {"a", "b", "c", "d", "e", "f"})
    training.push_back(record(condition, {}));
  const std::vector<TrialParts> trials = trial_parts(training);
  REQUIRE(trials.size() == 4);
  CHECK(records_of(trials[1].held_back) == std::vector<std::size_t>{1, 5});
}

TEST_CASE("records without conditions or levels are cut, and their ends held back") {
  const std::vector<TrialParts> trials = trial_parts({record("a", {}), record("a", {})});
  REQUIRE(trials.size() == 1);
  REQUIRE(trials[0].held_back.size() == 2);
  CHECK(trials[0].training[1].first == 10);
  CHECK(trials[0].training[1].last == 80);  // 30 % of the 100 that count
  CHECK(trials[0].held_back[1].first == 80);
  CHECK(trials[0].held_back[1].last == 110);
}
