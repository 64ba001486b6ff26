#include <algorithm>

#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/damper/kinds/family/physics_family.h"
#include "dashpot/identify.h"
#include "support.h"
#include "virtual_family.h"

using namespace dashpot;

namespace {

FitReport fit_virtual(const Dataset& data) {
  return identify("family_physics", data.records, DriveUnit::Ampere, {.offset = OffsetMode::None});
}

double virtual_esr(const DamperModel& model, const Dataset& data) {
  return evaluate(model, data.records, DriveUnit::Ampere, {.offset = OffsetMode::None}).pooled.esr;
}

VirtualFamily small_family() {
  VirtualFamily family;
  family.gaps = {1e-3, 1.4e-3};
  family.lengths = {6e-3, 10e-3};
  family.viscosities = {0.09};
  family.currents = {0, 0.5, 1.5};
  family.samples = 120;
  return family;
}

}  // namespace

TEST_CASE("a family of physics predicts a gap beyond those of its fit") {
  const FitReport report = fit_virtual(virtual_family(small_family()));
  REQUIRE(report.model);
  VirtualFamily wide = small_family();
  wide.gaps = {1.9e-3};
  wide.scatter = 0;
  CHECK(virtual_esr(*report.model, virtual_family(wide)) <= 2);
  const auto far = report.model->specialised({{"gap", 1.9e-3}});
  CHECK(contains(far->extrapolations().at(0), "gap is 0.0019"));
}

TEST_CASE("a family of physics knows the spring of a gap that it has not seen") {
  VirtualFamily family = small_family();
  family.gaps = {1e-3, 1.3e-3, 2e-3};
  family.lengths = {8e-3};
  family.spring_of_gap = -2;
  const FitReport report = fit_virtual(virtual_family(family));
  REQUIRE(report.model);
  family.gaps = {1.6e-3};
  family.scatter = 0;
  CHECK(virtual_esr(*report.model, virtual_family(family)) <= 0.5);
}

TEST_CASE("coils whose currents are ten times as large give the same family of physics" *
          doctest::test_suite("long")) {
  const VirtualFamily family = small_family();
  VirtualFamily tenfold = family;
  tenfold.amperes = 10;
  const Dataset data = virtual_family(family), tens = virtual_family(tenfold);
  const double esr = virtual_esr(*fit_virtual(data).model, data);
  CHECK(esr < 1);
  CHECK_CLOSE(virtual_esr(*fit_virtual(tens).model, tens), esr, 1e-6, 0);
}

TEST_CASE("a new piston area changes the force of a family of physics as plate flow does") {
  const FitReport report = fit_virtual(virtual_family(small_family()));
  REQUIRE(report.model);
  VirtualFamily twice = small_family();
  twice.bores = {2};
  twice.scatter = 0;
  CHECK(virtual_esr(*report.model, virtual_family(twice)) <= 3);
}

TEST_CASE("builds of one drawing tell their spread apart from what the family gets wrong" *
          doctest::test_suite("long")) {
  // Two builds of each of six drawings, 4 % of scatter in the whole force of each.
  constexpr double kScatter = 0.04;
  const VirtualFamily family = small_family();
  Random random(11);
  Dataset data;
  for (const double gap : {1e-3, 1.4e-3})
    for (const double length : {6e-3, 8e-3, 10e-3})
      for (const double specimen : {1, 2}) {
        const double build = 1 + kScatter * random.normal();
        for (const double current : family.currents) {
          data.records.push_back(
              virtual_record(family, 1, gap, length, 0.09, current, 0, build, random));
          data.records.back().conditions.emplace_back(kSpecimen, specimen);
        }
      }
  const FitReport report = fit_virtual(data);
  REQUIRE(report.model);
  const auto parameter = [&](const FitReport& of, std::string_view name) {
    const auto found = std::ranges::find(of.parameters, name, &FittedParameter::name);
    return found == of.parameters.end() ? nullptr : &*found;
  };
  const auto* builds = parameter(report, "build_spread");
  REQUIRE(builds);
  CHECK(builds->low < kScatter);
  CHECK(builds->high > kScatter);
  REQUIRE(parameter(report, "drawing_spread"));
  CHECK(parameter(report, "drawing_spread")->value < kScatter);

  // Both stand in the model's file, and in the spread of a new damper.
  const auto& model = dynamic_cast<const FamilyModel&>(*report.model);
  const auto& read = family_model_from_json(model.to_json());
  CHECK(read->family().build_spread == builds->value);
  CHECK(read->family().drawing_spread == parameter(report, "drawing_spread")->value);

  // Without the numbers of builds there is one spread, and it says so.
  for (Record& record : data.records) record.conditions.pop_back();
  const FitReport merged = fit_virtual(data);
  CHECK(!parameter(merged, "drawing_spread"));
  CHECK(contains(parameter(merged, "build_spread")->meaning, "no repeated build tells apart"));
}
