#include "dashpot/split.h"

#include <algorithm>

#include "dashpot/record/trial_parts.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Two motions at 0, 0.5 and 1 A, 10 samples each.
Dataset small_dataset() {
  Dataset dataset;
  dataset.name = "small";
  for (const char* condition : {"slow", "fast"})
    for (const double level : {0.0, 0.5, 1.0}) {
      Record record;
      record.name = std::string(condition) + " " + std::to_string(level);
      record.condition = condition;
      record.drive_level = level;
      for (int k = 0; k < 10; ++k) record.time.push_back(k);
      record.channels = {{"force", "N", record.time, ""}};
      dataset.records.push_back(record);
    }
  return dataset;
}

}  // namespace

TEST_CASE("each condition, inner current and record is left out once") {
  const Dataset dataset = small_dataset();
  const auto conditions = split(dataset, parse_leave_out("condition"));
  REQUIRE(conditions.size() == 2);
  CHECK(conditions[1].name == "without fast");
  CHECK(conditions[1].training.size() == 3);
  CHECK(conditions[1].left_out.front().condition == "fast");
  const auto currents = split(dataset, parse_leave_out("current"));
  REQUIRE(currents.size() == 1);
  CHECK(currents[0].left_out.size() == 2);
  CHECK(*currents[0].left_out[0].drive_level == 0.5);
  CHECK(split(dataset, parse_leave_out("current=0,1")).size() == 2);
  CHECK(split(dataset, parse_leave_out("record")).size() == 6);
}

TEST_CASE("a left-out fraction runs from the start and is scored at the end") {
  const auto folds = split(small_dataset(), parse_leave_out("fraction=0.3"));
  REQUIRE(folds.size() == 1);
  CHECK(folds[0].training[0].size() == 7);
  CHECK(folds[0].left_out[0].size() == 10);
  CHECK(folds[0].left_out[0].warm_up == 7);
}

TEST_CASE("blocks of a record's time are left out in turn, and no sample is in both parts") {
  Dataset dataset;
  dataset.name = "one";
  Record& record = dataset.records.emplace_back();
  record.name = "run";
  record.condition = "noise";
  record.warm_up = 3;
  for (int k = 0; k < 203; ++k) record.time.push_back(k);
  record.channels = {{"force", "N", record.time, ""}};
  CHECK(format_leave_out(default_leave_out(dataset)) == "blocks=5");

  // Each of the 200 scored samples is judged once, after a run from the record's start.
  const auto folds = split(dataset, default_leave_out(dataset));
  REQUIRE(folds.size() == 5);
  std::vector<int> judged(203);
  for (const Fold& fold : folds) {
    REQUIRE(fold.left_out.size() == 1);
    const Record& left_out = fold.left_out.front();
    CHECK(left_out.time.front() == 0);
    CHECK(left_out.name == "run");
    const double from = left_out.time[left_out.warm_up], to = left_out.time.back();
    for (std::size_t k = left_out.warm_up; k < left_out.size(); ++k)
      ++judged[static_cast<std::size_t>(left_out.time[k])];
    for (const Record& training : fold.training)
      CHECK((training.time.back() < from || training.time.front() > to));
  }
  CHECK(std::count(judged.begin(), judged.end(), 1) == 200);
  CHECK(std::count(judged.begin(), judged.begin() + 3, 0) == 3);

  // What follows a block begins in the middle of a motion: a twentieth of the record is its run-in.
  CHECK(folds[1].name == "without block 2 of 5");
  REQUIRE(folds[1].training.size() == 2);
  CHECK(folds[1].training[0].size() == 43);
  CHECK(folds[1].training[0].warm_up == 3);
  CHECK(folds[1].training[1].time.front() == 83);
  CHECK(folds[1].training[1].warm_up == 10);
  CHECK(folds[0].training.size() == 1);
  CHECK(folds[4].training.size() == 1);

  // Too short for five blocks: the message says how many there may be.
  dataset.records[0].keep(0, 73);
  const std::string message = message_of([&] { split(dataset, parse_leave_out("blocks")); });
  CHECK(message.find("run has 70 samples to score, and 5 blocks need 100") != std::string::npos);
  CHECK(message.find("'blocks=3'") != std::string::npos);
  CHECK(split(dataset, parse_leave_out("blocks=3")).size() == 3);
  dataset.records[0].keep(0, 30);
  CHECK(message_of([&] { split(dataset, parse_leave_out("blocks")); }).find("'blocks=") ==
        std::string::npos);
}

