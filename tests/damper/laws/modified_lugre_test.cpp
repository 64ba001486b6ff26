#include "dashpot/damper/laws/modified_lugre.h"

#include "damper/laws/sine_drive.h"
#include "dashpot/damper/registry.h"

using namespace dashpot;

TEST_CASE("modified LuGre: TC-4.14") {
  // The set of docs/sources.md at V = 1: sigma_0 = 1.8e4 + 4e4 V, sigma_2 = 100 + 2300 V
  const Dependence drive{
      {Form::Linear, Form::Constant, Form::Linear, Form::Constant, Form::Constant},
      {{1.8e4, 4e4}, {200}, {100, 2300}, {190}, {0}}};
  const LawModel model(find_law("modified_lugre"), drive, DriveUnit::Volt, 0);
  const auto found = at_times(model, {0.01, 1, 1}, {0.05, 0.2, 0.5, 1, 2});
  check_states(found, 0, {2.3372673e-3, 4.3992388e-3, -3.8064923e-3, 3.7213381e-3, 3.7232005e-3},
               1e-12);
  check_forces(found, {285.62142, 302.39193, -375.05095, 370.31532, 370.41889});
}

TEST_CASE("modified LuGre: the bristles take power at every moment, whatever their damping") {
  const ModifiedLugre p{0, 1e5, 0, 190, 0};
  for (const double z : {-1 / 190.0, -0.003, 0.0, 0.005})
    for (const double v : {-0.3, 0.1}) CHECK(modified_lugre_force(&p, 0, v, &z) * v >= 0);
}
