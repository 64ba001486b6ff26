#include <algorithm>

#include "dashpot/suspension/steps/step_method.h"

namespace dashpot {
namespace {

/// Stretches go by explicit steps. Where these cost much in stretches on end, implicit ones are
/// tried, and whichever needed fewer evaluations goes on. Explicit steps are tried again soon,
/// since what asked for short ones may have passed, and later and later where it has not.
class SwitchingSteps final : public StepMethod {
 public:
  SwitchingSteps(const PlantForces& forces, const IntegratorOptions& options,
                 const PlantState& start)
      : explicit_(make_explicit_steps(forces, options, start)),
        implicit_(make_implicit_steps(forces, options, start)) {
    std::size_t size = start.x.size();
    for (const DamperState& damper : start.dampers) size += damper.model_state().size();
    implicit_cost_ = 3 * static_cast<double>(size + kStages);
  }

  void refresh(PlantState& state) override {
    explicit_->refresh(state);
    explicit_knows_ = true;
    add_up();
  }

  bool advance(PlantState& state, double end) override {
    const bool tries = stiff_ ? ++stretches_ > wait_ : costs_ >= kCostly;
    const bool implicitly = stiff_ != tries, was_stiff = stiff_;
    const bool finite = implicitly ? by_implicit(state, end) : by_explicit(state, end);
    if (implicitly || tries) stiff_ = by_implicit_ < by_explicit_;

    // When the other method is tried next.
    if (tries) {
      wait_ = was_stiff && stiff_ ? std::min(2 * wait_, kMostWait) : 1;
      stretches_ = 0;
      costs_ = implicitly && !stiff_ ? -kMostWait : 0;
    } else if (!implicitly) {
      const double share = by_explicit_ / (2 * implicit_cost_);
      costs_ = share > 1 ? costs_ + share : std::min(costs_, 0.0);
    }
    add_up();
    return finite;
  }

 private:
  /// Evaluations of an implicit step's stages, with the slopes by time and at its end.
  static constexpr std::size_t kStages = 8;
  /// Of stretches on end that each cost more than two implicit steps, in such costs: implicit ones
  /// are tried.
  static constexpr double kCostly = 4;
  static constexpr int kMostWait = 16;  ///< stretches or costs between tries of the other method

  bool by_explicit(PlantState& state, double end) {
    if (!explicit_knows_) explicit_->refresh(state);
    explicit_knows_ = true;
    const std::size_t before = explicit_->counts().evaluations;
    const bool finite = explicit_->advance(state, end);
    by_explicit_ = static_cast<double>(explicit_->counts().evaluations - before);
    return finite;
  }
  bool by_implicit(PlantState& state, double end) {
    explicit_knows_ = false;
    const std::size_t before = implicit_->counts().steps;
    const bool finite = implicit_->advance(state, end);
    by_implicit_ = implicit_cost_ * static_cast<double>(implicit_->counts().steps - before);
    return finite;
  }
  void add_up() {
    const StepCounts &a = explicit_->counts(), &b = implicit_->counts();
    counts_ = {a.steps + b.steps, a.evaluations + b.evaluations, a.missed + b.missed};
  }

  std::unique_ptr<StepMethod> explicit_, implicit_;
  /// Cost of an implicit step in evaluations: Jacobian, stages and linear algebra, measured on a
  /// quarter car.
  double implicit_cost_;
  double by_explicit_ = 0, by_implicit_ = 0;  ///< of the last stretch that each one took
  bool stiff_ = false, explicit_knows_ = false;
  double costs_ = 0;   ///< while not stiff: see kCostly
  int stretches_ = 0;  ///< while stiff, since explicit steps were tried last
  int wait_ = 1;       ///< and until they are tried again
};

}  // namespace

std::unique_ptr<StepMethod> make_switching_steps(const PlantForces& forces,
                                                 const IntegratorOptions& options,
                                                 const PlantState& start) {
  return std::make_unique<SwitchingSteps>(forces, options, start);
}

}  // namespace dashpot
