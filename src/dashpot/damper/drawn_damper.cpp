#include "dashpot/damper/drawn_damper.h"

#include <cmath>

#include "dashpot/error.h"
#include "dashpot/numerics/root.h"

namespace dashpot {

DrawnDamper::DrawnDamper(const DamperDescription& drawing, const DrawnBuild& build,
                         double largest_current)
    : name_(drawing.name), build_(build) {
  require_field(drawing, drawing.name);
  if (!(build.stiffness > 0 && build.strength > 0 && std::abs(build.asymmetry) < 1))
    throw Error(drawing.name, "a build without strength, or without a spring before the flow",
                "positive numbers, and an asymmetry between -1 and 1");
  member_ = member_of(drawing, largest_current);
  active_ = {member_.pole_length, member_.gap_area / member_.gap, member_.gap};
  passive_ = {drawing.passive_length, active_.width, active_.height};
  index_ = drawing.fluid->index;
  consistency_ = member_.viscosity * std::pow(drawing.fluid->shear_rate, 1 - index_);
}

double DrawnDamper::flow_force(double speed, double current) const noexcept {
  const double flow = member_.piston_area * speed;
  const double yielding = plate_yield_pressure(&active_, member_.yield.at(current));
  double pressure = 0;
  if (index_ == 1) {
    const double newtonian = plate_newtonian_pressure(&active_, member_.viscosity, flow);
    pressure = plate_bingham_pressure(newtonian, yielding) +
               plate_newtonian_pressure(&passive_, member_.viscosity, flow);
  } else if (speed > 0) {
    const double power = plate_power_law_pressure(&active_, consistency_, index_, flow);
    pressure = plate_herschel_bulkley_pressure(power, yielding, index_) +
               plate_power_law_pressure(&passive_, consistency_, index_, flow);
  } else {
    pressure = yielding;
  }
  return build_.strength * member_.piston_area * pressure;
}

void DrawnDamper::rest(const DamperInput&, std::span<double> state) const noexcept { state[0] = 0; }

void DrawnDamper::advance(const DamperInput&, const DamperInput& to, double dt,
                          std::span<double> state) const noexcept {
  // The spring's force at the end of the step is that at which what it gives and what flows make up
  // the motion: implicit, so that any stiffness will do.
  constexpr double kFlowTolerance = 1e-9;
  const double give = build_.stiffness * dt;
  const double pull = state[0] + give * to.velocity, size = std::abs(pull);
  const double side = pull < 0 ? -1 : 1, lean = 1 + side * build_.asymmetry;
  if (!(give > 0)) return;
  const auto excess = [&](double speed) {
    return lean * flow_force(speed, to.current) + give * speed - size;
  };
  const double still = excess(0);
  if (still >= 0) {
    state[0] = pull;  // nothing flows
    return;
  }
  const double most = size / give;
  const double speed = find_root(excess, {0, still}, {most, excess(most)}, kFlowTolerance * size);
  state[0] = side * (size - give * speed);
}

double DrawnDamper::force(const DamperInput& input, std::span<const double> state) const noexcept {
  constexpr double kOnset = 1e-3;  // m/s
  return state[0] + build_.friction * std::tanh(input.velocity / kOnset) +
         member_.spring_stiffness * input.displacement + offset_;
}

double DrawnDamper::flow(const DamperInput& input, std::span<const double> state,
                         std::span<double> rates) const noexcept {
  constexpr double kFlowTolerance = 1e-9;
  const double size = std::abs(state[0]), side = state[0] < 0 ? -1 : 1;
  const auto excess = [&](double speed) {
    return (1 + side * build_.asymmetry) * flow_force(speed, input.current) - size;
  };

  // The speed at which the flow resists as the spring pulls; none before it yields.
  double speed = 0;
  if (const double still = excess(0); still < 0) {
    double most = 1e-3;
    while (excess(most) < 0) most *= 2;
    speed = find_root(excess, {0, still}, {most, excess(most)}, kFlowTolerance * size);
  }
  rates[0] = build_.stiffness * (input.velocity - side * speed);
  return force(input, state);
}

std::unique_ptr<DamperModel> DrawnDamper::with_offset(double newton) const {
  auto moved = std::make_unique<DrawnDamper>(*this);
  moved->offset_ += newton;
  return moved;
}

Value DrawnDamper::to_json() const {
  return Value::object({{"drawing", name_},
                        {"strength", build_.strength},
                        {"friction", build_.friction},
                        {"stiffness", build_.stiffness},
                        {"asymmetry", build_.asymmetry},
                        {"member", dashpot::to_json(member_)}});
}

}  // namespace dashpot
