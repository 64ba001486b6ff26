#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "dashpot/suspension/steps/dormand_prince.h"
#include "dashpot/suspension/steps/plant_equations.h"
#include "dashpot/suspension/steps/step_control.h"

namespace dashpot {
namespace {

using Method = DormandPrince;
constexpr std::size_t kStages = Method::kStages;

/// Between refresh() and the end of a stretch the first slope is that of y_: the method's last
/// stage gives it (DormandPrince).
class ExplicitSteps final : public StepMethod {
 public:
  ExplicitSteps(const PlantForces& forces, const IntegratorOptions& options,
                const PlantState& start)
      : equations_(forces, start),
        options_(options),
        size_(equations_.size()),
        y_(size_),
        trial_(size_),
        end_(size_),
        k_(kStages * size_) {
    equations_.follow_loops(start, options);
    turns_.resize(equations_.loops().size());
  }

  void refresh(PlantState& state) override {
    equations_.read(state, y_.data());
    begin(0);
    equations_.write_forces(k_.data(), state);
  }

  bool advance(PlantState& state, double end) override {
    const double length = end - state.time;
    if (!(length > 0)) return true;

    // The whole stretch is tried first; later ones start with the length that the last one
    // proposed.
    if (next_ == 0) next_ = length;
    equations_.read(state, y_.data());
    Allowance least(length);
    for (double done = 0; done < length;) {
      // One step, to the end of the stretch at most, and the length that its error allows.
      const bool last = done + next_ >= length * (1 - 1e-12);
      const double h = last ? length - done : next_;
      attempt(done, h);
      const double error = distance(h);
      const bool bad = !(error <= 1), keeps = last && !bad;
      if (!keeps || !is_longer(next_, h, error)) {
        const double wanted = h * step_factor(error, Method::kPower);
        next_ = keeps ? std::max(next_, wanted) : wanted;
      }
      next_ = std::max(next_, least.shortest());
      if (!turns_.empty() && !std::isnan(error)) {
        const double until = meet_turns(h, length);
        if (until < h) {
          next_ = until;
          take_turns(done, length, false);
          continue;
        }
      }

      // Too great an error is accepted from the shortest step alone, and counted.
      if (bad && !least.is_shortest(h)) continue;
      if (!std::isfinite(error)) return false;
      if (bad) {
        ++counts_.missed;
        least.miss();
      }

      // The step is taken: its last slope is the first of the next one.
      ++counts_.steps;
      std::swap(y_, end_);
      std::copy_n(&k_[(kStages - 1) * size_], size_, k_.begin());
      done = last ? length : done + h;
      if (!turns_.empty()) take_turns(done, length, true);
    }
    equations_.write(y_.data(), k_.data(), end, state);
    return true;
  }

 private:
  /// The first slope, at y_.
  void begin(double done) {
    slope(0, done, y_);
    for (std::size_t l = 0; l < turns_.size(); ++l) turns_[l].at_start(equations_.loops()[l]);
  }
  void slope(std::size_t stage, double after, const std::vector<double>& y) {
    ++counts_.evaluations;
    equations_.rates(after, y.data(), &k_[stage * size_]);
  }
  /// out = y + h (weights . slopes of the stages before).
  template <std::size_t... kBefore>
  void sum(std::vector<double>& out, double h, const double* weights,
           std::index_sequence<kBefore...>) const {
    const double* k = k_.data();
    const std::size_t n = size_;
    for (std::size_t i = 0; i < n; ++i)
      out[i] = y_[i] + h * ((weights[kBefore] * k[kBefore * n + i]) + ...);
  }
  template <std::size_t kStage>
  void stage(double done, double h, std::vector<double>& at) {
    sum(at, h, Method::kFrom[kStage], std::make_index_sequence<kStage>());
    slope(kStage, done + Method::kAt[kStage] * h, at);
    if constexpr (kStage == kEarly || kStage == kLate)
      for (std::size_t l = 0; l < turns_.size(); ++l)
        (kStage == kEarly ? turns_[l].early : turns_[l].late) = equations_.loops()[l].along;
  }
  /// end_ and the slope there, from y_ at `done` s in the stretch.
  void attempt(double done, double h) {
    stage<1>(done, h, trial_);
    stage<2>(done, h, trial_);
    stage<3>(done, h, trial_);
    stage<4>(done, h, trial_);
    stage<5>(done, h, trial_);
    stage<6>(done, h, end_);
  }
  /// |y_5 - y_4| / h of component i.
  double off(std::size_t i) const {
    double sum = 0;
    for (std::size_t s = 0; s < kStages; ++s) sum += Method::kError[s] * k_[s * size_ + i];
    return std::abs(sum);
  }
  /// Error of the step, in tolerances; that of a loop as one of its z.
  double distance(double h) const {
    const StepEnds ends{equations_.coordinates(), y_, end_};
    const auto loop_at = [&](std::size_t k) {
      std::size_t l = 0;
      while (l < turns_.size() && equations_.loops()[l].place != k) ++l;
      return l;
    };
    return error_in_tolerances(
        ends, options_,
        [&](std::size_t k) {
          const std::size_t l = loop_at(k);
          if (l == turns_.size()) return h * off(k);
          const FollowedLoop& loop = equations_.loops()[l];
          return loop.path.error(h * off(k), turns_[l].steep, loop.steep);
        },
        [&](std::size_t k) {
          const std::size_t l = loop_at(k);
          const double size = ends.size(k) + std::abs(h * k_[k]);
          return l == turns_.size() ? size : equations_.loops()[l].path.size(size);
        });
  }

