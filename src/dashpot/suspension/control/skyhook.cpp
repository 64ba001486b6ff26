#include "dashpot/suspension/control/damping_law.h"

namespace dashpot {

// clang-format off: the texts are taken in
#include "dashpot/suspension/control/c_text/control_groundhook.h"
#include "dashpot/suspension/control/c_text/control_hybrid.h"
#include "dashpot/suspension/control/c_text/control_skyhook.h"
#include "dashpot/suspension/control/c_text/control_skyhook_linear.h"
#include "dashpot/suspension/control/c_text/control_skyhook_modified.h"
// clang-format on

extern const ControlLaw kSkyhook, kSkyhookLinear, kSkyhookModified, kGroundhook, kHybrid;

namespace {

constexpr std::string_view kBook =
    "Karnopp, Crosby and Harwood, J. Eng. Ind. 96 (1974) 619, recalled; forms as in Savaresi et "
    "al., Semi-Active Suspension Control Design for Vehicles, 2010, recalled";

}  // namespace

const ControlLaw kSkyhook{.name = "skyhook",
                          .title = "Skyhook, two states",
                          .equation = "c = c_max where z' d >= 0, else c_min;  d = z' - z_us'",
                          .source = kBook,
                          .remarks = "",
                          .parameters = {},
                          .make = make_plain<kSkyhook, skyhook_demand>};
const ControlLaw kSkyhookLinear{
    .name = "skyhook_linear",
    .title = "Skyhook, linear",
    .equation = "c = sat((a c_max d + (1 - a) c_max z') / d) where z' d > 0, else c_min",
    .source = kBook,
    .remarks = "a = 1 is the hard damper wherever it may be hard.",
    .parameters = {{"share", "1", 0.5, 0, 1, "a, of the passive damper"}},
    .make = make_strut_law<kSkyhookLinear, SkyhookLinear, skyhook_linear_demand>};
const ControlLaw kSkyhookModified{
    .name = "skyhook_modified",
    .title = "Modified skyhook of Besinger, Cebon and Cole",
    .equation = "F = C (a d + (1 - a) z'), within c_min d ... c_max d",
    .source = "Besinger, Cebon and Cole, Vehicle System Dynamics 24 (1995) 695, recalled",
    .remarks = "",
    .parameters = {{"gain", "N*s/m", 2000, 0, 1e7, "C"},
                   {"share", "1", 0.5, 0, 1, "a, of the passive damper"}},
    .make = make_strut_law<kSkyhookModified, SkyhookModified, skyhook_modified_demand>};
const ControlLaw kGroundhook{.name = "groundhook",
                             .title = "Groundhook, two states",
                             .equation = "c = c_max where -z_us' d >= 0, else c_min",
                             .source = kBook,
                             .remarks = "For road holding.",
                             .parameters = {},
                             .make = make_plain<kGroundhook, groundhook_demand>};
const ControlLaw kHybrid{.name = "hybrid",
                         .title = "Hybrid of skyhook and groundhook",
                         .equation =
                             "F = G (a s + (1 - a) g), within c_min d ... c_max d;\ns = z' where "
                             "z' d > 0, g = -z_us' where -z_us' d > 0",
                         .source = "Ahmadian, recalled",
                         .remarks = "",
                         .parameters = {{"gain", "N*s/m", 2000, 0, 1e7, "G"},
                                        {"share", "1", 0.5, 0, 1, "a, of the skyhook"}},
                         .make = make_strut_law<kHybrid, Hybrid, hybrid_demand>};

}  // namespace dashpot
