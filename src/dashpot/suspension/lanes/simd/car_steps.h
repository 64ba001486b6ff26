#pragma once
#include <utility>

#include "dashpot/suspension/lanes/simd/car.h"
#include "dashpot/suspension/steps/runge_kutta.h"

namespace dashpot {
namespace {

/// AdaptiveSteps for a vehicle of several struts: the same method, error and lengths of steps, in
/// loops over coordinates and struts whose numbers are the ride's, not the compiler's. The unknowns
/// are CarLanes::State::x. Of heights, and of speeds, the greatest error is measured against the
/// greatest of them, whatever their units, as simulate() does.
template <class Damper>
class CarSteps {
  using Car = CarLanes<Damper>;
  using State = typename Car::State;
  using Loop = typename Damper::Loop;
  static constexpr std::size_t kStates = Damper::kStates, kStruts = Car::kMostStruts;
  /// y' and, by the way, of each strut:
  struct Slope {
    Lane d[Car::kMostUnknowns];
    Lane force[kStruts];  ///< N, of the damper
    Lane along[kStruts];  ///< m/s, along the branch of its loop, and
    Lane steep[kStruts];  ///< how steep the loop's r is there (LoopPath)
  };

 public:
  CarSteps(const LaneRide& ride, Car& car)
      : ride_(ride), car_(car), size_(car.place_of(car.struts())), next_(all(ride.sample_time)) {}

  /// Before all else: currents and the loops' states as the steps have them.
  void begin(State& state) {
    for (std::size_t s = 0; s < car_.struts(); ++s) {
      Lane* own = car_.damper_states(state, s);
      if constexpr (Loop::kExists) looped(own) = car_.damper_of(s).loop.folded(looped(own));
      if (car_.lags() > 0) own[kStates] = state.currents[s].inner;
      if (car_.lags() > 1) own[kStates + 1] = state.currents[s].coil;
    }
  }
  /// Forces at the start of a sample, after a command has changed in some lanes.
  void refresh(const State& state, const Lane* commands, LaneMask changed, const RoadPush* roads) {
    slope(state.x, commands, roads, Lane{}, last());
    keep(last(), changed);
  }
  /// At the present state: a damper's force, N, and the accelerations of the coordinates.
  Lane force(std::size_t strut) const { return first().force[strut]; }
  const Lane* acceleration() const { return first().d + car_.coordinates(); }

  /// Tries one step in these lanes. Returns those that have reached the end of their sample.
  LaneMask step(State& state, const Lane* commands, const RoadPush* roads, LaneMask riding) {
    // As long as was proposed, or as much as is left of the sample.
    const double whole = ride_.sample_time, least = whole / 256;
    const Lane left = whole - done_;
    const LaneMask ends = next_ >= left;
    const Lane h = ends ? left : next_;
    const Lane error = attempt(state.x, h, commands, roads, done_ / whole);
    LaneMask accepted = riding & ((error <= 1) | (h <= least) | (error != error));
    const Turns turns = meet_turns(h);
    accepted &= ~turns.over;

    // Where it is accepted, its end becomes the state. A NaN is accepted: the run finds it.
    missed |= accepted & !(error <= 1);
    for (std::size_t k = 0; k < size_; ++k) state.x[k] = accepted ? end_[k] : state.x[k];
    keep(last(), accepted);
    steps += accepted ? all(1) : Lane{};

    // The next length. A step that was cut short by the sample's end does not shorten it.
    const Lane factor = fmin(fmax(0.9 * about_fifth_root_below(fmax(error, 1e-5)), 0.2), 5);
    const Lane proposed = fmin(fmax(h * factor, least), whole);
    next_ = riding ? (accepted & ends ? fmax(next_, proposed) : proposed) : next_;
    done_ = accepted ? (ends ? Lane{} : done_ + h) : done_;
    const LaneMask arrived = accepted & ends;
    if constexpr (Loop::kExists) {
      next_ = (riding & turns.over) ? turns.until : next_;
      next_ = (accepted & turns.turned) ? fmax(next_, kAfterTurn * whole) : next_;
      take_turns(turns, state, commands, roads, accepted, arrived ? all(1) : done_ / whole);
    }
    read_currents(state);
    return arrived;
  }

  LaneMask missed{};  ///< lanes in which some step missed the tolerance
  Lane steps{};       ///< accepted in each lane

 private:
  /// What a try has met of all loops together, and of each.
  struct Turns {
    LaneMask over{};    ///< some motion turned within it: it must end there
    LaneMask turned{};  ///< its end is where some motion turns
    Lane until{};       ///< s, the length at which the first of them turns
    typename Loop::Met each[kStruts];
  };

  Slope& first() { return slopes_[0]; }
  const Slope& first() const { return slopes_[0]; }
  Slope& last() { return slopes_[DormandPrince::kStages - 1]; }
  /// The state of a damper's loop among its states.
  static Lane& looped(Lane* z) { return z[Damper::LoopOfLaw::kState]; }

