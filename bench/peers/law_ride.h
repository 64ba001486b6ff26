#pragma once
#include <cstring>

#include "dashpot/damper/law_list.h"
#include "dashpot/damper/laws/arctan.h"
#include "dashpot/damper/laws/bingham.h"
#include "dashpot/damper/laws/biviscous.h"
#include "dashpot/damper/laws/bouc_wen.h"
#include "dashpot/damper/laws/chebyshev.h"
#include "dashpot/damper/laws/compressible_chambers.h"
#include "dashpot/damper/laws/dahl.h"
#include "dashpot/damper/laws/elastoplastic.h"
#include "dashpot/damper/laws/extended_bingham.h"
#include "dashpot/damper/laws/field_chain.h"
#include "dashpot/damper/laws/hysteretic_biviscous.h"
#include "dashpot/damper/laws/landau_surrogate.h"
#include "dashpot/damper/laws/large_scale_bouc_wen.h"
#include "dashpot/damper/laws/lookup_map.h"
#include "dashpot/damper/laws/modified_bouc_wen.h"
#include "dashpot/damper/laws/modified_lugre.h"
#include "dashpot/damper/laws/normalised_bouc_wen.h"
#include "dashpot/damper/laws/plate_bingham.h"
#include "dashpot/damper/laws/plate_bingham_mixed.h"
#include "dashpot/damper/laws/plate_bingham_shear.h"
#include "dashpot/damper/laws/plate_herschel_bulkley.h"
#include "dashpot/damper/laws/polynomial.h"
#include "dashpot/damper/laws/semi_phenomenological.h"
#include "dashpot/damper/laws/sigmoid.h"
#include "dashpot/damper/laws/tanh_acceleration.h"
#include "dashpot/damper/laws/tanh_guo.h"
#include "dashpot/damper/laws/tanh_kwok.h"
#include "dashpot/damper/laws/viscous_dahl.h"
#include "dashpot/suspension/dampers/damper_words.h"
#include "dashpot/suspension/dampers/soft_friction.h"
#include "ride_case.h"

// Any law that ships in the ride's quarter car: as a damper for simulate(), and as equations for a
// general integrator, with the law's own text compiled in.
namespace peer {

struct LawRide {
  std::string name;
  std::shared_ptr<const dashpot::LawModel> law;  ///< without the coil's lag, no force at rest
  dashpot::MountedDamper mounted;                ///< the same as simulate() has it
  bool soft_velocity = false, soft_displacement = false;  ///< where its force would jump
};

/// The law of a published set, or that of this name with its table's example, each parameter
/// following the current as it does by default.
inline LawRide law_ride(const std::string& name) {
  using namespace dashpot;
  LawRide ride{.name = name};
  double low = 0, high = 2, lag_rate = 0;
  const Law* law = nullptr;
  Dependence parameters;
  if (is_own_law(name)) {
    law = &find_law(name);
    for (const ParamInfo& info : law->params) {
      parameters.forms.push_back(info.form);
      parameters.coefficients.emplace_back(coefficient_count(info.form), 0.2 * info.value).front() =
          info.value;
      if (info.fit == Fit::Drive) parameters.coefficients.back() = {0, 1};
    }
  } else {
    const ParameterSet set = load_parameter_set(name);
    law = &set.model.law();
    parameters = set.model.parameters();
    low = set.drive_min;
    high = std::max(set.drive_max, low + 1e-3);
    lag_rate = set.model.lag_rate();
  }

  // Friction sets in over 2 mm/s, as choose_damper() has it.
  for (std::size_t k = 0; k < law->params.size(); ++k)
    if (law->params[k].name == "v_s" && parameters.coefficients[k] == std::vector{0.0})
      parameters.coefficients[k] = {kFrictionSpeed};
  const LawModel bare(*law, parameters, DriveUnit::Ampere, 0);
  const auto centred = bare.with_offset(-force_at_rest(bare, low));
  ride.law = std::make_shared<LawModel>(dynamic_cast<const LawModel&>(*centred));
  ride.mounted.model = ride.law;
  ride.soft_velocity = jumps_at_rest(*ride.law, low, high);
  if (ride.soft_velocity) ride.mounted.model = with_soft_friction(ride.mounted.model);
  ride.soft_displacement = jumps_in_middle(*ride.mounted.model, low, high);
  if (ride.soft_displacement) ride.mounted.model = with_soft_sides(ride.mounted.model);

  // As strong as this vehicle's damper would be.
  constexpr double kDamping = 1500;  // N*s/m at half its current
  ride.mounted.force_factor =
      kDamping / equivalent_damping(*ride.mounted.model, 0.5 * (low + high), 0.02, 0.2);
  ride.mounted.driver = {.current_min = low, .current_max = high, .lag_rate = lag_rate};
  ride.mounted.current = low;
  return ride;
}

class LawEquations;
/// dy/dt of a vehicle with one law: y = body, wheel, their speeds, the law's states, the coil's
/// current where it lags.
using LawRates = void(const LawEquations& equations, double t, const double* y, double* dy);
LawRates* rates_of(std::string_view law);

class LawEquations {
 public:
  explicit LawEquations(const LawRide& ride)
      : soft_velocity(ride.soft_velocity),
        soft_displacement(ride.soft_displacement),
        lag_rate(ride.mounted.driver.lag_rate),
        factor(ride.mounted.force_factor),
        heights(ride_road(0).tracks[0]),
        command(ride.mounted.current),
        law_(*ride.law),
        driver_(ride.mounted.driver),
        rates_(rates_of(law_.law().name)) {
    start.resize(4 + law_.law().states.size());
    law_.rest({0, 0, command}, {start.data() + 4, start.size() - 4});
    if (lag_rate > 0) start.push_back(command);
    for (std::size_t k = 0; k < law_.law().params.size(); ++k)
      if (law_.parameters().forms[k] != dashpot::Form::Constant) following_.push_back(k);
    law_.parameters_at(command, parameters.data());
  }

