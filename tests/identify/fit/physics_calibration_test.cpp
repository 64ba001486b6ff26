#include "dashpot/identify/fit/physics_calibration.h"

#include <cmath>
#include <numbers>

#include "dashpot/base/random.h"
#include "dashpot/damper/kinds/family/family_member.h"
#include "dashpot/physics/damper_physics.h"
#include "dashpot/physics/fluid.h"
#include "dashpot/physics/plate_flow.h"
#include "support.h"

using namespace dashpot;

namespace {

DamperDescription drawn() {
  DamperDescription damper = parse_description(
      "name: drawn\nfluid: 132DG\nbore_diameter: 40 mm\nrod_diameter: 10 mm\ngap: 0.9 mm\n"
      "pole_length: 20 mm\npassive_length: 12 mm\n",
      "drawn.yaml");
  return damper;
}

/// Recordings of a damper whose fluid differs from its drawing's, by bisection in steps much finer
/// than the samples: plate flow in series with a spring, Coulomb friction beside.
Dataset bench_of_drawn(const std::vector<double>& currents, double yield, double viscosity,
                       double friction, double spring) {
  const DamperDescription damper = drawn();
  Dataset data;
  data.name = "recorded";
  Random random(3);
  for (const double current : currents)
    for (const int motion : {0, 1}) {
      const DamperPhysics p = evaluate_physics(damper, {.current = current, .velocity = 1});
      const double most = yield * p.yield_pressure * p.piston_area;
      const double newton = viscosity * p.newtonian_pressure * p.piston_area;
      const double passive = viscosity * p.passive_pressure * p.piston_area;
      const double rate = 2 * std::numbers::pi * (motion ? 2. : 0.5),
                   half_stroke = motion ? 0.01 : 0.02;
      constexpr int kSamples = 400, kParts = 20;
      const double step = 3 / (rate / (2 * std::numbers::pi)) / kSamples / kParts;
      Record record;
      record.name = std::to_string(current) + " " + std::to_string(motion);
      record.drive_level = current;
      std::vector<double> x, v, i, force;
      double now = 0, offset = 5 * random.normal();
      for (int k = 0; k < kSamples * kParts; ++k) {
        const double t = k * step, speed = half_stroke * rate * std::sin(rate * t);
        const double pull = now + spring * step * speed;
        double low = 0, high = std::abs(speed) + std::abs(now) / (spring * step);
        for (int n = 0; n < 60; ++n) {
          const double u = 0.5 * (low + high);
          const double flows = plate_bingham_pressure(newton * u, most) + passive * u;
          (flows + spring * step * u > std::abs(pull) ? high : low) = u;
        }
        now = std::copysign(std::min(std::abs(pull), std::abs(pull) - spring * step * low), pull);
        if (k % kParts) continue;
        record.time.push_back(t);
        x.push_back(-half_stroke * std::cos(rate * t));
        v.push_back(speed);
        i.push_back(current);
        force.push_back(now + friction * std::tanh(speed / 1e-3) + offset + random.normal());
      }
      record.channels = {{"displacement", "m", x, ""},
                         {"velocity", "m/s", v, ""},
                         {"current", "A", i, ""},
                         {"force", "N", force, ""}};
      record.sample_time = step * kParts;
      data.records.push_back(record);
    }
  return data;
}

const PhysicsCalibration::Number& number(const PhysicsCalibration& found, const char* name) {
  for (const PhysicsCalibration::Number& one : found.numbers)
    if (one.name == name) return one;
  FAIL(name);
  return found.numbers.front();
}

}  // namespace

