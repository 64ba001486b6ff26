#include "dashpot/damper/kinds/passive_hybrid/passive_hybrid_model.h"
#include "dashpot/identify.h"
#include "identify/small_campaign.h"
#include "support.h"

using namespace dashpot;

namespace {

IdentifyOptions brief() {
  IdentifyOptions options;
  options.network = {.epochs = 60, .members = 1};
  return options;
}

double share_of(const FitReport& fit) {
  return dynamic_cast<const PassiveHybridModel&>(*fit.model).network_share();
}

}  // namespace

TEST_CASE("a law beside a network is fitted with the same bits on any number of threads" *
          doctest::test_suite("long")) {
  const std::vector<Record> training = small_campaign({{0.01, 1}, {0.005, 3}}).records;
  IdentifyOptions options = brief();
  options.threads = 1;
  const FitReport one =
      identify("viscous_dahl+passive_network", training, DriveUnit::Ampere, options);
  options.threads = 3;
  const FitReport three =
      identify("viscous_dahl+passive_network", training, DriveUnit::Ampere, options);
  CHECK(format_json(one.model->to_json()) == format_json(three.model->to_json()));
  CHECK(one.warnings.front().find("the network beside the law has a share of") == 0);

  // The law is what its own fit finds.
  const FitReport law = identify("viscous_dahl", training, DriveUnit::Ampere, options);
  REQUIRE(one.parameters.size() == law.parameters.size());
  for (std::size_t k = 0; k < law.parameters.size(); ++k)
    if (law.parameters[k].name != "f0") CHECK(one.parameters[k].value == law.parameters[k].value);
}

TEST_CASE("where the law is the truth the network has no share, where it is poor a large one" *
          doctest::test_suite("long")) {
  const std::vector<Record> training = small_campaign({{0.01, 1}, {0.005, 3}, {0.007, 2}}).records;
  const FitReport truth =
      identify("tanh_kwok+passive_network", training, DriveUnit::Ampere, brief());
  CHECK(share_of(truth) < 1e-3);
  IdentifyOptions longer = brief();
  longer.network.epochs = 300;
  const FitReport poor = identify("dahl+passive_network", training, DriveUnit::Ampere, longer);
  CHECK(share_of(poor) > 0.3);
  CHECK(poor.training_rmse < identify("dahl", training, DriveUnit::Ampere, brief()).training_rmse);
}

TEST_CASE("what is chosen for a passive hybrid's parameter holds for its law alone") {
  IdentifyOptions options = brief();
  options.choices = {{.law = "bingham+passive_network", .parameter = "c0", .fixed = 1234},
                     {.law = "bingham", .parameter = "c0", .fixed = 5678}};
  const std::vector<Record> one = small_campaign({{0.01, 1}}).records;
  const FitReport fit = identify("bingham+passive_network", one, DriveUnit::Ampere, options);
  const auto& model = dynamic_cast<const PassiveHybridModel&>(*fit.model);
  CHECK(model.law().parameters().coefficients[0] == std::vector<double>{1234});
}
