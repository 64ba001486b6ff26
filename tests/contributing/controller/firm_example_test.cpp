#include <algorithm>

#include "dashpot/controller.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("the example controller: it is known by name, in its place, and decides") {
  CHECK(
      std::ranges::is_sorted(control_laws(), {}, [](const ControlLaw* law) { return law->name; }));
  Plant plant;
  plant.struts.resize(1);
  const ControlLimits limits{.damping_min = 300, .damping_max = 3900};
  const ControllerPointer firm = make_controller("firm_example", {limits, plant});
  DamperDemand demand;
  firm->step(std::vector<StrutSignals>(1), {}, {}, {&demand, 1});
  CHECK(demand.kind == DamperDemand::Kind::Damping);
  CHECK(demand.value == 3900);
}