TEST_CASE("a calibration finds fluid, friction and compliance of a drawn damper, with intervals") {
  const PhysicsCalibration found =
      calibrate_physics(drawn(), bench_of_drawn({0, 0.5, 1, 2}, 0.8, 1.3, 40, 8e5));
  CHECK_CLOSE(number(found, "yield_stress").value, 0.8, 0.02, 0);
  CHECK_CLOSE(number(found, "viscosity").value, 1.3, 0.05, 0);
  CHECK_CLOSE(number(found, "friction").value, 40, 0.1, 0);
  CHECK_CLOSE(number(found, "stiffness").value, 8e5, 0.05, 0);
  for (const char* name : {"yield_stress", "viscosity", "stiffness"}) {
    CHECK(number(found, name).is_known);
    CHECK(number(found, name).high < 1.3 * number(found, name).low);
  }
  CHECK(found.esr_after < 0.5);
  CHECK(found.esr_before > 10 * found.esr_after);
  REQUIRE(found.levels.size() == 3);
  for (const PhysicsCalibration::Level& level : found.levels)
    CHECK_CLOSE(level.ratio, 0.8, 0.03, 0);

  // The calibrated drawing gives the true force, and its fluid says how well it is known.
  const DamperOperation at{.current = 1, .velocity = 0.1};
  const DamperDescription again =
      parse_description(format_description(found.damper), "calibrated.yaml");
  CHECK_CLOSE(evaluate_physics(again, at).yield_stress,
              0.8 * evaluate_physics(drawn(), at).yield_stress, 0.02, 0);
  CHECK(again.fluid->yield_uncertainty > 0);
  CHECK(again.fluid->yield_uncertainty < 0.1);
}

TEST_CASE("a calibration doubts recordings that look like another damper's") {
  const auto doubts = [](const DamperDescription& drawing, double viscosity) {
    std::string all;
    for (const std::string& doubt :
         calibrate_physics(drawing, bench_of_drawn({0, 0.5, 2}, 0.8, viscosity, 40, 8e5)).doubts)
      all += doubt + '\n';
    return all;
  };
  CHECK(doubts(drawn(), 1.3) == "");
  CHECK(doubts(drawn(), 2.5).find("times the file's, which is off by a factor of 2 at most") !=
        std::string::npos);

  // A fluid that is known better, and a coil of fewer turns, which saturates its core later.
  DamperDescription known = drawn();
  Fluid fluid = *known.fluid;
  fluid.viscosity_uncertainty = 0.1;
  known.fluid = std::make_shared<const Fluid>(fluid);
  CHECK(doubts(known, 1.3).find("off by a factor of 1.2 at most") != std::string::npos);
  DamperDescription weak = drawn();
  weak.turns *= 0.4;
  CHECK(doubts(weak, 1.3).find("is the drawing that of the damper which was recorded, with its "
                               "fluid and magnetic circuit?") != std::string::npos);
}

TEST_CASE("a calibration says what its recordings do not tell, and refuses what it cannot use") {
  // Without a current there is hardly a yield stress.
  CHECK(message_of([] {
          calibrate_physics(drawn(), bench_of_drawn({0}, 1, 1, 40, 8e5));
        }).find("no recording has a current") != std::string::npos);

  // A strong current alone tells friction less surely than with a record without current.
  const auto width = [](const std::vector<double>& currents) {
    const PhysicsCalibration found =
        calibrate_physics(drawn(), bench_of_drawn(currents, 0.8, 1.3, 40, 8e5));
    return number(found, "friction").high / number(found, "friction").low - 1;
  };
  CHECK(width({2}) > 3 * width({0, 2}));

  Dataset another = bench_of_drawn({1}, 1, 1, 40, 8e5);
  another.records.front().conditions = {{"gap", 1.2e-3}};
  CHECK(message_of([&] {
          calibrate_physics(drawn(), another);
        }).find("is of a damper whose gap is 0.0012 m") != std::string::npos);
  DamperDescription fixed = drawn();
  fixed.yield_stress = 1e4;
  CHECK(message_of([&] {
          calibrate_physics(fixed, bench_of_drawn({1}, 1, 1, 40, 8e5));
        }).find("at any current") != std::string::npos);
  Dataset volts = bench_of_drawn({1}, 1, 1, 40, 8e5);
  volts.drive_unit = DriveUnit::Volt;
  CHECK(message_of([&] { calibrate_physics(drawn(), volts); }).find("is driven by V") !=
        std::string::npos);
}
