#include "dashpot/suspension/control/damping_law.h"

namespace dashpot {
// clang-format off: the texts are taken in
#include "dashpot/suspension/control/c_text/control_add.h"
#include "dashpot/suspension/control/c_text/control_constant.h"
#include "dashpot/suspension/control/c_text/control_mix1.h"
#include "dashpot/suspension/control/c_text/control_pdd.h"
#include "dashpot/suspension/control/c_text/control_sh_add.h"
// clang-format on

extern const ControlLaw kAdd, kPdd, kShAdd, kMix1, kConstant;

namespace {

ControllerPointer make_pdd(std::span<const double> values, const ControlContext& context) {
  Pdd p = values_as<Pdd>(values);
  if (p.stiffness == 0) p.stiffness = strut_stiffness(context.plant);
  return std::make_unique<StrutLaw<kPdd, Pdd, pdd_demand>>(p, context);
}

}  // namespace

const ControlLaw kAdd{
    .name = "add",
    .title = "Acceleration-driven damper",
    .equation = "c = c_max where z'' d >= 0, else c_min",
    .source = "Savaresi, Silani and Bittanti, ASME J. Dyn. Sys. Meas. Control 127 (2005) 218",
    .remarks =
        "Where -c_max d^2 < k x d < -c_min d^2 neither side holds: it flips at every sample, and "
        "rides as the sampling has it. pdd is what it would settle at.",
    .parameters = {},
    .make = make_plain<kAdd, add_demand>};
const ControlLaw kPdd{
    .name = "pdd",
    .title = "Power-driven damper",
    .equation =
        "c = c_min where k x d + c_min d^2 >= 0,  c_max where k x d + c_max d^2 < 0,\n(c_min + "
        "c_max) / 2 "
        "where "
        "x != 0 and d = 0,  else -k x / d",
    .source = "Morselli and Zanasi, Mechatronics 18 (2008), recalled",
    .remarks = "",
    .parameters = {{"stiffness", "N/m", 0, 0, 1e9, "k, of the suspension; 0: the first strut's"}},
    .make = make_pdd};
const ControlLaw kShAdd{
    .name = "sh_add",
    .title = "Mixed skyhook and ADD (two sensors)",
    .equation =
        "z''^2 - (2 pi f z')^2 <= 0: c = c_max where z' d > 0, else c_min\nelse:         "
        "              c = c_max where "
        "z'' d > 0, else c_min",
    .source = "Savaresi and Spelta, ASME J. Dyn. Sys. Meas. Control 129 (2007) 382",
    .remarks = "",
    .parameters = {kCrossover},
    .make = make_strut_law<kShAdd, ShAdd, sh_add_demand>};
const ControlLaw kMix1{
    .name = "mix1",
    .title = "Mix-1-sensor",
    .equation = "c = c_max where z''^2 - (2 pi f z')^2 <= 0, else c_min",
    .source = "Spelta et al. 2010, as the one-sensor paper uses it; recalled",
    .remarks =
        "One accelerometer on the body. Soft at the wheel's resonance: road holding is "
        "that of the soft damper.",
    .parameters = {kCrossover},
    .make = make_strut_law<kMix1, Mix1, mix1_demand>};
const ControlLaw kConstant{.name = "constant",
                           .title = "Passive: one damping",
                           .equation = "c = c_min + place (c_max - c_min)",
                           .source = "",
                           .remarks = "",
                           .parameters = {{"place", "1", 0.5, 0, 1, "0: soft, 1: hard"}},
                           .make = make_strut_law<kConstant, Constant, constant_demand>};

}  // namespace dashpot
