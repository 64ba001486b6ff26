#include "dashpot/suspension/control/damping_law.h"

namespace dashpot {

#include "dashpot/suspension/control/c_text/control_fuzzy.h"

extern const ControlLaw kFuzzy;

const ControlLaw kFuzzy{
    .name = "fuzzy",
    .title = "Fuzzy rules on the velocities of body and deflection",
    .equation =
        "c = c_min + (c_max - c_min) sum w r;  r = 1 where z' and d are alike, 0 where they are "
        "opposed or both nearly zero,\n1/2 where one of them is nearly zero",
    .source =
        "Form of Dashpot's own; Dong, Yu, Li and Chen, Nonlinear Dynamics 59 (2010) 433, compare "
        "such a controller, whose rules are not at hand",
    .remarks = "Changes without leaps where a two-state skyhook switches.",
    .parameters = {{"body", "m/s", 0.2, 1e-6, 100, "scale of the body's velocity"},
                   {"deflection", "m/s", 0.4, 1e-6, 100, "scale of the deflection's velocity"}},
    .make = make_strut_law<kFuzzy, Fuzzy, fuzzy_demand>};

}  // namespace dashpot
