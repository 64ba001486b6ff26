#include "dashpot/damper/inverse/switching.h"

#include "damper/inverse/inverses.h"
#include "support.h"

using namespace dashpot;
using Rule = SwitchingInverse::Rule;

namespace {

const InverseLimits kVolts{.current_min = 0, .current_max = 2.25};

double command(Rule rule, double wanted, double measured, double velocity = 0) {
  const SwitchingInverse inverse(rule, kVolts, 1500);
  return first_command(inverse, {.wanted = wanted, .velocity = velocity, .measured = measured});
}

}  // namespace

TEST_CASE("TC-6.1 clipped-optimal") {
  const double rows[][3] = {{500, 300, 2.25},   {200, 300, 0},   {-500, 300, 0},
                            {-500, -300, 2.25}, {-200, -300, 0}, {500, 0, 0}};
  for (const auto& [wanted, measured, voltage] : rows)
    CHECK(command(Rule::ClippedOptimal, wanted, measured) == voltage);
}

TEST_CASE("TC-6.2 modified clipped-optimal") {
  CHECK_CLOSE(command(Rule::ModifiedClippedOptimal, 500, 300), 0.75, 1e-14, 0);
  CHECK(command(Rule::ModifiedClippedOptimal, 2000, 300) == 2.25);
  CHECK(command(Rule::ModifiedClippedOptimal, -500, 300) == 0);
}

TEST_CASE("Heaviside: full current where the wanted force dissipates") {
  CHECK(command(Rule::Heaviside, 500, 0, 0.1) == 2.25);
  CHECK(command(Rule::Heaviside, -500, 0, -1e-200) == 2.25);
  CHECK(command(Rule::Heaviside, -500, 0, 0.1) == 0);
  CHECK(command(Rule::Heaviside, 500, 0, 0) == 0);
}

TEST_CASE("signum: in proportion to the missing force, full at a tenth of the largest") {
  CHECK_CLOSE(command(Rule::Signum, 375, 300), 1.125, 1e-14, 0);  // 75 N of 150 N
  CHECK_CLOSE(command(Rule::Signum, -375, -300), 1.125, 1e-14, 0);
  CHECK(command(Rule::Signum, 1000, 300) == 2.25);
  CHECK(command(Rule::Signum, 200, 300) == 0);
  CHECK(command(Rule::Signum, 1000, 0) == 0);
}

TEST_CASE("without a measured force, schemes that need none work and the others keep the current") {
  const double none = std::numeric_limits<double>::quiet_NaN();
  CHECK(command(Rule::Heaviside, 500, none, 0.1) == 2.25);
  for (const Rule rule : {Rule::ClippedOptimal, Rule::ModifiedClippedOptimal, Rule::Signum}) {
    const SwitchingInverse inverse(rule, kVolts, 1500);
    CHECK(first_command(inverse, {.wanted = 500, .current = 0.7, .measured = none}) == 0.7);
  }
}

TEST_CASE("a largest force that is none is refused") {
  CHECK(message_of([] { SwitchingInverse(Rule::Signum, kVolts, 0); }) ==
        "signum: the largest force of the damper must be a number above 0");
}
