#include "dashpot/machine/road_delay.h"

#include <algorithm>
#include <cmath>

#include "dashpot/error.h"
#include "dashpot/machine/plant_residuals.h"
#include "dashpot/machine/plant_start.h"
#include "dashpot/machine/road_follower.h"

namespace dashpot {
namespace {

/// How far a delay is looked for, as a share of where it is expected.
constexpr double kFurthestShare = 0.1;

InPlantSetup at_factor(InPlantSetup setup, double factor) {
  for (PlantInputChannel& input : setup.inputs)
    if (input.finds_later) {
      input.later *= factor;
      input.finds_later = false;
    }
  return setup;
}

/// Fits of one plant and law at one delay after the other, each from where the last one ended.
class FitsByDelay {
 public:
  FitsByDelay(const Law& law, const InPlantSetup& setup,
              const std::vector<PlantRecording>& recordings, const InPlantOptions& options)
      : law_(law), setup_(setup), recordings_(recordings), options_(options) {
    for (const PlantInputChannel& input : setup.inputs)
      longest_ = std::max(longest_, (1 + kFurthestShare) * input.later);
    const InPlantSetup first = at_factor(setup_, 1);
    PlantCases cases = cases_of(first, options.steps);
    start_ = plant_start(first, followed(first), cases, options);
    steps_ = law.step ? std::max<std::size_t>(1, options.steps) : cases.steps;

    // The weights are those of the fit at the expected delay.
    constexpr int kFirst = 25;
    for (int round = 0; round < 2; ++round) {
      fit(1, kFirst);
      setup_ = weighed_;
    }
  }

  /// The cost of the best fit at the expected delays times this factor.
  double cost(double factor) {
    constexpr int kFew = 8;
    return fit(factor, kFew);
  }

 private:
  std::vector<PlantRecording> followed(const InPlantSetup& setup) const {
    return with_followers(setup, recordings_, longest_);
  }
  PlantCases cases_of(const InPlantSetup& setup, std::size_t steps) const {
    return make_cases(setup, followed(setup), steps,
                      law_.step ? PlantMethod::StraightForce : PlantMethod::RungeKutta);
  }

  double fit(double factor, int iterations) {
    options_.monitor.check();
    const InPlantSetup setup = at_factor(setup_, factor);
    const PlantCases cases = cases_of(setup, steps_);
    const DamperUnknowns unknowns(law_, start_.scale, setup, options_.choices);
    PlantResiduals residuals(setup, cases, unknowns, start_.plant, start_.scale);
    if (x_.empty()) x_ = residuals.start(start_.plant, start_.states);

    LeastSquaresOptions solver;
    solver.max_iterations = iterations;
    solver.function_tolerance = 1e-6;
    solver.threads = options_.threads;
    const LeastSquaresReport solved =
        solve(residuals.problem(0, options_.threads), residuals.off_bounds(x_), solver);
    if (!std::isfinite(solved.cost) || solved.x.empty()) return INFINITY;
    x_ = solved.x;

    // What is left at each sensor here may become its weight.
    residuals.reweigh(x_);
    weighed_ = setup_;
    for (std::size_t s = 0; s < weighed_.sensors.size(); ++s)
      weighed_.sensors[s].noise = residuals.scale_of(s);
    return solved.cost;
  }

  const Law& law_;
  InPlantSetup setup_, weighed_;
  const std::vector<PlantRecording>& recordings_;
  const InPlantOptions& options_;
  double longest_ = 0;
  PlantStart start_;
  std::size_t steps_ = 1;
  std::vector<double> x_;
};

}  // namespace

bool looks_for_road_delay(const InPlantSetup& setup) {
  return std::ranges::any_of(setup.inputs, &PlantInputChannel::finds_later);
}

InPlantSetup with_found_road_delay(const Law& law, const InPlantSetup& setup,
                                   const std::vector<PlantRecording>& recordings,
                                   const InPlantOptions& options) {
  constexpr double kFirstStep = 0.02, kLastStep = 5e-4;
  constexpr int kMostRounds = 12;
  options.monitor.report("the delay of the road", 0);
  FitsByDelay fits(law, setup, recordings, options);

  // Three delays in a row: downhill until the middle one is best, then to the bottom of the
  // parabola through them, with a shorter step.
  double middle = 1, step = kFirstStep;
  for (int round = 0; round < kMostRounds && step > kLastStep; ++round) {
    options.monitor.report("the delay of the road", static_cast<double>(round) / kMostRounds);
    const double here = fits.cost(middle), before = fits.cost(middle - step),
                 behind = fits.cost(middle + step);
    if (!std::isfinite(here + before + behind))
      throw Error("plant, inputs", "the delay of a road cannot be found: the plant diverges",
                  "state it, or say where the plant's numbers are expected: 'about'");
    if (here <= before && here <= behind) {
      const double bend = before - 2 * here + behind;
      if (bend > 0) middle += 0.5 * step * (before - behind) / bend;
      step /= 4;
    } else {
      middle += before < behind ? -step : step;
    }
    if (std::abs(middle - 1) > kFurthestShare - step)
      throw Error("plant, inputs",
                  "the delay of a road is not found within a tenth of where it is expected",
                  "wheelbase over speed, and one speed all along");
  }
  return at_factor(setup, middle);
}

}  // namespace dashpot