TEST_CASE("roles") {
  Dataset dataset = small_dataset();
  CHECK(message_of([&] { split(dataset, parse_leave_out("roles")); }).find("gives no roles") !=
        std::string::npos);
  dataset.records[0].role = Role::Training;
  dataset.records[1].role = Role::LeftOut;
  const auto folds = split(dataset, parse_leave_out("roles"));
  CHECK(folds[0].training.size() == 1);
  CHECK(folds[0].left_out.size() == 1);
}

TEST_CASE("by default, the strictest way that the records allow") {
  Dataset dataset = small_dataset();
  CHECK(default_leave_out(dataset).by == LeaveOut::By::Condition);
  dataset.records.erase(dataset.records.begin() + 3, dataset.records.end());
  CHECK(default_leave_out(dataset).by == LeaveOut::By::Current);
  dataset.records.pop_back();
  CHECK(default_leave_out(dataset).by == LeaveOut::By::Record);
  dataset.records.pop_back();
  CHECK(default_leave_out(dataset).by == LeaveOut::By::Blocks);
  dataset.leave_out = parse_leave_out("record");
  CHECK(default_leave_out(dataset).by == LeaveOut::By::Record);
}

TEST_CASE("many conditions, or records of one, are dealt to groups") {
  Dataset dataset = small_dataset();
  CHECK(message_of([&] {
          split(dataset, parse_leave_out("groups"));
        }).find("it has 2 conditions, fewer than 6 groups") != std::string::npos);

  // Six records of six motions: few enough for a fit without each.
  for (std::size_t r = 0; r < 6; ++r) dataset.records[r].condition = std::to_string(r);
  CHECK(default_leave_out(dataset).by == LeaveOut::By::Condition);

  // A seventh and eighth motion: the first two groups hold two motions each, and all of their
  // records.
  for (const char* motion : {"6", "6", "7"}) {
    dataset.records.push_back(dataset.records.front());
    dataset.records.back().condition = motion;
  }
  const LeaveOut dealt = default_leave_out(dataset);
  CHECK(format_leave_out(dealt) == "groups=6");
  const auto folds = split(dataset, dealt);
  REQUIRE(folds.size() == 6);
  CHECK(folds[0].name == "without group 1 of 6");
  REQUIRE(folds[0].left_out.size() == 3);
  CHECK(folds[0].left_out[2].condition == "6");
  CHECK(folds[1].left_out[1].condition == "7");
  CHECK(folds[5].left_out.size() == 1);
  for (const Fold& fold : folds)
    CHECK(fold.training.size() + fold.left_out.size() == dataset.records.size());

  // Asked for, each is left out in turn; of one motion and one level the records are dealt.
  CHECK(split(dataset, parse_leave_out("condition")).size() == 8);
  for (Record& record : dataset.records) record.condition = "one", record.drive_level = 1;
  CHECK(format_leave_out(default_leave_out(dataset)) == "groups=6");
  CHECK(split(dataset, parse_leave_out("groups=4"))[0].left_out.size() == 3);
}

TEST_CASE("an impossible split says which ways would work") {
  Dataset dataset = small_dataset();
  for (Record& record : dataset.records) record.condition = "one";
  const std::string message = message_of([&] { split(dataset, parse_leave_out("condition")); });
  CHECK(message.find("one condition") != std::string::npos);
  CHECK(message.find("'current'") != std::string::npos);
  CHECK(message_of([&] {
          split(dataset, parse_leave_out("current=0.7"));
        }).find("no record is '0.7 A'") != std::string::npos);
}

TEST_CASE("ways of leaving out as text") {
  for (const char* text : {"condition", "current", "current=0.5,1", "record", "fraction=0.33",
                           "blocks=7", "roles", "each=gap,pole_length"})
    CHECK(format_leave_out(parse_leave_out(text)) == text);
  for (const char* text : {"", "conditions", "fraction=2", "fraction=x", "blocks=1", "blocks=2.5",
                           "blocks=x", "blocks=1e9", "current=", "roles=1", "each", "each="}) {
    CAPTURE(text);
    CHECK(!message_of([&] { parse_leave_out(text); }).empty());
  }
}

