#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "dashpot/suspension/steps/plant_equations.h"
#include "dashpot/suspension/steps/runge_kutta.h"
#include "dashpot/suspension/steps/step_control.h"

namespace dashpot {
namespace {

/// The sum of a stage's weights, those that are not 0, times what slope_of(stage) is.
template <class Method, std::size_t kStage, class SlopeOf>
[[gnu::always_inline]] inline auto weighted(SlopeOf slope_of) {
  constexpr const auto& kRow = Method::kFrom[kStage];
  constexpr std::size_t kCount = kStage - std::count(kRow, kRow + kStage, 0.0);
  constexpr auto kPlaces = [] {
    std::array<std::size_t, kCount> places{};
    std::size_t next = 0;
    for (std::size_t k = 0; k < kStage; ++k)
      if (kRow[k] != 0) places[next++] = k;
    return places;
  }();
  return [&]<std::size_t... k>(std::index_sequence<k...>) __attribute__((always_inline)) {
    return ((kRow[kPlaces[k]] * slope_of(kPlaces[k])) + ...);
  }(std::make_index_sequence<kCount>());
}

/// The instants within a step at which a method's stages stand, in shares of the step, each once.
template <class Method>
struct Instants {
  static constexpr std::size_t of(std::size_t stage) {
    std::size_t instant = 0;
    for (std::size_t s = 2; s <= stage; ++s) instant += Method::kAt[s] != Method::kAt[s - 1];
    return instant;
  }
  static constexpr std::size_t kCount = of(Method::kStages - 1) + 1;
  static_assert(kCount <= PlantEquations::kInstants);
};

/// A stretch is tried in one step of order 4 (ClassicalRungeKutta), which is two thirds of the
/// work; where its error is too great, or a loop is followed, it goes by steps of order 5
/// (DormandPrince).
///
/// Between refresh() and the end of a stretch the first slope is that of y_: the last stage of
/// either method gives it.
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
    equations_.read_currents(state);
    const bool light = turns_.empty() && go_lightly(length);
    if (!light && !go(length)) return false;
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

