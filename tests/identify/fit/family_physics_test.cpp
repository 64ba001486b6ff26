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

TEST_CASE("coils whose currents are ten times as large give the same family of physics") {
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