TEST_CASE("what agrees in named conditions is left out together") {
  Dataset dataset = small_dataset();
  for (std::size_t k = 0; k < dataset.records.size(); ++k)
    dataset.records[k].conditions = {{"gap", k % 2 ? 1e-3 : 2e-3},
                                     {"viscosity", k < 3 ? 0.1 : 0.2}};
  const auto gaps = split(dataset, parse_leave_out("each=gap"));
  REQUIRE(gaps.size() == 2);
  CHECK(gaps[0].name == "without gap 0.002");
  CHECK(gaps[0].left_out.size() == 3);
  CHECK(split(dataset, parse_leave_out("each=gap,viscosity")).size() == 4);
  CHECK(message_of([&] {
          split(dataset, parse_leave_out("each=gapp"));
        }).find("no condition 'gapp'") != std::string::npos);
  for (Record& record : dataset.records) record.conditions = {{"gap", 1e-3}};
  CHECK(message_of([&] {
          split(dataset, parse_leave_out("each=gap"));
        }).find("all records have gap 0.001") != std::string::npos);
}

TEST_CASE("a training part is held back as the judged part was left out, else in six") {
  const std::vector<Record> training = small_dataset().records;
  CHECK(hold_back(training, parse_leave_out("condition=other")).size() == 2);
  CHECK(hold_back(training, parse_leave_out("current=0.7")).size() == 1);
  const auto records = hold_back(training, parse_leave_out("roles"));
  REQUIRE(records.size() == 6);
  CHECK(records[1].left_out.size() == 1);
  CHECK(records[1].training.size() == 5);
  CHECK(hold_back({training.begin(), training.begin() + 4}, parse_leave_out("roles")).size() == 4);

  Record record = training.front().slice(0, 10);
  for (int k = 10; k < 100; ++k) {
    record.time.push_back(k);
    record.channels.front().samples.push_back(k);
  }
  record.warm_up = 10;
  const auto stretches = hold_back({record}, parse_leave_out("fraction=0.3"));
  REQUIRE(stretches.size() == 6);  // of the 90 scored samples
  const Fold& second = stretches[1];
  CHECK(second.left_out.front().warm_up == 25);  // run from the start, scored from 25 to 39
  CHECK(second.left_out.front().size() == 40);
  REQUIRE(second.training.size() == 2);
  CHECK(second.training[0].size() == 25);
  CHECK(second.training[1].time.front() == 40);
  CHECK(stretches[0].training.size() == 1);
  CHECK(stretches[5].training.size() == 1);
  CHECK(hold_back({training.front()}, parse_leave_out("fraction=0.3")).empty());  // too short
}

TEST_CASE("trials hold back each condition and each inner level, else the ends") {
  const std::vector<Record> training = small_dataset().records;
  const auto folds = trial_folds(training);
  REQUIRE(folds.size() == 3);  // slow, fast, 0.5
  for (const Fold& fold : folds)
    CHECK(fold.training.size() + fold.left_out.size() == training.size());
  CHECK(folds[1].left_out.front().condition == "fast");
  CHECK(folds[2].left_out.size() == 2);
  CHECK(*folds[2].left_out[1].drive_level == 0.5);
  Record one = training.front();
  one.warm_up = 5;
  const auto ends = trial_folds({one});
  REQUIRE(ends.size() == 1);  // 30 % of 5 scored samples, rounded down
  CHECK(ends[0].training[0].size() == 9);
  CHECK(ends[0].left_out[0].size() == 10);
  CHECK(ends[0].left_out[0].warm_up == 9);
}

TEST_CASE("records whose drive varies are a division of their own beside the inner levels") {
  Dataset dataset = small_dataset();
  for (const std::size_t k : {2, 5}) {
    dataset.records[k].drive_level.reset();
    dataset.records[k].name += ", varying";
  }
  // Two levels are left, none of them an inner one.
  const auto folds = split(dataset, parse_leave_out("current"));
  REQUIRE(folds.size() == 1);
  CHECK(folds[0].name == kWithoutVaryingDrive);
  CHECK(folds[0].left_out.size() == 2);
  CHECK(folds[0].training.size() == 4);
  for (const Record& record : folds[0].left_out) CHECK(!record.drive_level);

  // By name, beside a level; levels alone leave them in the training.
  const auto named = split(dataset, parse_leave_out("current=0.5,varies"));
  REQUIRE(named.size() == 2);
  CHECK(*named[0].left_out[0].drive_level == 0.5);
  CHECK(named[1].name == kWithoutVaryingDrive);
  CHECK(split(dataset, parse_leave_out("current=0.5")).size() == 1);

  // Where nothing else is there to train on, it is said why.
  for (Record& record : dataset.records) record.drive_level.reset();
  CHECK(contains(message_of([&] { split(dataset, parse_leave_out("current")); }),
                 "the drive varies within all of its records"));
  CHECK(contains(message_of([&] { split(small_dataset(), parse_leave_out("current=varies")); }),
                 "no record is 'records of varying drive'"));
}
