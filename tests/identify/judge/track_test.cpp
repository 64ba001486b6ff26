#include "dashpot/identify/judge/track.h"

#include <algorithm>
#include <cmath>

#include "dashpot/damper/inverse/numeric.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/registry.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Bingham, c0 = 1000 N*s/m, friction 100 + 800 i.
LawModel damper(double lag_rate) {
  return LawModel(find_law("bingham"),
                  {{Form::Constant, Form::Linear, Form::Constant, Form::Constant},
                   {{1000}, {100, 800}, {0}, {0}}},
                  DriveUnit::Ampere, lag_rate);
}

/// The damper's force at this current, by its equation.
double force_at(double v, double current) {
  return 1000 * v + ((v > 0) - (v < 0)) * (100 + 800 * current);
}

TrackReport track_with(const LawModel& model, const InverseModel& inverse,
                       const std::vector<double>& wanted, const Motion& motion) {
  return track(model, inverse, Driver(driver_of(model, {})), motion, wanted);
}

}  // namespace

TEST_CASE("track: half of the time in reach, the other half beyond it") {
  const Motion motion = sine_motion({.amplitude = 0.01, .frequency = 1, .duration = 2.1});
  std::vector<double> wanted;
  for (std::size_t k = 0; k < motion.size(); ++k)
    wanted.push_back(force_at(motion.velocity[k], k < 1100 ? 0.5 : 1.5));
  const LawModel model = damper(0);
  const TrackReport report = track_with(model, NumericInverse(model, {}), wanted, motion);
  CHECK(report.warm_up == 100);
  CHECK_CLOSE(report.reachable_share, 50, 0, 0.3);  // at v = 0 any force is as good
  CHECK_CLOSE(report.saturated_share, 50, 0, 0.3);
  CHECK(report.reachable.max_error < 1e-2);
  CHECK_CLOSE(report.all.max_error, 400, 1e-9, 0);  // of 1.5 A, 1 A flows
  CHECK_CLOSE(report.span, *std::ranges::max_element(wanted) - *std::ranges::min_element(wanted),
              1e-15, 0);
  for (const std::size_t k : {150, 1400}) {
    const double v = motion.velocity[k];
    CHECK_CLOSE(report.least[k], std::min(force_at(v, 0), force_at(v, 1)), 1e-12, 0);
    CHECK_CLOSE(report.greatest[k], std::max(force_at(v, 0), force_at(v, 1)), 1e-12, 0);
  }
}

TEST_CASE("track: the damper's own lag is the driver's, and delays a step of the wanted force") {
  const LawModel model = damper(100);
  const DriverOptions driver = driver_of(model, {});
  CHECK(driver.lag_rate == 100);
  Motion motion;
  motion.displacement.assign(400, 0);
  motion.velocity.assign(400, 0.1);
  std::vector<double> wanted(400, force_at(0.1, 0.2));
  std::fill(wanted.begin() + 200, wanted.end(), force_at(0.1, 0.9));
  const TrackReport report =
      track_with(model, NumericInverse(model, limits_of(driver, 1e-3)), wanted, motion);
  CHECK_CLOSE(report.obtained[199], wanted[199], 1e-5, 0);
  // Full current is commanded until 0.9 A are met: 1 - 0.8 exp(-100 t) = 0.9 at t = 20.8 ms.
  CHECK_CLOSE(report.current[210], 1 - 0.8 * std::exp(-1.0), 1e-5, 0);
  CHECK_CLOSE(report.obtained[222], wanted[222], 1e-5, 0);
}

TEST_CASE("track: lengths that differ are refused") {
  const LawModel model = damper(0);
  const Motion motion = sine_motion({.duration = 1});
  CHECK(message_of([&] {
          track_with(model, NumericInverse(model, {}), {1, 2}, motion);
        }).starts_with("track: the wanted force and the motion differ"));
}
