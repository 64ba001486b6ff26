#pragma once
#include "dashpot/suspension/lanes/simd/quarter_car.h"

namespace dashpot {
namespace {

/// The equations of a vehicle of several struts and tyres in each lane (LaneEquations). Struts and
/// tyres go by their numbers; `Damper` is that of all struts, each with numbers of its own.
template <class Damper>
class CarLanes {
 public:
  static constexpr std::size_t kStates = Damper::kStates;
  static constexpr std::size_t kMostCoordinates = kMostLaneCoordinates,
                               kMostStruts = kMostLaneCorners, kMostTyres = kMostLaneCorners;
  static constexpr std::size_t kMostUnknowns = 2 * kMostCoordinates + kMostStruts * (kStates + 2);

  /// All that changes while a vehicle rides.
  struct State {
    /// q, q', then strut by strut its damper's states and the currents that lag: none; inner;
    /// inner and coil.
    Lane x[kMostUnknowns]{};
    Currents currents[kMostStruts];  ///< at samples
  };

  explicit CarLanes(const LaneRide& ride)
      : ride_(ride),
        equations_(*ride.equations),
        dampers_{made(0), made(1), made(2), made(3)},
        entries_(reinterpret_cast<const Lane*>(ride.numbers)),
        tyres_(reinterpret_cast<const TyreContact<Lane>*>(entries_ + equations_.begins[rows()])),
        struts_(reinterpret_cast<const StrutNumbers<Lane>*>(tyres_ + tyres())) {
    static_assert(kMostStruts == 4, "as many dampers as are made here");
  }

  std::size_t coordinates() const { return equations_.coordinates; }
  std::size_t struts() const { return equations_.struts; }
  std::size_t tyres() const { return equations_.tyres; }
  std::size_t lags() const { return ride_.lags; }
  /// Where the unknowns of a strut stand in State::x; of one more than there are: their number.
  std::size_t place_of(std::size_t strut) const {
    return 2 * coordinates() + strut * (kStates + lags());
  }

  static Currents& currents(State& state, std::size_t strut) { return state.currents[strut]; }
  Lane* damper_states(State& state, std::size_t strut) const { return state.x + place_of(strut); }
  Damper& damper_of(std::size_t strut) { return dampers_[strut]; }
  const StrutNumbers<Lane>& strut(std::size_t strut) const { return struts_[strut]; }
  const TyreContact<Lane>& tyre(std::size_t tyre) const { return tyres_[tyre]; }
  /// The current that drives the damper.
  Lane driving(const Currents& currents) const {
    return lags() > 0 ? currents.inner : currents.coil;
  }

  /// q'' of a coordinate, from [q, q', forces of the struts, pushes of the road].
  Lane acceleration(std::size_t coordinate, const Lane* from) const {
    return product(coordinate, from);
  }
  /// Of heights, or of their rates.
  Lane deflection(const Lane* of, std::size_t strut) const {
    return product(coordinates() + strut, of);
  }
  Lane upper_end(const Lane* of, std::size_t strut) const {
    return product(coordinates() + struts() + strut, of);
  }
  Lane lower_end(const Lane* of, std::size_t strut) const {
    return upper_end(of, strut) - deflection(of, strut);
  }
  Lane wheel(const Lane* of, std::size_t tyre) const {
    return product(coordinates() + 2 * struts() + tyre, of);
  }

  /// Friction and stops of a strut, N.
  Lane strut_extra(std::size_t strut, Lane deflection, Lane speed) const {
    if (!ride_.resists_more) return Lane{};
    const StrutNumbers<Lane>& numbers = struts_[strut];
    return strut_resistance(numbers.resistance, deflection, tanh(numbers.friction_slope * speed));
  }
  /// Load of a tyre on the road under this push, N.
  Lane load_on_road(const Lane* x, Lane pushed, std::size_t tyre) const {
    return tyre_load(tyres_[tyre], pushed, wheel(x, tyre), wheel(x + coordinates(), tyre));
  }
  /// The part of the road's push that reaches the wheel, N.
  Lane push_at_wheel(const Lane* x, Lane pushed, std::size_t tyre) const {
    if (!ride_.resists_more) return pushed;
    return push_on_wheel(tyres_[tyre], pushed, load_on_road(x, pushed, tyre));
  }

  /// Not finite where some of the motion is not.
  Lane sum_of(const Lane* x) const {
    Lane sum{};
    for (std::size_t k = 0; k < 2 * coordinates(); ++k) sum += x[k];
    return sum;
  }

 private:
  /// That of a strut; of one that there is not, the last one's once more.
  Damper made(std::size_t strut) const {
    return Damper(ride_, strut < struts() ? strut : struts() - 1);
  }
  std::size_t rows() const { return coordinates() + 2 * struts() + tyres(); }
  [[gnu::always_inline]] Lane product(std::size_t row, const Lane* with) const {
    Lane sum{};
    for (std::size_t k = equations_.begins[row]; k < equations_.begins[row + 1]; ++k)
      sum += entries_[k] * with[equations_.columns[k]];
    return sum;
  }

  const LaneRide& ride_;
  const LaneEquations& equations_;
  Damper dampers_[kMostStruts];
  const Lane* entries_;
  const TyreContact<Lane>* tyres_;
  const StrutNumbers<Lane>* struts_;
};

}  // namespace
}  // namespace dashpot
