#include "studies/ride_rank/true_dampers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/value.h"

namespace dashpot {
namespace {

constexpr std::array kTrueDampers{
    TrueDamperParts{.name = "series_spring",
                    .what = "a bent valve behind the spring of the oil",
                    .orifice = 300,
                    .spring = 6e5},
    TrueDamperParts{.name = "asymmetric_valves",
                    .what = "compression at 45 % of rebound, and progressive",
                    .viscous = 700,
                    .orifice = 1500,
                    .compression = 0.45},
    TrueDamperParts{.name = "sticky_seals",
                    .what = "friction of the seals on bristles beside a weak valve",
                    .yield_off = 40,
                    .yield_per_ampere = 250,
                    .friction = 160,
                    .bristle = 3e-4},
    TrueDamperParts{.name = "slow_coil",
                    .what = "the current lags by 25 ms, the oil is soft",
                    .spring = 1.5e6,
                    .coil_lag = 0.025},
    TrueDamperParts{.name = "soft_bushings",
                    .what = "a steep valve on soft bushings, asymmetric",
                    .preyield = 1e5,
                    .compression = 0.7,
                    .spring = 2.5e5},
    TrueDamperParts{.name = "gas_spring",
                    .what = "high gas pressure in a short chamber",
                    .viscous = 1200,
                    .gas = 400,
                    .gas_length = 0.08},
    TrueDamperParts{.name = "bypass",
                    .what = "soft in the middle of the stroke, hard towards its ends",
                    .bypass = 1.2},
    TrueDamperParts{.name = "fading",
                    .what = "loses force as it warms up, sticks a little",
                    .friction = 60,
                    .fading = 0.12},
    TrueDamperParts{.name = "progressive",
                    .what = "an orifice that dominates, saturated coil",
                    .viscous = 250,
                    .orifice = 4000,
                    .saturation = 0.6},
    TrueDamperParts{.name = "digressive",
                    .what = "opens early and wide: nearly dry friction, with bristles",
                    .preyield = 1.5e5,
                    .viscous = 350,
                    .friction = 80,
                    .bristle = 5e-4},
    TrueDamperParts{.name = "everything",
                    .what = "spring, asymmetry, friction, lag, gas and fading at once",
                    .orifice = 800,
                    .compression = 0.65,
                    .spring = 8e5,
                    .friction = 70,
                    .coil_lag = 0.01,
                    .gas = 200,
                    .fading = 0.06}};

class TrueDamper final : public DamperModel {
 public:
  explicit TrueDamper(const TrueDamperParts& parts, double offset = 0)
      : parts_(parts), offset_(offset) {}

  ModelKind kind() const override { return ModelKind::Other; }
  std::string name() const override { return std::string(parts_.name); }
  bool needs_displacement() const noexcept override { return true; }
  std::size_t parameter_count() const noexcept override { return 0; }
  std::size_t state_size() const noexcept override { return kStates; }

  void rest(const DamperInput& input, std::span<double> state) const noexcept override {
    std::ranges::fill(state, 0.0);
    state[kCoil] = input.current;
  }
  /// Heun's rule in steps that follow the stiffest part, the spring before the valve opens.
  void advance(const DamperInput& from, const DamperInput& to, double dt,
               std::span<double> state) const noexcept override {
    const double speed = std::max(std::abs(from.velocity), std::abs(to.velocity));
    const double rate = (parts_.spring > 0 ? parts_.spring / parts_.viscous : 0) +
                        (parts_.friction > 0 ? speed / parts_.bristle : 0) + 500;
    const int steps = std::max(1, static_cast<int>(std::ceil(4 * rate * dt)));
    const double h = dt / steps;

    // The motion is a straight line over the step.
    const auto at = [&](double share) {
      return DamperInput{std::lerp(from.displacement, to.displacement, share),
                         std::lerp(from.velocity, to.velocity, share),
                         std::lerp(from.current, to.current, share)};
    };
    std::array<double, kStates> first, second, tried;
    for (int step = 0; step < steps; ++step) {
      flow(at(static_cast<double>(step) / steps), state, first);
      for (std::size_t k = 0; k < kStates; ++k) tried[k] = state[k] + h * first[k];
      flow(at((step + 1.0) / steps), tried, second);
      for (std::size_t k = 0; k < kStates; ++k) state[k] += h / 2 * (first[k] + second[k]);
    }
  }
  double force(const DamperInput& input, std::span<const double> state) const noexcept override {
    std::array<double, kStates> rates;
    return flow(input, state, rates);
  }
  bool flows() const noexcept override { return true; }
  double flow(const DamperInput& input, std::span<const double> state,
              std::span<double> rates) const noexcept override {
    const TrueDamperParts& p = parts_;
    const double v = input.velocity, coil = p.coil_lag > 0 ? state[kCoil] : input.current;
    const double strength = std::max(0.1, 1 - p.fading * state[kHeat]) *
                            (1 + p.bypass * std::min(1.0, std::pow(input.displacement / 0.02, 2)));

    // The valve has the spring's force, or what the piston's speed asks of it.
    double valve = p.spring * state[kSpring], through = v;
    if (p.spring > 0)
      through = valve_speed(valve / strength, coil);
    else
      valve = strength * valve_force(v, coil);
    rates[kSpring] = p.spring > 0 ? v - through : 0;

    rates[kBristle] = p.friction > 0 ? v - std::abs(v) * state[kBristle] / p.bristle : 0;
    rates[kCoil] = p.coil_lag > 0 ? (input.current - coil) / p.coil_lag : 0;
    rates[kHeat] = p.fading > 0 ? valve * through / 1000 - state[kHeat] / p.cooling : 0;

    const double stroke = std::max(0.1, 1 + input.displacement / p.gas_length);
    return valve + p.friction * state[kBristle] / p.bristle - p.gas * std::pow(stroke, -1.3) +
           offset_;
  }
  std::unique_ptr<DamperModel> with_offset(double newton) const override {
    return std::make_unique<TrueDamper>(parts_, offset_ + newton);
  }
  Value to_json() const override {
    return Value::object({{"true_damper", std::string(parts_.name)}});
  }

 private:
  enum State { kSpring, kBristle, kCoil, kHeat, kStates };

  double yield_force(double current) const noexcept {
    return parts_.yield_off +
           parts_.yield_per_ampere * current / std::hypot(1, current / parts_.saturation);
  }
  double valve_force(double speed, double current) const noexcept {
    const double yield = yield_force(current), above = std::abs(speed) - yield / parts_.preyield;
    const double force = above < 0 ? parts_.preyield * std::abs(speed)
                                   : yield + above * (parts_.viscous + above * parts_.orifice);
    return speed < 0 ? -parts_.compression * force : force;
  }
  /// The inverse of valve_force().
  double valve_speed(double force, double current) const noexcept {
    const double asked = force < 0 ? -force / parts_.compression : force;
    const double yield = yield_force(current), above = asked - yield;
    const double c = parts_.viscous, q = parts_.orifice;
    const double speed =
        above < 0 ? asked / parts_.preyield
                  : yield / parts_.preyield +
                        (q > 0 ? 2 * above / (c + std::sqrt(c * c + 4 * q * above)) : above / c);
    return force < 0 ? -speed : speed;
  }

  TrueDamperParts parts_;
  double offset_;
};

}  // namespace

std::span<const TrueDamperParts> true_dampers() { return kTrueDampers; }

std::shared_ptr<const DamperModel> make_true_damper(const TrueDamperParts& parts) {
  return std::make_shared<TrueDamper>(parts);
}

}  // namespace dashpot
