#include "dashpot/damper/kinds/passive_network/passive_network_model.h"
#include "dashpot/identify.h"
#include "identify/small_campaign.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("a passive network learns a damper, with the same bits on any number of threads" *
          doctest::test_suite("long")) {
  const std::vector<Record> training = small_campaign({{0.01, 1}, {0.005, 3}}).records;
  IdentifyOptions options{.threads = 1};
  options.network = {.epochs = 300, .members = 2};
  const FitReport one = identify("passive_network", training, DriveUnit::Ampere, options);
  options.threads = 3;
  const FitReport three = identify("passive_network", training, DriveUnit::Ampere, options);
  CHECK(format_json(one.model->to_json()) == format_json(three.model->to_json()));
  const Evaluation unseen =
      evaluate(*one.model, small_campaign({{0.007, 2}}).records, DriveUnit::Ampere);
  CHECK(unseen.pooled.esr < 2);
}

TEST_CASE("a passive network is built as the design says") {
  const std::vector<Record> one = {small_campaign({{0.01, 1}}).records.back()};
  IdentifyOptions options;
  options.network = {.hidden = {5, 3}, .epochs = 10, .members = 1};
  const FitReport fit = identify("passive_network_one_sensor", one, DriveUnit::Ampere, options);
  const auto* model = dynamic_cast<const PassiveNetworkModel*>(fit.model.get());
  REQUIRE(model);
  CHECK(model->members().size() == 1);
  CHECK(model->members()[0].sizes.neurons == 5);
  CHECK(model->members()[0].sizes.viscous_neurons == 3);
  CHECK_FALSE(model->needs_displacement());
  options.network.hidden = {49};
  CHECK(message_of([&] {
          identify("passive_network", one, DriveUnit::Ampere, options);
        }).find("1 to 48") != std::string::npos);
}
