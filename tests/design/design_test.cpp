#include "dashpot/design/design.h"

#include "dashpot/base/data_folder.h"
#include "support.h"

using namespace dashpot;

namespace {

// A valve of free width, whose fluid yields at a given stress: what Jolly's and Carlson's rule speaks of.
constexpr const char* kVolume = R"(
damper: passenger_car
at: {velocity: 0.2 m/s}
vary:
  gap: {from: 0.3 mm, to: 3 mm}
  pole_length: {from: 2 mm, to: 200 mm}
  gap_area: {from: 20 mm^2, to: 800 mm^2}
  yield_stress: [30 kPa]
  piston_area: [1500 mm^2]
  passive_length: [0]
  friction: [0]
constraints:
  - {quantity: control_ratio, min: 8}
  - {quantity: controllable_power, min: 300 W}
goals: [{minimise: active_volume}]
)";

DesignReport designed(const std::string& text, DesignOptions options = {}) {
  options.threads = 1;
  return design(parse_request(text, "request.yaml"), options);
}

}  // namespace

TEST_CASE("design: the smallest active volume is that of Jolly and Carlson") {
  // V = (12 / c^2) (eta / tau^2) lambda W_m: MODELS.md 5.2, recalled. With the pressures 12 eta L Q / (w h^3)
  // and c tau L / h it is an identity; here c = 2. 132DG: 0.112 Pa s.
  const DesignReport report = designed(kVolume);
  REQUIRE(report.designs.size() == 1);
  const double rule = 12. / 4 * 0.112 / (30e3 * 30e3) * 8 * 300;
  CHECK_CLOSE(report.designs[0].assessment.goals[0], rule, 1e-4, 0);
}

TEST_CASE("design: the gap of the largest control ratio under friction") {
  // Of a slot of fixed width, a h^-1 / (b h^-3 + f) is largest at h^3 = 2 b / f: there the viscous force is
  // half of the friction.
  const DesignReport report = designed(R"(
damper: passenger_car
at: {velocity: 0.2 m/s}
vary: {gap: {from: 0.3 mm, to: 8 mm}, yield_stress: [30 kPa], passive_length: [0], piston_area: [1500 mm^2], friction: [50 N]}
follow: {gap_area: {gap: 0.14}}
goals: [{maximise: control_ratio}]
)");
  REQUIRE(report.designs.size() == 1);
  const double flow = 1500e-6 * 0.2, pole = 0.024;
  const double b = 1500e-6 * 12 * 0.112 * pole * flow / 0.14;
  CHECK_CLOSE(report.designs[0].damper.gap, std::cbrt(2 * b / 50), 1e-3, 0);
}
