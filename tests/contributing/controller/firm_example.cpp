#include "dashpot/suspension/control/damping_law.h"

namespace dashpot {

#include "contributing/controller/control_firm_example.h"

extern const ControlLaw kFirmExample;
const ControlLaw kFirmExample{.name = "firm_example",
                              .title = "Firm, always",
                              .equation = "c = c_max",
                              .source = "made up for CONTRIBUTING.md",
                              .remarks = "",
                              .parameters = {},
                              .make = make_plain<kFirmExample, firm_example_demand>};

}  // namespace dashpot