  /// y' of a state under these commands, A, at this share of the sample. Kept out of line: inlined
  /// copies may round differently.
  [[gnu::noinline, gnu::flatten]] void slope(const Lane* x, const Lane* commands,
                                             const RoadPush* roads, Lane share, Slope& out) {
    const std::size_t n = car_.coordinates(), struts = car_.struts(), tyres = car_.tyres();
    const Lane* v = x + n;

    // What accelerates the coordinates: the motion itself,
    Lane causes[LaneEquations::kMostColumns];
    for (std::size_t k = 0; k < 2 * n; ++k) causes[k] = x[k];
    for (std::size_t k = 0; k < n; ++k) out.d[k] = v[k];

    // the struts, while their dampers' states move on,
    for (std::size_t s = 0; s < struts; ++s) {
      const Lane *own = x + car_.place_of(s), deflection = car_.deflection(x, s),
                 speed = car_.deflection(v, s);
      Lane* rates = out.d + car_.place_of(s);
      if (car_.lags() > 0) follow_currents(s, commands[s], own + kStates, rates + kStates);

      causes[2 * n + s] =
          respond(s, deflection, speed, own, rates, out) + car_.strut_extra(s, deflection, speed);
    }

    // and the road.
    for (std::size_t w = 0; w < tyres; ++w)
      causes[2 * n + struts + w] = car_.push_at_wheel(x, roads[w].at(share), w);
    for (std::size_t k = 0; k < n; ++k) out.d[n + k] = car_.acceleration(k, causes);
  }
  /// The force of a damper, N, and the rates of its states.
  [[gnu::always_inline]] Lane respond(std::size_t s, Lane deflection, Lane speed, const Lane* own,
                                      Lane* rates, Slope& out) {
    // The damper's states as its law has them.
    Damper& damper = car_.damper_of(s);
    Lane z[kStates + 1];
    for (std::size_t k = 0; k < kStates; ++k) z[k] = own[k];
    [[maybe_unused]] typename Loop::Place place;
    if constexpr (Loop::kExists) {
      place = damper.loop.place(looped(z));
      looped(z) = damper.loop.unfolded(place);
    }

    out.force[s] = damper.force(deflection, speed, z);
    damper.derivative(deflection, speed, z, rates);
    if constexpr (Loop::kExists) {
      out.along[s] = damper.loop.along(Damper::LoopOfLaw::travel(speed, rates));
      out.steep[s] = place.steep;
      looped(rates) = damper.loop.folded_rate(looped(rates), out.along[s], place);
    }
    return out.force[s];
  }
  /// First-order lags on the way from the command to the current that drives the damper, which
  /// takes it over.
  [[gnu::always_inline]] void follow_currents(std::size_t s, Lane command, const Lane* currents,
                                              Lane* rates) {
    const StrutNumbers<Lane>& strut = car_.strut(s);
    car_.damper_of(s).set_current(currents[0]);
    if (car_.lags() == 1) {
      rates[0] = (strut.driver_lag + strut.model_lag) * (command - currents[0]);
    } else {
      rates[0] = strut.model_lag * (currents[1] - currents[0]);
      rates[1] = strut.driver_lag * (command - currents[1]);
    }
  }
  /// With one lag the coil's current is either the driving one or, where the driver has no lag, the
  /// command.
  void read_currents(State& state) const {
    if (car_.lags() == 0) return;
    for (std::size_t s = 0; s < car_.struts(); ++s) {
      Currents& currents = state.currents[s];
      const Lane* own = state.x + car_.place_of(s) + kStates;
      currents.inner = own[0];
      if (car_.lags() == 1)
        currents.coil = car_.strut(s).driver_lag > 0 ? own[0] : currents.coil;
      else
        currents.coil = own[1];
    }
  }
  void keep(const Slope& fresh, LaneMask which) {
    Slope& kept = first();
    for (std::size_t k = 0; k < size_; ++k) kept.d[k] = which ? fresh.d[k] : kept.d[k];
    for (std::size_t s = 0; s < car_.struts(); ++s) {
      kept.force[s] = which ? fresh.force[s] : kept.force[s];
      if constexpr (Loop::kExists) {
        kept.along[s] = which ? fresh.along[s] : kept.along[s];
        kept.steep[s] = which ? fresh.steep[s] : kept.steep[s];
      }
    }
  }

