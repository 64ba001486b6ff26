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

TEST_CASE("a softened law with its parameters at hand is the softened model to the bit") {
  // Parameters that follow the current, so that the model finds them anew at each call.
  Dependence parameters;
  for (const ParamInfo& info : find_law("tanh_kwok").params) {
    parameters.forms.push_back(info.form);
    parameters.coefficients.emplace_back(coefficient_count(info.form), info.value);
  }
  const auto kwok =
      std::make_shared<LawModel>(find_law("tanh_kwok"), parameters, DriveUnit::Ampere, 0);
  const auto soft = with_soft_sides(kwok);
  const SoftLaw law = soft_law(*soft), bare = soft_law(*kwok);
  REQUIRE(law.law);
  CHECK(law.is_soft);
  CHECK(!bare.is_soft);

  // Within the middle, at its end and beyond.
  std::array<double, kMaxParams> at{};
  kwok->parameters_at(0.7, at.data());
  for (const double x : {0.0, 0.3 * kSideWay, -0.9 * kSideWay, kSideWay, -0.02}) {
    const DamperInput input{x, 0.1, 0.7};
    CHECK(law.flow(at.data(), input, nullptr, nullptr) == soft->flow(input, {}, {}));
    CHECK(bare.flow(at.data(), input, nullptr, nullptr) == kwok->flow(input, {}, {}));
  }

  // Neither a law with a lag of its own nor two middles are one.
  CHECK(!soft_law(LawModel(find_law("tanh_kwok"), parameters, DriveUnit::Ampere, 50)).law);
  CHECK(!soft_law(*with_soft_friction(soft)).law);
}
