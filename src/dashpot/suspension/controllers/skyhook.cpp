#include "dashpot/suspension/controllers/damping_law.h"

namespace dashpot {
namespace {

constexpr std::string_view kBook =
    "Karnopp, Crosby and Harwood, J. Eng. Ind. 96 (1974) 619, recalled; forms as in Savaresi et al., "
    "Semi-Active "
    "Suspension Control Design for Vehicles, 2010, recalled";

DamperDemand skyhook(const NoParameters&, const ControlLimits& limits, const StrutSignals& s) {
  return hard_when(s.body_velocity * s.deflection_velocity >= 0, limits);
}

struct Linear {
  double share;
};
DamperDemand skyhook_linear(const Linear& p, const ControlLimits& limits, const StrutSignals& s) {
  const double d = s.deflection_velocity, z = s.body_velocity;
  if (!(z * d > 0)) return damping(limits.damping_min);
  const double wanted = limits.damping_max * (p.share + (1 - p.share) * z / d);
  return damping(std::fmin(std::fmax(wanted, limits.damping_min), limits.damping_max));
}

struct Modified {
  double gain, share;
};
DamperDemand skyhook_modified(const Modified& p, const ControlLimits& limits, const StrutSignals& s) {
  const double wanted = p.gain * (p.share * s.deflection_velocity + (1 - p.share) * s.body_velocity);
  return dissipating_force(wanted, s.deflection_velocity, limits);
}

DamperDemand groundhook(const NoParameters&, const ControlLimits& limits, const StrutSignals& s) {
  return hard_when(-s.wheel_velocity * s.deflection_velocity >= 0, limits);
}

struct Hybrid {
  double gain, share;
};
DamperDemand hybrid(const Hybrid& p, const ControlLimits& limits, const StrutSignals& s) {
  const double d = s.deflection_velocity;
  const double sky = s.body_velocity * d > 0 ? s.body_velocity : 0;
  const double ground = -s.wheel_velocity * d > 0 ? -s.wheel_velocity : 0;
  return dissipating_force(p.gain * (p.share * sky + (1 - p.share) * ground), d, limits);
}

}  // namespace

extern const ControlLaw kSkyhook, kSkyhookLinear, kSkyhookModified, kGroundhook, kHybrid;

const ControlLaw kSkyhook{.name = "skyhook",
                          .title = "Skyhook, two states",
                          .equation = "c = c_max where z' d >= 0, else c_min;  d = z' - z_us'",
                          .source = kBook,
                          .remarks = "",
                          .parameters = {},
                          .make = make_plain<skyhook>};
const ControlLaw kSkyhookLinear{
    .name = "skyhook_linear",
    .title = "Skyhook, linear",
    .equation = "c = sat((a c_max d + (1 - a) c_max z') / d) where z' d > 0, else c_min",
    .source = kBook,
    .remarks = "a = 1 is the hard damper wherever it may be hard.",
    .parameters = {{"share", "1", 0.5, 0, 1, "a, of the passive damper"}},
    .make = make_strut_law<Linear, skyhook_linear>};
const ControlLaw kSkyhookModified{
    .name = "skyhook_modified",
    .title = "Modified skyhook of Besinger, Cebon and Cole",
    .equation = "F = C (a d + (1 - a) z'), within c_min d ... c_max d",
    .source = "Besinger, Cebon and Cole, Vehicle System Dynamics 24 (1995) 695, recalled",
    .remarks = "",
    .parameters = {{"gain", "N*s/m", 2000, 0, 1e7, "C"},
                   {"share", "1", 0.5, 0, 1, "a, of the passive damper"}},
    .make = make_strut_law<Modified, skyhook_modified>};
const ControlLaw kGroundhook{.name = "groundhook",
                             .title = "Groundhook, two states",
                             .equation = "c = c_max where -z_us' d >= 0, else c_min",
                             .source = kBook,
                             .remarks = "For road holding.",
                             .parameters = {},
                             .make = make_plain<groundhook>};
const ControlLaw kHybrid{
    .name = "hybrid",
    .title = "Hybrid of skyhook and groundhook",
    .equation =
        "F = G (a s + (1 - a) g), within c_min d ... c_max d;\ns = z' where z' d > 0, g = -z_us' where "
        "-z_us' d > 0",
    .source = "Ahmadian, recalled",
    .remarks = "",
    .parameters = {{"gain", "N*s/m", 2000, 0, 1e7, "G"}, {"share", "1", 0.5, 0, 1, "a, of the skyhook"}},
    .make = make_strut_law<Hybrid, hybrid>};

}  // namespace dashpot
