#pragma once
#include <algorithm>
#include <array>
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
/// positions, as matters to models that read the displacement. With `unproven`, for models that
/// nothing but data has formed, they stand closer and some go to 3 and 20 times the strokes and
/// speeds of the domain: a wheel behind a kerb of 3 cm is that much quicker than a bench.
std::vector<ProbeSine> probe_sines(Domain domain, bool about_positions, bool unproven);

/// Those by which a model is judged. Laws have their sets, passive networks their
/// proof, and both together what these leave.
inline std::vector<ProbeSine> probe_sines(const DamperModel& model, const Domain& domain) {
  constexpr std::array kProven{ModelKind::Law, ModelKind::PassiveNetwork, ModelKind::PassiveHybrid};
  const bool unproven = std::ranges::find(kProven, model.kind()) == kProven.end();
  return probe_sines(domain, model.needs_displacement(), unproven);
}

/// One cycle, its first sample again at its end; none falls on the middle of the stroke, where a
/// law may leap.
std::vector<DamperInput> cycle_of(const ProbeSine& sine);

/// s, between two of these samples.
inline double step_of(const ProbeSine& sine) {
  return 1 / (sine.frequency * static_cast<double>(kProbeSamples));
}

/// What a cycle did.
struct ProbedCycle {
  static constexpr double kTolerance = 1e-3;  ///< of what passes through: less is no activity

  double work = 0, passed = 0;  ///< J; out, and through in both directions
  double squares = 0;           ///< m^2/s: of the velocity, over time
  bool diverged = false;

  double share() const {
    if (diverged) return -INFINITY;
    return passed > 0 ? work / passed : 0;
  }
  double damping() const { return work / squares; }
  bool is_active() const { return share() < -kTolerance; }
};

/// Of the inputs of one cycle, the forces at them and the step between them. The work by the
/// trapezoid rule, which is exact for a spring; what passes through is that of the force about its
/// mean, so that a preload is no energy.
ProbedCycle measured(std::span<const DamperInput> inputs, std::span<const double> force,
                     double step);

/// What a model does under each of the sines once it repeats itself: a cycle that is like the one
/// before, else the mean of many, as of a model whose own steps beat with the motion.
std::vector<ProbedCycle> settled_cycles(const DamperModel& model, std::span<const ProbeSine> sines,
                                        int threads);

/// The derivatives of the share of a cycle so measured by the forces, one per sample.
std::vector<double> share_slopes(std::span<const DamperInput> inputs, std::span<const double> force,
                                 const ProbedCycle& cycle);

}  // namespace dashpot
