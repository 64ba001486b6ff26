#include "dashpot/identify/fit/family_build.h"

#include <cstdlib>

#include "damper/kinds/family/example_family.h"
#include "dashpot/identify.h"
#include "dashpot/rank.h"
#include "dashpot/split.h"
#include "support.h"
#include "virtual_family.h"

using namespace dashpot;

namespace {

/// A build that is this much stronger than its drawing, at all currents and both motions.
std::vector<Record> recorded_build(double strength) {
  Random random(3);
  std::vector<Record> records;
  for (const double current : {0., 0.5, 1.5})
    for (const int motion : {0, 1})
      records.push_back(
          virtual_record({}, 1, 1.2e-3, 8e-3, 0.09, current, motion, strength, random));
  return records;
}

std::shared_ptr<const FamilyModel> fitted_family() {
  VirtualFamily small;
  small.gaps = {1e-3, 1.4e-3};
  small.lengths = {6e-3, 10e-3};
  small.viscosities = {0.09};
  small.currents = {0, 0.5, 1.5};
  small.samples = 120;
  small.scatter = 0.06;
  static const FitReport kReport = identify("family_physics", virtual_family(small).records,
                                            DriveUnit::Ampere, {.offset = OffsetMode::None});
  return std::dynamic_pointer_cast<const FamilyModel>(kReport.model);
}

}  // namespace

TEST_CASE("one recording without current makes a build's other currents and speeds its own") {
  const auto family = fitted_family();
  const std::vector<Record> records = recorded_build(1.12);
  const auto member =
      std::dynamic_pointer_cast<const FamilyModel>(family->specialised(records.front().conditions));
  const BuildReport report = measure_build(*member, {records.front()}, DriveUnit::Ampere);
  CHECK(report.is_likely());
  CHECK(report.esr_after < report.esr_before);
  CHECK(report.deviations.at(0).value > 0.05);
  CHECK(report.deviations.at(0).left < report.deviations.at(0).spread);

  const std::vector<Record> others(records.begin() + 1, records.end());
  const auto esr = [&](const FamilyModel& model) {
    return evaluate(model, others, DriveUnit::Ampere, {.offset = OffsetMode::None}).pooled.esr;
  };
  CHECK(esr(*report.model) < 0.5 * esr(*member));
}

TEST_CASE("a build is told by forces that are counted from anywhere") {
  const auto family = fitted_family();
  std::vector<Record> records = recorded_build(1.12);
  const auto member =
      std::dynamic_pointer_cast<const FamilyModel>(family->specialised(records.front().conditions));
  const auto told = [&] {
    return measure_build(*member, records, DriveUnit::Ampere, ForceZero::Anywhere);
  };
  const BuildReport before = told();
  for (std::size_t k = 0; k < records.size(); ++k)
    for (double& value : records[k].find("force")->samples) value += 50. * static_cast<double>(k);
  const BuildReport moved = told();
  CHECK(before.is_likely());
  CHECK(before.deviations[0].value + before.deviations[1].value > 0.06);
  for (std::size_t k = 0; k < before.deviations.size(); ++k)
    CHECK_CLOSE(moved.deviations[k].value, before.deviations[k].value, 1e-3, 1e-4);
}

TEST_CASE("a recording of another damper is told from one of a build") {
  const auto family = fitted_family();
  const std::vector<Record> twice = recorded_build(2);
  const auto member =
      std::dynamic_pointer_cast<const FamilyModel>(family->specialised(twice.front().conditions));
  CHECK_FALSE(measure_build(*member, twice, DriveUnit::Ampere).is_likely());

  // One so far off that no build explains it moves nothing, and is told by what is left.
  std::vector<Record> far = recorded_build(1);
  for (Record& record : far)
    for (double& value : record.find("force")->samples) value *= 20;
  const BuildReport report = measure_build(*member, far, DriveUnit::Ampere);
  CHECK_FALSE((report.is_likely() && report.is_told()));
  CHECK(measure_build(*member, recorded_build(1.05), DriveUnit::Ampere).is_told());

  const auto other =
      std::dynamic_pointer_cast<const FamilyModel>(member->specialised({{"gap", 1.3e-3}}));
  CHECK(contains(message_of([&] { measure_build(*other, twice, DriveUnit::Ampere); }),
                 "is of a damper whose gap is 0.0012 m, not 0.0013"));
}

// What is predicted of a geometry that is left out, and what its record without current adds. Of
// issue 18: a line of 13 numbers leaves 1.35 % from the drawing, and 1.02 % with half a belief in
// that record.
TEST_CASE(
    "measured dampers of a geometry never seen: the record without current tells of the rest" *
    doctest::test_suite("long")) {
  const auto folder = shared_data("family-dnn");
  if (folder.empty()) return;
  const Dataset data = load_dataset({folder});
  ErrorSums all_levels, alone, with_record;
  const auto add = [](const DamperModel& model, const std::vector<Record>& records,
                      ErrorSums& sums) {
    for (const RecordResult& record :
         evaluate(model, records, DriveUnit::Ampere, {.offset = OffsetMode::None}).records)
      sums.add(record.sums);
  };

  // Every second geometry is enough. What docs/family.md tells of all, or of fluids, leaves out
  // each of what DASHPOT_FAMILY_FOLDS names: gap,pole_length or viscosity.
  const char* asked = std::getenv("DASHPOT_FAMILY_FOLDS");
  const std::vector<Fold> folds =
      split(data, parse_leave_out(std::string("each=") + (asked ? asked : "gap,pole_length")));
  CHECK(folds.size() >= 2);
  for (std::size_t k = 0; k < folds.size(); k += asked ? 1 : 2) {
    const Fold& fold = folds[k];
    const std::vector<Record>& left = fold.left_out;
    const FitReport fit = identify("family_physics", every_third(fold.training), DriveUnit::Ampere,
                                   {.offset = OffsetMode::None});
    add(*fit.model, left, all_levels);
    for (const Record& zero : left) {
      if (zero.drive_level != 0) continue;
      std::vector<Record> others;
      for (const Record& record : left)
        if (record.condition == zero.condition && record.drive_level != 0) others.push_back(record);
      const auto member =
          std::dynamic_pointer_cast<const FamilyModel>(fit.model->specialised(zero.conditions));
      add(*member, others, alone);
      add(*measure_build(*member, {zero}, DriveUnit::Ampere).model, others, with_record);
    }
  }

  MESSAGE("ESR %, from the drawing: "
          << metrics(all_levels).esr << "; of the levels with current: " << metrics(alone).esr
          << ", with the record without it: " << metrics(with_record).esr);
  if (!asked) {
    CHECK(folds.size() >= 6);
    CHECK(metrics(all_levels).esr <= 1.75);
    CHECK(metrics(with_record).esr <= 1);
  }
  CHECK(metrics(with_record).esr < metrics(alone).esr);
}

TEST_CASE("measured dampers of a geometry never seen are recommended a line" *
          doctest::test_suite("long")) {
  const auto folder = shared_data("family-dnn");
  if (folder.empty()) return;
  const Ranking ranking =
      rank({"family_line"}, load_dataset({folder}), parse_leave_out("each=gap,pole_length"),
           {.offset = OffsetMode::None});
  CHECK(ranking.models.front().left_out.pooled.esr <= 1.35);
  CHECK(is_recommendable(ranking.models.front()));
}

TEST_CASE("a family that knows no builds takes no recording of one") {
  CHECK(contains(
      message_of([] { measure_build(example_family(), recorded_build(1), DriveUnit::Ampere); }),
      "does not know how builds"));
}
