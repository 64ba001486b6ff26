#include "dashpot/damper/probe_sine.h"

#include <algorithm>
#include <numbers>

#include "support.h"

using namespace dashpot;

namespace {

/// A force that is neither a spring's nor a dashpot's, with a preload, over one cycle.
std::vector<double> force_over(const std::vector<DamperInput>& cycle) {
  std::vector<double> force;
  for (const DamperInput& input : cycle)
    force.push_back(200 + 5e4 * input.displacement - 300 * input.velocity +
                    80 * std::tanh(40 * input.velocity + 100 * input.displacement));
  return force;
}

}  // namespace

TEST_CASE("a dashpot takes out all, a spring nothing, and a preload is no energy") {
  const ProbeSine sine{20, 1e-3, 0.01, 1};
  const std::vector<DamperInput> cycle = cycle_of(sine);
  std::vector<double> dashpot, spring;
  for (const DamperInput& input : cycle) {
    dashpot.push_back(500 + 1000 * input.velocity);
    spring.push_back(500 + 1000 * input.displacement);
  }
  CHECK_CLOSE(measured(cycle, dashpot, step_of(sine)).share(), 1, 1e-9, 0);
  CHECK_CLOSE(measured(cycle, dashpot, step_of(sine)).damping(), 1000, 1e-3, 0);
  CHECK(std::abs(measured(cycle, spring, step_of(sine)).share()) < 1e-12);
}

TEST_CASE("the slopes of a share are its derivatives by each force") {
  const ProbeSine sine{7, 2e-3, 0, 1};
  const std::vector<DamperInput> cycle = cycle_of(sine);
  const std::vector<double> force = force_over(cycle);
  const std::vector<double> slopes = share_slopes(cycle, force, measured(cycle, force, 1));
  for (std::size_t k = 0; k < force.size(); k += 7) {
    const auto moved = [&](double by) {
      std::vector<double> other = force;
      other[k] += by;
      return measured(cycle, other, 1).share();
    };
    CAPTURE(k);
    CHECK_CLOSE(slopes[k], (moved(1e-4) - moved(-1e-4)) / 2e-4, 1e-6, 1e-9);
  }
}

TEST_CASE("sines stay within the strokes and speeds of a domain") {
  const Domain domain{-0.01, 0.03, -0.2, 0.5, 0, 2};
  for (const ProbeSine& sine : probe_sines(domain, true, false)) {
    CHECK(sine.amplitude * 2 * 3.14159 * sine.frequency <= 0.5);
    CHECK(std::abs(sine.position - 0.01) + sine.amplitude <= 0.02 + 1e-12);
    CHECK(sine.drive >= 0);
    CHECK(sine.drive <= 2);
  }
  CHECK(probe_sines(domain, true, false).size() > probe_sines(domain, false, false).size());
}

TEST_CASE("sines beyond a domain are up to 20 times as far and as quick, the others as they were") {
  const Domain domain{-0.01, 0.03, -0.2, 0.5, 0, 2};
  double furthest = 0, quickest = 0;
  for (const ProbeSine& sine : probe_sines(domain, false, true)) {
    furthest = std::max(furthest, sine.amplitude);
    quickest = std::max(quickest, sine.amplitude * 2 * std::numbers::pi * sine.frequency);
  }
  CHECK_CLOSE(furthest, 20 * 0.02, 1e-12, 0);
  CHECK_CLOSE(quickest, 20 * 0.5, 1e-12, 0);
  CHECK(probe_sines(domain, false, true).size() > probe_sines(domain, false, false).size());
}
