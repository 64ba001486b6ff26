#pragma once
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "dashpot/base/random.h"
#include "dashpot/damper/drawn_damper.h"
#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/design/next_drawings.h"
#include "dashpot/evaluate.h"
#include "dashpot/identify.h"
#include "dashpot/physics/damper_physics.h"

namespace dashpot {

/// Drawings that are built and recorded: exact plate flow behind a column of fluid that gives, and
/// Coulomb friction; or Herschel-Bulkley flow through valves that lean. Of no fitted model's
/// structure.
struct DrawnFamily {
  bool leans = false;
  double scatter = 0.03, noise = 0.005;  // of a build; of the greatest force
  std::vector<DrawingTest> tests;
};

/// Gap, length and bore, with two fluids.
inline DesignRequest drawn_family_request() {
  DesignRequest request = parse_request(R"(
damper: passenger_car
vary:
  gap: {from: 0.8 mm, to: 2.2 mm}
  pole_length: {from: 5 mm, to: 15 mm}
  bore_diameter: {from: 25 mm, to: 40 mm}
  fluid: [122EG, 140CG]
)",
                                        "request.yaml", {}, Goals::Optional);
  request.damper.passive_length = 0;
  return request;
}

inline std::vector<DrawingTest> drawn_family_tests() {
  std::vector<DrawingTest> tests;
  for (const SineMotion motion : {SineMotion{20e-3, 0.6}, SineMotion{8e-3, 2}})
    for (const double current : {0., 0.5, 1.5}) tests.push_back({motion, current});
  return tests;
}

/// A build of a drawing.
inline DrawnDamper built_drawing(const DrawnFamily& family, DamperDescription drawing,
                                 Random& random) {
  constexpr double kFriction = 15, kLean = 0.15, kIndex = 0.7, kRate = 1000;
  double largest = 0;
  for (const DrawingTest& test : family.tests) largest = std::max(largest, test.current);
  // A column of 100 mm of fluid with some gas in it.
  constexpr double kBulk = 3e8, kColumn = 0.1;
  const double stiffness = kBulk * evaluate_physics(drawing, {}).piston_area / kColumn;
  const auto chance = [&] { return std::max(0.1, 1 + family.scatter * random.normal()); };
  if (family.leans) {
    auto fluid = std::make_shared<Fluid>(*drawing.fluid);
    fluid->index = kIndex;
    fluid->shear_rate = kRate;
    drawing.fluid = fluid;
  }
  const double strength = chance();
  return DrawnDamper(
      drawing, {strength, kFriction * chance(), stiffness, family.leans ? kLean : 0.}, largest);
}

/// Every test of such a build, from rest at the lower end.
inline std::vector<Record> recorded_build(const DrawnFamily& family,
                                          const DamperDescription& drawing,
                                          const DrawnDamper& damper, Random& random) {
  constexpr int kOfCycle = 40, kSamples = 60, kParts = 10;
  std::vector<Record> records;
  for (const DrawingTest& test : family.tests) {
    const FamilyMember member = member_of(drawing, std::vector{test.current});
    Record record;
    record.condition = format_description(drawing);
    record.name = std::to_string(test.current) + " " + std::to_string(test.motion.frequency);
    record.drive_level = test.current;
    for (const MemberField& field : member_fields())
      if (field.required) record.conditions.emplace_back(field.name, member.*field.field);
    record.conditions.emplace_back(kYieldStress, member.yield.stresses.front());

    const double rate = 2 * std::numbers::pi * test.motion.frequency,
                 step = 1 / (test.motion.frequency * kOfCycle * kParts);
    std::vector<double> x, v, i, force, state(damper.state_size());
    const auto input = [&](double t) {
      return DamperInput{-test.motion.amplitude * std::cos(rate * t),
                         test.motion.amplitude * rate * std::sin(rate * t), test.current};
    };
    double most = 0;
    damper.rest(input(0), state);
    for (int k = 0; k < kSamples * kParts; ++k) {
      if (k > 0) damper.advance(input((k - 1) * step), input(k * step), step, state);
      if (k % kParts) continue;
      const DamperInput now = input(k * step);
      record.time.push_back(k * step);
      x.push_back(now.displacement);
      v.push_back(now.velocity);
      i.push_back(now.current);
      force.push_back(damper.force(now, state));
      most = std::max(most, std::abs(force.back()));
    }
    for (double& f : force) f += family.noise * most * random.normal();
    record.channels = {{"displacement", "m", x, ""},
                       {"velocity", "m/s", v, ""},
                       {"current", "A", i, ""},
                       {"force", "N", force, ""}};
    record.sample_time = step * kParts;
    records.push_back(std::move(record));
  }
  return records;
}

/// The same of a build of its own.
inline std::vector<Record> recorded_drawing(const DrawnFamily& family,
                                            const DamperDescription& drawing, Random& random) {
  return recorded_build(family, drawing, built_drawing(family, drawing, random), random);
}

inline std::shared_ptr<const FamilyModel> fitted_drawings(const std::vector<Record>& records) {
  const FitReport report =
      identify("family_physics", records, DriveUnit::Ampere, {.offset = OffsetMode::None});
  return std::dynamic_pointer_cast<const FamilyModel>(report.model);
}

/// Root mean square over records of each one's error as a share of its force.
inline double share_of_force(const DamperModel& model, const std::vector<Record>& records) {
  double sum = 0;
  for (const RecordResult& record :
       evaluate(model, records, DriveUnit::Ampere, {.offset = OffsetMode::None}).records)
    sum += record.sums.squared / record.sums.force_squared;
  return std::sqrt(sum / static_cast<double>(records.size()));
}

}  // namespace dashpot
