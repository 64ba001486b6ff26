#include "dashpot/suspension/steps/step_method.h"

namespace dashpot {
namespace {

/// Stretches go by explicit steps. Where these become many, implicit ones are tried, and whichever
/// needed fewer evaluations goes on; the other one is tried again from time to time.
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
    const bool tries = ++since_ >= kPatience && by_explicit_ > 2 * implicit_cost_;
    if (tries) since_ = 0;
    const bool implicitly = stiff_ != tries;
    const bool finite = implicitly ? by_implicit(state, end) : by_explicit(state, end);
    if (implicitly || tries) stiff_ = by_implicit_ < by_explicit_;
    add_up();
    return finite;
  }

 private:
  /// Evaluations of an implicit step's stages, with the slopes by time and at its end.
  static constexpr std::size_t kStages = 8;
  static constexpr int kPatience = 16;  ///< stretches between tries of the other method

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
  int since_ = kPatience;
};

}  // namespace

std::unique_ptr<StepMethod> make_switching_steps(const PlantForces& forces,
                                                 const IntegratorOptions& options,
                                                 const PlantState& start) {
  return std::make_unique<SwitchingSteps>(forces, options, start);
}

}  // namespace dashpot
