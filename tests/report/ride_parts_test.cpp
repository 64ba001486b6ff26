#include "dashpot/report/ride_parts.h"

#include "support.h"

using namespace dashpot;

TEST_CASE("a warning names its run, and a damper once") {
  auto vehicle = std::make_shared<Vehicle>();
  vehicle->damper_names = {"mine.json"};
  const std::string active = "mine.json: it feeds energy into motions of 3 Hz";
  const SimulatedRun held{.name = "mine.json at 0.5 A",
                          .vehicle = vehicle,
                          .trace = {},
                          .measures = {},
                          .warnings = {active, "a stop is met in 2 % of the time"}};
  SimulatedRun driven = held;
  driven.name = "skyhook";
  driven.warnings = {active};
  const std::vector<std::string> wanted{"mine.json at 0.5 A: it feeds energy into motions of 3 Hz",
                                        "mine.json at 0.5 A: a stop is met in 2 % of the time",
                                        "skyhook: mine.json: it feeds energy into motions of 3 Hz"};
  CHECK(run_remarks({&held, &driven}) == wanted);
}
