#include "dashpot/suspension/dampers/soft_friction.h"

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/registry.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("friction that jumps is seen, and then sets in along a straight line") {
  // F = 1000 v + 100 tanh(v / v_s) N.
  const auto bingham = [](double speed) {
    return std::make_shared<LawModel>(
        LawModel::constant(find_law("bingham"), {1000, 100, 0, speed}));
  };
  CHECK(jumps_at_rest(*bingham(0), 0, 1));
  CHECK(!jumps_at_rest(*bingham(1e-3), 0, 1));
  const auto soft = with_soft_friction(bingham(0));
  const auto force = [&](const DamperModel& model, double v) { return model.force({0, v, 0}, {}); };
  CHECK(!jumps_at_rest(*soft, 0, 1));
  CHECK_CLOSE(force(*soft, 0.5 * kFrictionSpeed), 0.5 * (100 + 1000 * kFrictionSpeed), 1e-12, 0);
  CHECK_CLOSE(force(*soft, 0), 0, 0, 1e-12);
  for (const double v : {-0.5, -kFrictionSpeed, kFrictionSpeed, 0.3})
    CHECK(force(*soft, v) == force(*bingham(0), v));
  CHECK(force(*soft->with_offset(7), 0.3) == force(*soft, 0.3) + 7);
}

TEST_CASE("a stiff spring before a law's states is no jump") {
  for (const double k2 : {2e5, 1e10}) {
    const LawModel stiff =
        LawModel::constant(find_law("extended_bingham"), {5000, 300, 20000, 1e5, k2, 0});
    CHECK(!jumps_in_middle(stiff, 0, 1));
    CHECK(!jumps_at_rest(stiff, 0, 1));
  }
}

TEST_CASE("a force that jumps in the middle of the stroke changes over a short way instead") {
  // F = 1000 v + 700 tanh(100 v + 0.9 sgn(x))
  const auto kwok = std::make_shared<LawModel>(
      LawModel::constant(find_law("tanh_kwok"), {1000, 0, 700, 100, 0.9, 0}));
  CHECK(jumps_in_middle(*kwok, 0, 1));
  CHECK(!jumps_at_rest(*kwok, 0, 1));
  const auto soft = with_soft_sides(kwok);
  CHECK(!jumps_in_middle(*soft, 0, 1));
  const auto at = [](const DamperModel& model, double x) { return model.force({x, 0, 0}, {}); };
  CHECK_CLOSE(at(*soft, 0.5 * kSideWay), 0.5 * 700 * std::tanh(0.9), 1e-12, 0);
  for (const double x : {-0.01, -kSideWay, kSideWay, 0.01}) CHECK(at(*soft, x) == at(*kwok, x));
}