  /// The length, s, to which a try of length h must be cut so that it ends where the first of the
  /// loops turns; h where none does.
  double meet_turns(double h, double stretch) {
    double until = h;
    for (std::size_t l = 0; l < turns_.size(); ++l) {
      const FollowedLoop& loop = equations_.loops()[l];
      Turn& turn = turns_[l];
      turn.met =
          loop.path.meet({turn.along, turn.early, turn.late, loop.along}, h, kNearTurn * stretch);
      if (!turn.met.over) continue;
      const double cut = turn.met.stuck ? 0.99 * h : turn.met.until;
      until = std::min(until, std::max(cut, kNearTurn * stretch));
    }
    return until;
  }
  /// On to other branches, from y_ at `done` s in the stretch.
  void take_turns(double done, double stretch, bool accepted) {
    bool changed = false, turned = false;
    for (std::size_t l = 0; l < turns_.size(); ++l) {
      FollowedLoop& loop = equations_.loops()[l];
      turned = turned || (accepted && turns_[l].met.turned);
      changed |= loop.path.go_on(turns_[l].met, loop.along, accepted, y_[loop.place]);
      if (accepted) turns_[l].at_start(loop);
    }
    if (turned) next_ = std::max(next_, kAfterTurn * stretch);
    if (changed) begin(done);
  }

  /// What a try meets of a loop.
  struct Turn {
    LoopPath<LawLoopKind>::Met met;
    double along = 0, steep = 1;  ///< at y_
    double early = 0, late = 0;   ///< along the branch within the try, m/s
    void at_start(const FollowedLoop& loop) {
      along = loop.along;
      steep = loop.steep;
    }
  };
  /// The stages that stand where LoopPath wants to know the speed.
  static constexpr std::size_t kEarly = 2, kLate = 3;
  static_assert(Method::kAt[kEarly] == LoopPath<LawLoopKind>::kEarly &&
                Method::kAt[kLate] == LoopPath<LawLoopKind>::kLate);
  /// Of a stretch: the shortest step to a turn of a loop, and the first one after it.
  static constexpr double kNearTurn = 1.0 / 65536, kAfterTurn = 0.2;

  PlantEquations equations_;
  IntegratorOptions options_;
  std::size_t size_;
  std::vector<double> y_, trial_, end_;
  std::vector<double> k_;    ///< slopes, stage by stage; the first is that of y_
  std::vector<Turn> turns_;  ///< one per loop of the equations
  double next_ = 0;          ///< s, the length to try next
};

}  // namespace

std::unique_ptr<StepMethod> make_explicit_steps(const PlantForces& forces,
                                                const IntegratorOptions& options,
                                                const PlantState& start) {
  return std::make_unique<ExplicitSteps>(forces, options, start);
}

}  // namespace dashpot
