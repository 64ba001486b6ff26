#include "studies/ride_rank/ride_rank_study.h"

#include "dashpot/model_file.h"
#include "studies/ride_rank/ride_rank_document.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("true dampers: every one takes energy out, and no two are alike" *
          doctest::test_suite("long")) {
  for (const TrueDamperParts& parts : true_dampers()) {
    CAPTURE(parts.name);
    const std::shared_ptr<const DamperModel> damper = make_true_damper(parts);
    CHECK(dissipation(*damper, usual_domain(0, 2)).dissipates());
  }
}

TEST_CASE("true dampers: a spring that is stiff enough is none") {
  // The valve and its inverse: behind 1e8 N/m it answers like the rigid one.
  TrueDamperParts rigid{.name = "rigid", .what = "", .orifice = 900, .compression = 0.6};
  TrueDamperParts sprung = rigid;
  sprung.spring = 1e8;
  const auto a = make_true_damper(rigid), b = make_true_damper(sprung);
  for (const double speed : {-0.8, -0.1, -0.002, 0.001, 0.05, 0.6}) {
    std::vector<double> state(b->state_size());
    const DamperInput input{0, speed, 1.5};
    b->rest(input, state);
    for (int k = 0; k < 100; ++k) b->advance(input, input, 1e-4, state);
    CHECK_CLOSE(b->force(input, state), a->force(input, state), 1e-6, 0);
  }
}

TEST_CASE("quality of orders, by hand") {
  const RideRankCase one{
      "t",
      "r",
      "c",
      {{"a", 1, {30, 25, 35}, 32}, {"b", 2, {10, 5, 15}, 16}, {"c", 3, {20, 15, 25}, 24}}};
  const RideRankQuality quality = quality_of(std::span(&one, 1));
  CHECK(quality.predicted.correlation == doctest::Approx(1));
  CHECK(quality.esr.correlation == doctest::Approx(-0.5));
  CHECK(quality.predicted.regret == doctest::Approx(1));
  CHECK(quality.esr.regret == doctest::Approx(2));
  CHECK(quality.covered == doctest::Approx(2.0 / 3));
}

TEST_CASE("what is predicted of rides tells their true order better than ESR does" *
          doctest::test_suite("long")) {
  // A small part of what `dashpot study ride-rank` does: one damper that judges, two rides.
  RideRankStudyOptions options;
  options.truths = {"gas_spring"};
  options.models = {"bingham", "chebyshev", "tanh_kwok", "viscous_dahl"};
  options.roads = {"iso8608,class=D,speed=12"};
  options.controllers = {"none", "skyhook"};
  options.duration = 5;
  options.draws = 3;
  const std::vector<RideRankCase> cases = study_ride_rank(options, nullptr);
  REQUIRE(cases.size() == 2);
  const RideRankQuality quality = quality_of(cases);
  CHECK(quality.predicted.correlation > 0.7);
  CHECK(quality.predicted.correlation > quality.esr.correlation);

  const Document document = ride_rank_document(cases, options);
  CHECK(contains(document.verdict, "Rank correlation with the true error of the ride"));
  CHECK(document.sections.front().tables.front().rows.size() == 1);
}

TEST_CASE("wrong names are refused before the first fit") {
  RideRankStudyOptions options;
  options.truths = {"soft_bushing"};
  CHECK(contains(message_of([&] { study_ride_rank(options, nullptr); }),
                 "--truths: unknown true damper 'soft_bushing'; did you mean 'soft_bushings'?"));
  options = {};
  options.models = {"bingham", "tanh_kwok"};
  CHECK(contains(message_of([&] { study_ride_rank(options, nullptr); }),
                 "--models: names 2 models; three at least"));
  CHECK(contains(ride_rank_document({}, options).verdict, "there is no order to tell"));
  options = {};
  options.controllers = {"skyhok"};
  CHECK(contains(message_of([&] { study_ride_rank(options, nullptr); }), "skyhook"));
}