  /// A stretch of this length, s, in one step of order 4. False where it is not tried, or misses
  /// its share of the tolerance: y_ is then as it was.
  bool go_lightly(double length) {
    if (wait_ > 0) {
      --wait_;
      return false;
    }
    attempt<ClassicalRungeKutta>(0, length);
    const bool taken = distance(length) <= kLightShare;

    // Where it fails again and again it is tried after ever more stretches.
    waits_ = taken ? std::max(waits_ / 2, 1) : std::min(2 * waits_, kMostWaits);
    if (taken)
      take_step(0, length);
    else
      wait_ = waits_;
    return taken;
  }
  /// A stretch of this length, s, in steps of order 5. False where y_ is no longer finite.
  bool go(double length) {
    // The whole stretch is tried first; later ones start with the length that the last one
    // proposed.
    if (next_ == 0) next_ = length;
    Allowance least(length);
    for (double done = 0; done < length;) {
      // One step, to the end of the stretch at most, and the length that its error allows.
      const bool last = done + next_ >= length * (1 - 1e-12);
      const double h = last ? length - done : next_;
      attempt<DormandPrince>(done, h);
      const double error = distance(h);
      const bool bad = !(error <= 1), keeps = last && !bad;
      if (!keeps || !is_longer(next_, h, error)) {
        const double wanted = h * step_factor(error, DormandPrince::kPower);
        next_ = keeps ? std::max(next_, wanted) : wanted;
      }
      next_ = std::max(next_, least.shortest());
      if (!std::isnan(error)) {
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
      done = last ? length : done + h;
      take_step(done, length);
    }
    return true;
  }
  /// The last try is taken, to `done` s in the stretch: its last slope is the first of the next
  /// one.
  void take_step(double done, double stretch) {
    ++counts_.steps;
    std::swap(y_, end_);
    std::swap(k_.front(), k_.back());
    take_turns(done, stretch, true);
  }

  /// The first slope, at y_.
  void begin(double done) {
    ++counts_.evaluations;
    equations_.rates(done, y_.data(), k_[0].data());
    for (std::size_t l = 0; l < turns_.size(); ++l) turns_[l].at_start(equations_.loops()[l]);
  }
  /// The speed along each loop at a stage that LoopPath wants to know of.
  template <std::size_t kStage>
  void note_speeds() {
    if constexpr (kStage == kEarly || kStage == kLate)
      for (std::size_t l = 0; l < turns_.size(); ++l)
        (kStage == kEarly ? turns_[l].early : turns_[l].late) = equations_.loops()[l].along;
  }
  /// end_ and the slope there, from y_ at `done` s in the stretch.
  template <class Method>
  void attempt(double done, double h) {
    std::array<double, Instants<Method>::kCount> after;
    for (std::size_t s = 1; s < Method::kStages; ++s)
      after[Instants<Method>::of(s)] = done + Method::kAt[s] * h;
    equations_.look_ahead(after);
    counts_.evaluations += Method::kStages - 1;

    // A RoadCar's stages are straight code.
    if constexpr (kSize > 0) {
      const RoadCar& car = *equations_.road_car();
      constexpr bool kMayFollow = std::is_same_v<Method, DormandPrince>;
      if (kMayFollow && !turns_.empty())
        attempt_straight<Method, kMayFollow>(car, h);
      else
        attempt_straight<Method, false>(car, h);
    } else {
      attempt_any<Method>(h);
    }
  }
  template <class Method>
  void attempt_any(double h) {
    // The slope of the last stage stands in the last place, whatever the method.
    const auto slope = [&](std::size_t stage) -> Row& {
      return stage + 1 == Method::kStages ? k_.back() : k_[stage];
    };
    each_stage<Method>([&]<std::size_t kStage>() {
      Row& at = kStage + 1 == Method::kStages ? end_ : trial_;
      for (std::size_t i = 0; i < size_; ++i)
        at[i] =
            y_[i] + h * weighted<Method, kStage>([&](std::size_t stage) { return k_[stage][i]; });
      equations_.rates_at(Instants<Method>::of(kStage), at.data(), slope(kStage).data());
      note_speeds<kStage>();
    });
    for (std::size_t i = 0; i < size_; ++i)
      off_[i] = error_of<Method>([&](std::size_t stage) { return slope(stage)[i]; });
  }
  /// The same of a RoadCar, whose slopes stay in one place from stage to stage.
  template <class Method, bool kFollows>
  [[gnu::flatten]] void attempt_straight(const RoadCar& car, double h) {
    using State = RoadCar::State<kSize - 4>;
    State k[Method::kStages], y, at;
    RoadCar::Forces forces;
    y.get(y_.data());
    k[0].get(k_[0].data());

    // Stage by stage: there from the slopes before, and the slope there.
    each_stage<Method>([&]<std::size_t kStage>() __attribute__((always_inline)) {
      constexpr std::size_t kInstant = Instants<Method>::of(kStage);
      const auto sum = [&](auto part) __attribute__((always_inline)) {
        return part(y) + h * weighted<Method, kStage>([&](std::size_t s) { return part(k[s]); });
      };
      at.heights = sum([](const State& of) { return of.heights; });
      at.speeds = sum([](const State& of) { return of.speeds; });
      for (std::size_t i = 0; i < kSize - 4; ++i)
        at.law[i] = sum([i](const State& of) { return of.law[i]; });
      forces = car.rates<kFollows>(equations_.law_parameters(kInstant), equations_.foot(kInstant),
                                   at, k[kStage]);
      if constexpr (kFollows) note_speeds<kStage>();
    });

    // Its end, and what the next step wants to know.
    at.put(end_.data());
    k[Method::kStages - 1].put(k_.back().data());
    State off;
    off.heights = error_of<Method>([&](std::size_t s) { return k[s].heights; });
    off.speeds = error_of<Method>([&](std::size_t s) { return k[s].speeds; });
    for (std::size_t i = 0; i < kSize - 4; ++i)
      off.law[i] = error_of<Method>([&](std::size_t s) { return k[s].law[i]; });
    off.put(off_.data());
    equations_.put_forces(forces);
  }
  /// do_stage<1>(), then <2>() and so on to the last stage.
  template <class Method, class DoStage>
  [[gnu::always_inline]] static inline void each_stage(DoStage do_stage) {
    [&]<std::size_t... k>(std::index_sequence<k...>) __attribute__((always_inline)) {
      (do_stage.template operator()<k + 1>(), ...);
    }(std::make_index_sequence<Method::kStages - 1>());
  }
  /// The difference of a method's two solutions over h, from slope_of(stage).
  template <class Method, class SlopeOf>
  [[gnu::always_inline]] static inline auto error_of(SlopeOf slope_of) {
    constexpr std::size_t kFirst =
        std::find_if(Method::kError, std::end(Method::kError), [](double e) { return e != 0; }) -
        Method::kError;
    auto sum = Method::kError[kFirst] * slope_of(kFirst);
    for (std::size_t s = kFirst + 1; s < Method::kStages; ++s)
      if (Method::kError[s] != 0) sum += Method::kError[s] * slope_of(s);
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
  /// The stages of order 5 that stand where LoopPath wants to know the speed.
  static constexpr std::size_t kEarly = 2, kLate = 3;
  static_assert(DormandPrince::kAt[kEarly] == LoopPath<LawLoopKind>::kEarly &&
                DormandPrince::kAt[kLate] == LoopPath<LawLoopKind>::kLate);
  /// Of a stretch: the shortest step to a turn of a loop, and the first one after it.
  static constexpr double kNearTurn = 1.0 / 65536, kAfterTurn = 0.2;

  /// Of the tolerance, what a step of order 4 may take: it sees less than one of order 5 of a force
  /// that bends within the step.
  static constexpr double kLightShare = 0.3;
  static constexpr int kMostWaits = 64;  ///< stretches

  PlantEquations equations_;
  IntegratorOptions options_;
  std::size_t size_;
  Row y_, trial_, end_, off_;  ///< off_: error_of() the last try
  /// Slopes, stage by stage; the first is that of y_, the last one that at the end of the last try.
  std::array<Row, DormandPrince::kStages> k_;
  std::vector<Turn> turns_;  ///< one per loop of the equations
  double next_ = 0;          ///< s, the length of order 5 to try next
  int wait_ = 0;             ///< stretches until order 4 is tried again
  int waits_ = 1;            ///< and how many there would be after another failure
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
