#pragma once
#include <cmath>
#include <span>
#include <vector>

#include "dashpot/damper_model.h"

// The sines by which models are asked whether they take energy out: dissipation() in model_file.h
// makes a verdict of them, and a training may pay for what its model feeds into them.
namespace dashpot {

/// A sine about a position, at one drive.
struct ProbeSine {
  double frequency, amplitude, position, drive;  ///< Hz, m, m, A or V
};

constexpr std::size_t kProbeSamples = 100;  // of a cycle

/// The sines of 1 to 200 Hz and of 0.1 um to the strokes and speeds of a domain, at five drives; of
/// usual_domain() where it has no speeds. With `about_positions` small ones are made about three
/// positions, as matters to models that read the displacement.
std::vector<ProbeSine> probe_sines(Domain domain, bool about_positions);

/// One cycle, its first sample again at its end; none falls on the middle of the stroke, where a
/// law may leap.
std::vector<DamperInput> cycle_of(const ProbeSine& sine);

/// s, between two of these samples.
inline double step_of(const ProbeSine& sine) {
  return 1 / (sine.frequency * static_cast<double>(kProbeSamples));
}

/// What a cycle did.
struct ProbedCycle {
  double work = 0, passed = 0;  ///< J; out, and through in both directions
  double squares = 0;           ///< m^2/s: of the velocity, over time
  bool diverged = false;

  double share() const {
    if (diverged) return -INFINITY;
    return passed > 0 ? work / passed : 0;
  }
  double damping() const { return work / squares; }
};

/// Of the inputs of one cycle, the forces at them and the step between them. The work by the
/// trapezoid rule, which is exact for a spring; what passes through is that of the force about its
/// mean, so that a preload is no energy.
ProbedCycle measured(std::span<const DamperInput> inputs, std::span<const double> force,
                     double step);

/// The derivatives of the share of a cycle so measured by the forces, one per sample.
std::vector<double> share_slopes(std::span<const DamperInput> inputs, std::span<const double> force,
                                 const ProbedCycle& cycle);

}  // namespace dashpot
