#include "dashpot/damper/physics/damper_physics.h"
#include "dashpot/value.h"
#include "program.h"

using namespace dashpot;

TEST_CASE("physics: every step with its unit, as text and as JSON") {
  const ProgramResult result = run_dashpot("physics passenger_car --current 2 --velocity 0.3");
  CHECK(result.exit_code == 0);
  for (const PhysicsQuantity& quantity : physics_quantities())
    CHECK(contains(result.output, std::string(quantity.name)));
  const Value json = parse_json(
      stdout_of_dashpot("physics family_prototype --current 0.25 --velocity 34mm/s --json").output,
      "json");
  CHECK(json.find("quantities")->items().size() == physics_quantities().size());
  CHECK(json.find("velocity")->as_number() == 0.034);
}

TEST_CASE("physics: fields can be changed, listed, and are refused with their names") {
  const std::string wide = run_dashpot("physics passenger_car --set gap=2mm").output;
  CHECK(wide != run_dashpot("physics passenger_car").output);
  CHECK(contains(run_dashpot("physics --fields").output, "passive_length"));
  CHECK(contains(run_dashpot("physics passenger_car --set gpa=2mm").output, "did you mean 'gap'"));
  CHECK(contains(run_dashpot("physics passenger_car --set gap=2kg").output, "not a unit of it"));
  CHECK(contains(run_dashpot("physics passenger_car --current much").output, "is not a number"));
  CHECK(run_dashpot("physics no_such.yaml").exit_code == 1);
  CHECK(run_dashpot("physics").exit_code == 2);
}
