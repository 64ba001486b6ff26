#include "contributing/law/a_viscous_example.h"

#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/registry.h"
#include "dashpot/damper/virtual_bench.h"
#include "dashpot/identify.h"
#include "support.h"

TEST_CASE("the example law: half its damping at v_1, by its own definition") {
  const AViscousExample damper{.c = 1000, .v_1 = 0.1, .f0 = 5};
  CHECK(a_viscous_example_force(&damper, 0, 0.1, nullptr) == 55);
  CHECK(a_viscous_example_force(&damper, 0, -0.1, nullptr) == -45);
}

TEST_CASE("one line in the registry, and the law is known by name, documented and fitted") {
  using namespace dashpot;
  CHECK(model_info("a_viscous_example").title == "Saturating viscous damper");
  BenchOptions options;
  options.motions = {{0.01, 1}, {0.005, 3}};
  options.drive_levels = {0.5, 1};
  options.sample_rate = 100;
  const Dataset data = run_virtual_bench(load_parameters("kwok2006"), DriveUnit::Ampere, options);
  const FitReport fit = identify("a_viscous_example", data.records, DriveUnit::Ampere, {});
  CHECK(fit.status == FitReport::Status::Converged);
  CHECK(fit.parameters.size() == 4);  // c at two currents, v_1, f0
}
