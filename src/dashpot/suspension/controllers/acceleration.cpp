#include "dashpot/suspension/controllers/damping_law.h"

namespace dashpot {
namespace {

DamperDemand acceleration_driven(const NoParameters&, const ControlLimits& limits, const StrutSignals& s) {
  return hard_when(s.body_acceleration * s.deflection_velocity >= 0, limits);
}
struct PowerDriven {
  double stiffness;
};
DamperDemand power_driven(const PowerDriven& p, const ControlLimits& limits, const StrutSignals& s) {
  const double d = s.deflection_velocity, spring = p.stiffness * s.deflection;
  if (spring * d + limits.damping_min * d * d >= 0) {
    const bool still = d == 0 && s.deflection != 0;
    return damping(still ? 0.5 * (limits.damping_min + limits.damping_max) : limits.damping_min);
  }
  if (spring * d + limits.damping_max * d * d < 0) return damping(limits.damping_max);
  return damping(-spring / d);
}

/// Without a stiffness of its own it takes that along each strut, which is the same for all of a kind.
ControllerPointer make_pdd(std::span<const double> values, const ControlContext& context) {
  PowerDriven p = values_as<PowerDriven>(values);
  if (p.stiffness == 0 && !context.plant.struts.empty()) {
    const Plant& plant = context.plant;
    const std::vector<double>& wheel = plant.struts[0].wheel_row;
    // A unit of the wheel alone stretches the strut and the tyre by one.
    for (std::size_t i = 0; i < wheel.size(); ++i)
      for (std::size_t j = 0; j < wheel.size(); ++j)
        p.stiffness += wheel[i] * plant.stiffness[i * plant.size() + j] * wheel[j];
  }
  return std::make_unique<StrutLaw<PowerDriven, power_driven>>(p, context.limits);
}

struct Mixed {
  double crossover;
};
DamperDemand sh_add(const Mixed& p, const ControlLimits& limits, const StrutSignals& s) {
  const double signal = frequency_range(s, p.crossover) <= 0 ? s.body_velocity : s.body_acceleration;
  return hard_when(signal * s.deflection_velocity > 0, limits);
}
DamperDemand mix1(const Mixed& p, const ControlLimits& limits, const StrutSignals& s) {
  return hard_when(frequency_range(s, p.crossover) <= 0, limits);
}

struct Constant {
  double place;
};
DamperDemand constant(const Constant& p, const ControlLimits& limits, const StrutSignals&) {
  return damping(limits.damping_min + p.place * (limits.damping_max - limits.damping_min));
}

}  // namespace

extern const ControlLaw kAdd, kPdd, kShAdd, kMix1, kConstant;

const ControlLaw kAdd{
    .name = "add",
    .title = "Acceleration-driven damper",
    .equation = "c = c_max where z'' d >= 0, else c_min",
    .source = "Savaresi, Silani and Bittanti, ASME J. Dyn. Sys. Meas. Control 127 (2005) 218",
    .remarks =
        "Where -c_max d^2 < k x d < -c_min d^2 neither side holds: it flips at every sample, and "
        "rides as the sampling has it. pdd is what it would settle at.",
    .parameters = {},
    .make = make_plain<acceleration_driven>};
const ControlLaw kPdd{
    .name = "pdd",
    .title = "Power-driven damper",
    .equation =
        "c = c_min where k x d + c_min d^2 >= 0,  c_max where k x d + c_max d^2 < 0,\n(c_min + c_max) / 2 "
        "where "
        "x != 0 and d = 0,  else -k x / d",
    .source = "Morselli and Zanasi, Mechatronics 18 (2008), recalled",
    .remarks = "",
    .parameters = {{"stiffness", "N/m", 0, 0, 1e9, "k, of the suspension; 0: the first strut's"}},
    .make = make_pdd};
const ControlLaw kShAdd{.name = "sh_add",
                        .title = "Mixed skyhook and ADD (two sensors)",
                        .equation =
                            "z''^2 - (2 pi f z')^2 <= 0: c = c_max where z' d > 0, else c_min\nelse:         "
                            "              c = c_max where "
                            "z'' d > 0, else c_min",
                        .source = "Savaresi and Spelta, ASME J. Dyn. Sys. Meas. Control 129 (2007) 382",
                        .remarks = "",
                        .parameters = {kCrossover},
                        .make = make_strut_law<Mixed, sh_add>};
const ControlLaw kMix1{.name = "mix1",
                       .title = "Mix-1-sensor",
                       .equation = "c = c_max where z''^2 - (2 pi f z')^2 <= 0, else c_min",
                       .source = "Spelta et al. 2010, as the one-sensor paper uses it; recalled",
                       .remarks =
                           "One accelerometer on the body. Soft at the wheel's resonance: road holding is "
                           "that of the soft damper.",
                       .parameters = {kCrossover},
                       .make = make_strut_law<Mixed, mix1>};
const ControlLaw kConstant{.name = "constant",
                           .title = "Passive: one damping",
                           .equation = "c = c_min + place (c_max - c_min)",
                           .source = "",
                           .remarks = "",
                           .parameters = {{"place", "1", 0.5, 0, 1, "0: soft, 1: hard"}},
                           .make = make_strut_law<Constant, constant>};

}  // namespace dashpot
