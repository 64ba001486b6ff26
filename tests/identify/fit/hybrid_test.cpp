#include "dashpot/damper/kinds/hybrid/hybrid_model.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/registry.h"
#include "dashpot/damper/virtual_bench.h"
#include "dashpot/identify.h"
#include "dashpot/identify/rank/fit_store.h"
#include "identify/small_campaign.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A damper with hysteresis and a knee that the bingham law lacks.
Dataset campaign(std::vector<SineMotion> motions) {
  return small_campaign(std::move(motions), {{0, 0.3, 0.7, 1}, 60});
}

}  // namespace

TEST_CASE("the network adds what the law lacks, with the same bits on any number of threads" *
          doctest::test_suite("long")) {
  const std::vector<Record> training = campaign({{0.01, 1}, {0.005, 3}}).records;
  const Dataset unseen = campaign({{0.007, 2}});
  const FitReport law = identify("viscous_dahl", training, DriveUnit::Ampere, {});
  const FitReport one =
      identify("viscous_dahl+network", training, DriveUnit::Ampere, {.threads = 1});
  const FitReport three =
      identify("viscous_dahl+network", training, DriveUnit::Ampere, {.threads = 3});
  CHECK(format_json(one.model->to_json()) == format_json(three.model->to_json()));
  CHECK(one.model->name() == "viscous_dahl+network");
  CHECK(one.offsets.size() == training.size());
  CHECK(one.training_rmse < 0.9 * law.training_rmse);
  const double of_law = evaluate(*law.model, unseen.records, DriveUnit::Ampere).pooled.esr;
  CHECK(evaluate(*one.model, unseen.records, DriveUnit::Ampere).pooled.esr < 0.8 * of_law);
}

TEST_CASE("the law inside learns with the network, and no interval is claimed for it") {
  const std::vector<Record> training = campaign({{0.01, 1}}).records;
  const FitReport fit = identify("viscous_dahl+network", training, DriveUnit::Ampere, {});
  const FitReport law = identify("viscous_dahl", training, DriveUnit::Ampere, {});
  REQUIRE(fit.parameters.size() == law.parameters.size());
  bool moved = false;
  for (std::size_t k = 0; k < law.parameters.size(); ++k) {
    CHECK(fit.parameters[k].name == law.parameters[k].name);
    CHECK(std::isnan(fit.parameters[k].low) != fit.parameters[k].fixed);
    moved |= fit.parameters[k].value != law.parameters[k].value;
  }
  CHECK(moved);
  CHECK(fit.warnings.front().find("share their work with the network") != std::string::npos);
}

TEST_CASE("what is chosen for a parameter holds for the law inside; the store keeps the fit") {
  IdentifyOptions options;
  options.choices = {{.law = "bingham+network", .parameter = "c0", .fixed = 1234},
                     {.law = "bingham", .parameter = "c0", .fixed = 5678}};
  const std::vector<Record> training = campaign({{0.01, 1}}).records;
  const FitReport fit = identify("bingham+network", training, DriveUnit::Ampere, options);
  const auto& model = dynamic_cast<const HybridModel&>(*fit.model);
  CHECK(model.law().parameters().coefficients[0] == std::vector<double>{1234});

  const TemporaryFolder folder;
  FitStore store(folder.path() / "fits.sqlite", "test");
  const FitStore::Request request{"bingham+network", training, DriveUnit::Ampere, options};
  store.save(request, fit);
  const auto kept = store.load(request);
  REQUIRE(kept);
  CHECK(format_json(kept->model->to_json()) == format_json(fit.model->to_json()));
}