  std::size_t size() const { return start.size(); }
  void derivative(double t, const double* y, double* dy) const { rates_(*this, t, y, dy); }
  /// Of RideEquations the same.
  std::array<double, 4> sample(const double* y) const { return {y[0], y[1], y[2], y[3]}; }
  bool control(const double* y, const double* dy) {
    const double before = command;
    command = is_hard(y[2], dy[2]) ? driver_.current_max : driver_.current_min;
    if (command != before && lag_rate == 0) set_current(command);
    return command != before;
  }
  /// Those parameters that follow the current.
  void set_current(double current) const {
    for (const std::size_t k : following_) parameters[k] = law_.parameters().at(k, current);
  }

  const bool soft_velocity, soft_displacement;
  const double lag_rate, factor;
  const std::vector<double> heights;
  std::vector<double> start;
  double command;
  mutable std::array<double, dashpot::kMaxParams> parameters{};

 private:
  const dashpot::LawModel& law_;
  dashpot::DriverOptions driver_;
  LawRates* rates_;
  std::vector<std::size_t> following_;
};

template <class P, auto Force, auto Derivative, std::size_t kStates>
void law_rates(const LawEquations& of, double t, const double* y, double* dy) {
  const double x = y[0] - y[1], v = y[2] - y[3], *z = y + 4;
  if (of.lag_rate > 0) {
    of.set_current(z[kStates]);
    dy[4 + kStates] = of.lag_rate * (of.command - z[kStates]);
  }
  const P p = dashpot::detail::from_array<P>(of.parameters.data());
  if constexpr (kStates > 0) Derivative(&p, x, v, z, dy + 4);

  // The force, a straight line where it would jump.
  const auto between = [](double at, double reach, auto force) {
    if (std::abs(at) >= reach) return force(at);
    const double before = force(-reach);
    return before + (0.5 + 0.5 * at / reach) * (force(reach) - before);
  };
  const auto by_speed = [&](double place) {
    const auto at = [&](double speed) { return Force(&p, place, speed, z); };
    return of.soft_velocity ? between(v, dashpot::kFrictionSpeed, at) : at(v);
  };
  const double force =
      of.factor * (of.soft_displacement ? between(x, dashpot::kSideWay, by_speed) : by_speed(x));

  const double spring = kSpring * x + force;
  dy[0] = y[2];
  dy[1] = y[3];
  dy[2] = -spring * (1 / kBody);
  dy[3] = (spring - kTyre * (y[1] - road_at(of.heights, t))) * (1 / kWheel);
}

inline LawRates* rates_of(std::string_view law) {
#define PEER_FORCE(Name, name) {#name, law_rates<Name, name##_force, nullptr, 0>}
#define PEER_STATES(Name, name, states)                             \
  {                                                                 \
    #name, law_rates<Name, name##_force, name##_derivative, states> \
  }
  static const std::map<std::string_view, LawRates*> known{
      PEER_STATES(Arctan, arctan, 1),
      PEER_FORCE(Bingham, bingham),
      PEER_FORCE(Biviscous, biviscous),
      PEER_STATES(BoucWen, bouc_wen, 1),
      PEER_FORCE(Chebyshev, chebyshev),
      PEER_STATES(CompressibleChambers, compressible_chambers, 1),
      PEER_STATES(Dahl, dahl, 1),
      PEER_STATES(Elastoplastic, elastoplastic, 1),
      PEER_STATES(ExtendedBingham, extended_bingham, 2),
      PEER_FORCE(FieldChain, field_chain),
      PEER_STATES(HystereticBiviscous, hysteretic_biviscous, 1),
      PEER_STATES(LandauSurrogate, landau_surrogate, 1),
      PEER_STATES(LargeScaleBoucWen, large_scale_bouc_wen, 2),
      PEER_FORCE(LookupMap, lookup_map),
      PEER_STATES(ModifiedBoucWen, modified_bouc_wen, 2),
      PEER_STATES(ModifiedLugre, modified_lugre, 1),
      PEER_STATES(NormalisedBoucWen, normalised_bouc_wen, 1),
      PEER_FORCE(PlateBingham, plate_bingham),
      PEER_FORCE(PlateBinghamMixed, plate_bingham_mixed),
      PEER_FORCE(PlateBinghamShear, plate_bingham_shear),
      PEER_FORCE(PlateHerschelBulkley, plate_herschel_bulkley),
      PEER_STATES(Polynomial, polynomial, 1),
      PEER_FORCE(SemiPhenomenological, semi_phenomenological),
      PEER_STATES(Sigmoid, sigmoid, 1),
      PEER_STATES(TanhAcceleration, tanh_acceleration, 1),
      PEER_FORCE(TanhGuo, tanh_guo),
      PEER_FORCE(TanhKwok, tanh_kwok),
      PEER_STATES(ViscousDahl, viscous_dahl, 1),
  };
#undef PEER_FORCE
#undef PEER_STATES
  return known.at(law);
}

}  // namespace peer