  /// A row of the tableau; behind the stages', that of the error.
  static constexpr std::size_t kErrorRow = DormandPrince::kStages;
  static constexpr double weight(std::size_t row, std::size_t slope) {
    return row == kErrorRow ? DormandPrince::kError[slope] : DormandPrince::kFrom[row][slope];
  }
  /// The sum of a row's weights times component n of the slopes, without those whose weight is 0.
  template <std::size_t kRow, std::size_t... kSlope>
  [[gnu::always_inline]] Lane weighted(std::size_t n, std::index_sequence<kSlope...>) const {
    Lane sum = weight(kRow, 0) * slopes_[0].d[n];
    (
        [&] {
          if constexpr (kSlope > 0 && weight(kRow, kSlope) != 0)
            sum += weight(kRow, kSlope) * slopes_[kSlope].d[n];
        }(),
        ...);
    return sum;
  }
  /// A stage: where the slopes before it lead to, and the slope there.
  template <std::size_t kStage>
  [[gnu::always_inline]] void take_stage(const Lane* from, Lane h, const Lane* commands,
                                         const RoadPush* roads, Lane begin, Lane* at) {
    for (std::size_t k = 0; k < size_; ++k)
      at[k] = from[k] + h * weighted<kStage>(k, std::make_index_sequence<kStage>());
    const Lane share = h / ride_.sample_time;
    slope(at, commands, roads, begin + DormandPrince::kAt[kStage] * share, slopes_[kStage]);
  }
  /// A step of length h, s, from the share `begin` of the sample on: its end, the slope there
  /// (last()) and, returned, its error in tolerances.
  [[gnu::noinline]] Lane attempt(const Lane* from, Lane h, const Lane* commands,
                                 const RoadPush* roads, Lane begin) {
    take_stage<1>(from, h, commands, roads, begin, trial_);
    take_stage<2>(from, h, commands, roads, begin, trial_);
    take_stage<3>(from, h, commands, roads, begin, trial_);
    take_stage<4>(from, h, commands, roads, begin, trial_);
    take_stage<5>(from, h, commands, roads, begin, trial_);
    take_stage<6>(from, h, commands, roads, begin, end_);
    return distance(from, h);
  }

  /// The error in tolerances. A damper's state, which may pass through 0 while it moves fast, is
  /// measured against its size and how far it moves in the step. Currents are not measured.
  [[gnu::always_inline]] Lane distance(const Lane* from, Lane h) {
    const auto of = [&](Lane error, Lane size) {
      return error / (ride_.absolute_tolerance + ride_.relative_tolerance * size);
    };
    const auto error_of = [&](std::size_t k) {
      return fabs(h * weighted<kErrorRow>(k, std::make_index_sequence<DormandPrince::kStages>()));
    };
    const std::size_t n = car_.coordinates();
    const auto group = [&](std::size_t first) {
      Lane error{}, size{};
      for (std::size_t k = first; k < first + n; ++k) {
        error = fmax(error_of(k), error);
        size = fmax(size, fmax(fabs(from[k]), fabs(end_[k])));
      }
      return of(error, size);
    };

    Lane greatest = fmax(group(0), group(n));
    for (std::size_t s = 0; s < car_.struts(); ++s)
      for (std::size_t k = 0; k < kStates; ++k) {
        const std::size_t at = car_.place_of(s) + k;
        Lane error = error_of(at), size = fabs(from[at]) + fabs(h * first().d[at]);
        if constexpr (Loop::kExists)
          if (k == Damper::LoopOfLaw::kState) {
            const auto& loop = car_.damper_of(s).loop;
            error = loop.error(error, first().steep[s], last().steep[s]);
            size = loop.size(size);
          }
        greatest = fmax(of(error, size), greatest);
      }
    return greatest;
  }

  Turns meet_turns(Lane h) {
    Turns turns;
    turns.until = h;
    if constexpr (Loop::kExists) {
      static_assert(DormandPrince::kAt[2] == Loop::kEarly && DormandPrince::kAt[3] == Loop::kLate);
      const double near = kNearTurn * ride_.sample_time;
      for (std::size_t s = 0; s < car_.struts(); ++s) {
        auto& met = turns.each[s];
        met = car_.damper_of(s).loop.meet(
            {first().along[s], slopes_[2].along[s], slopes_[3].along[s], last().along[s]}, h, near);
        const Lane cut = fmax(met.stuck ? 0.99 * h : met.until, near);
        turns.until = met.over ? fmin(cut, turns.until) : turns.until;
        turns.over |= met.over;
        turns.turned |= met.turned;
      }
    }
    return turns;
  }
  /// On to other branches, at this share of the sample.
  void take_turns(const Turns& turns, State& state, const Lane* commands, const RoadPush* roads,
                  LaneMask accepted, Lane share) {
    LaneMask changed{};
    for (std::size_t s = 0; s < car_.struts(); ++s)
      changed |= car_.damper_of(s).loop.go_on(turns.each[s], first().along[s], accepted,
                                              looped(car_.damper_states(state, s)));
    if (!any(changed)) return;
    slope(state.x, commands, roads, share, last());
    keep(last(), changed);
  }

  /// Of a sample: the shortest step to a turn of a loop, and the first one after it.
  static constexpr double kNearTurn = 1.0 / 65536, kAfterTurn = 0.2;

  const LaneRide& ride_;
  Car& car_;
  std::size_t size_;                        ///< of the unknowns
  Lane next_;                               ///< s, the length to try next
  Lane done_{};                             ///< s of the present sample
  Slope slopes_[DormandPrince::kStages]{};  ///< of the last try; the first is that of the state
  Lane trial_[Car::kMostUnknowns]{}, end_[Car::kMostUnknowns]{};
};

}  // namespace
}  // namespace dashpot
