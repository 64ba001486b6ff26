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
///
/// kSize: of y where the equations are those of a RoadCar, whose step is straight code; 0: any.
template <std::size_t kSize>
class ExplicitSteps final : public StepMethod {
 public:
  ExplicitSteps(const PlantForces& forces, const IntegratorOptions& options,
                const PlantState& start)
      : equations_(forces, start),
        options_(options),
        size_(equations_.size()),
        y_(row(size_)),
        trial_(row(size_)),
        end_(row(size_)),
        off_(row(size_)) {
    for (Row& slope : k_) slope = row(size_);
    equations_.follow_loops(start, options);
    turns_.resize(equations_.loops().size());
  }

  void refresh(PlantState& state) override {
    equations_.read(state, y_.data());
    begin(0);
    equations_.write_forces(k_[0].data(), state);
  }

  bool advance(PlantState& state, double end) override {
    const double length = end - state.time;
    if (!(length > 0)) return true;

    // The whole stretch is tried first; later ones start with the length that the last one
    // proposed.
    if (next_ == 0) next_ = length;
    equations_.read_currents(state);
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
      std::swap(k_.front(), k_.back());
      done = last ? length : done + h;
      if (!turns_.empty()) take_turns(done, length, true);
    }
    equations_.write(y_.data(), k_[0].data(), end, state);
    return true;
  }

 private:
  using Row = std::conditional_t<(kSize > 0), std::array<double, kSize>, std::vector<double>>;
  static Row row(std::size_t size) {
    if constexpr (kSize > 0)
      return {};
    else
      return Row(size);
  }

  /// The first slope, at y_.
  void begin(double done) {
    ++counts_.evaluations;
    equations_.rates(done, y_.data(), k_[0].data());
    for (std::size_t l = 0; l < turns_.size(); ++l) turns_[l].at_start(equations_.loops()[l]);
  }
  /// out = y + h (weights . slopes of the stages before).
  template <std::size_t... kBefore>
  void sum(Row& out, double h, const double* weights, std::index_sequence<kBefore...>) const {
    for (std::size_t i = 0; i < size_; ++i)
      out[i] = y_[i] + h * ((weights[kBefore] * k_[kBefore][i]) + ...);
  }
  /// Which of the instants ahead a stage stands at: the last two at the end of the step.
  static constexpr std::size_t instant_of(std::size_t stage) {
    return std::min(stage, PlantEquations::kInstants) - 1;
  }
  static_assert(PlantEquations::kInstants == kStages - 2 &&
                Method::kAt[kStages - 1] == Method::kAt[kStages - 2]);
  template <std::size_t kStage>
  void stage(double h, Row& at) {
    sum(at, h, Method::kFrom[kStage], std::make_index_sequence<kStage>());
    equations_.rates_at(instant_of(kStage), at.data(), k_[kStage].data());
    if constexpr (kStage == kEarly || kStage == kLate) note_speeds(kStage);
  }
  /// Of each loop, at a stage that meet_turns() wants to know of.
  void note_speeds(std::size_t stage) {
    for (std::size_t l = 0; l < turns_.size(); ++l)
      (stage == kEarly ? turns_[l].early : turns_[l].late) = equations_.loops()[l].along;
  }
  /// end_ and the slope there, from y_ at `done` s in the stretch.
  void attempt(double done, double h) {
    PlantEquations::Instants after;
    for (std::size_t k = 0; k < after.size(); ++k) after[k] = done + Method::kAt[k + 1] * h;
    equations_.look_ahead(after);
    counts_.evaluations += kStages - 1;

    // A RoadCar's stages are straight code.
    if constexpr (kSize > 0) {
      const RoadCar& car = *equations_.road_car();
      turns_.empty() ? attempt_straight<false>(car, h) : attempt_straight<true>(car, h);
    } else {
      stage<1>(h, trial_);
      stage<2>(h, trial_);
      stage<3>(h, trial_);
      stage<4>(h, trial_);
      stage<5>(h, trial_);
      stage<6>(h, end_);
      for (std::size_t i = 0; i < size_; ++i)
        off_[i] = error_of([&](std::size_t s) { return k_[s][i]; });
    }
  }
  /// The same of a RoadCar, whose slopes stay in one place from stage to stage.
  template <bool kFollows>
  [[gnu::flatten]] void attempt_straight(const RoadCar& car, double h) {
    using State = RoadCar::State<kSize - 4>;
    State k[kStages], y, at;
    RoadCar::Forces forces;
    y.get(y_.data());
    k[0].get(k_[0].data());

    // Stage by stage: there from the slopes before, and the slope there.
    const auto stage = [&]<std::size_t kStage, std::size_t... kBefore>(
                           std::index_sequence<kBefore...>) __attribute__((always_inline)) {
      constexpr const auto& kWeights = Method::kFrom[kStage];
      at.heights = y.heights + h * ((both(kWeights[kBefore]) * k[kBefore].heights) + ...);
      at.speeds = y.speeds + h * ((both(kWeights[kBefore]) * k[kBefore].speeds) + ...);
      for (std::size_t i = 0; i < kSize - 4; ++i)
        at.law[i] = y.law[i] + h * ((kWeights[kBefore] * k[kBefore].law[i]) + ...);
      forces = car.rates<kFollows>(equations_.law_parameters(instant_of(kStage)),
                                   equations_.foot(instant_of(kStage)), at, k[kStage]);
      if constexpr (kFollows && (kStage == kEarly || kStage == kLate)) note_speeds(kStage);
    };
    stage.template operator()<1>(std::index_sequence<0>());
    stage.template operator()<2>(std::index_sequence<0, 1>());
    stage.template operator()<3>(std::index_sequence<0, 1, 2>());
    stage.template operator()<4>(std::index_sequence<0, 1, 2, 3>());
    stage.template operator()<5>(std::index_sequence<0, 1, 2, 3, 4>());
    static_assert(Method::kFrom[6][1] == 0);
    stage.template operator()<6>(std::index_sequence<0, 2, 3, 4, 5>());

    // Its end, and what the next step wants to know.
    at.put(end_.data());
    k[kStages - 1].put(k_[kStages - 1].data());
    State off;
    static_assert(Method::kError[1] == 0);
    off.heights = error_of([&](std::size_t s) { return k[s].heights; });
    off.speeds = error_of([&](std::size_t s) { return k[s].speeds; });
    for (std::size_t i = 0; i < kSize - 4; ++i)
      off.law[i] = error_of([&](std::size_t s) { return k[s].law[i]; });
    off.put(off_.data());
    equations_.put_forces(forces);
  }
  /// The same number for body and wheel.
  static constexpr BodyAndWheel both(double number) { return BodyAndWheel{number, number}; }
  /// (y_5 - y_4) / h from the slopes, slope_of(stage).
  template <class SlopeOf>
  [[gnu::always_inline]] static inline auto error_of(SlopeOf slope_of) {
    auto sum = Method::kError[0] * slope_of(0);
    for (std::size_t s = 2; s < kStages; ++s) sum += Method::kError[s] * slope_of(s);
    return sum;
  }
  /// Error of the step, in tolerances; that of a loop as one of its z.
  double distance(double h) const {
    constexpr std::size_t kRoadCar = QuarterCarSizes::coordinates;
    const std::size_t n = kSize > 0 ? kRoadCar : equations_.coordinates();
    const StepEnds ends{n, y_, end_};
    const auto loop_at = [&](std::size_t k) {
      std::size_t l = 0;
      while (l < turns_.size() && equations_.loops()[l].place != k) ++l;
      return l;
    };

    // The error and the size of each component.
    return error_in_tolerances(
        ends, options_,
        [&](std::size_t k) {
          const double off = h * std::abs(off_[k]);
          const std::size_t l = k < 2 * n ? turns_.size() : loop_at(k);
          if (l == turns_.size()) return off;
          const FollowedLoop& loop = equations_.loops()[l];
          return loop.path.error(off, turns_[l].steep, loop.steep);
        },
        [&](std::size_t k) {
          const std::size_t l = loop_at(k);
          const double size = ends.size(k) + std::abs(h * k_[0][k]);
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
  Row y_, trial_, end_, off_;   ///< off_: (y_5 - y_4) / h of the last try
  std::array<Row, kStages> k_;  ///< slopes, stage by stage; the first is that of y_
  std::vector<Turn> turns_;     ///< one per loop of the equations
  double next_ = 0;             ///< s, the length to try next
};

}  // namespace

std::unique_ptr<StepMethod> make_explicit_steps(const PlantForces& forces,
                                                const IntegratorOptions& options,
                                                const PlantState& start) {
  // A law that ships has two states at most.
  const PlantEquations equations(forces, start);
  switch (equations.road_car() ? equations.size() : 0) {
    case 4:
      return std::make_unique<ExplicitSteps<4>>(forces, options, start);
    case 5:
      return std::make_unique<ExplicitSteps<5>>(forces, options, start);
    case 6:
      return std::make_unique<ExplicitSteps<6>>(forces, options, start);
    default:
      return std::make_unique<ExplicitSteps<0>>(forces, options, start);
  }
}

}  // namespace dashpot
