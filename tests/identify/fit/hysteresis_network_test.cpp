#include "dashpot/damper/kinds/hysteresis_network/hysteresis_network_model.h"
#include "dashpot/identify.h"
#include "identify/small_campaign.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("a hysteresis network learns a damper, with the same bits on any number of threads" *
          doctest::test_suite("long")) {
  const std::vector<Record> training = small_campaign({{0.01, 1}, {0.005, 3}}).records;
  IdentifyOptions options{.threads = 1};
  options.network.members = 2;
  const FitReport one = identify("hysteresis_network", training, DriveUnit::Ampere, options);
  options.threads = 3;
  const FitReport three = identify("hysteresis_network", training, DriveUnit::Ampere, options);
  CHECK(format_json(one.model->to_json()) == format_json(three.model->to_json()));
  CHECK(one.model->parameter_count() == 2 * 165);
  CHECK(one.offsets.size() == training.size());
  // A motion between those that it has seen; resolution of the sensors and derived velocity leave
  // something.
  const Evaluation unseen =
      evaluate(*one.model, small_campaign({{0.007, 2}}).records, DriveUnit::Ampere);
  CHECK(unseen.pooled.esr < 2);
}

TEST_CASE("one record serves too: its end is held back to choose the weight decay" *
          doctest::test_suite("long")) {
  std::vector<Record> one = {small_campaign({{0.01, 1}}).records.back()};
  const FitReport fit = identify("hysteresis_network", one, DriveUnit::Ampere, {});
  REQUIRE(fit.model);
  CHECK(evaluate(*fit.model, one, DriveUnit::Ampere).pooled.esr < 1);
}

TEST_CASE("a hysteresis network as its design says") {
  const std::vector<Record> training = small_campaign({{0.01, 1}}).records;
  IdentifyOptions options{.allow_active = true, .threads = 1};
  options.network = {.hidden = {3}, .epochs = 4, .l2 = 1e-3, .members = 2};
  const FitReport fit = identify("hysteresis_network", training, DriveUnit::Ampere, options);
  const auto& network = dynamic_cast<const HysteresisNetworkModel&>(*fit.model);
  REQUIRE(network.members().size() == 2);
  CHECK(network.members()[1].network.hidden() == 3);
  CHECK(fit.iterations <= 4);
  options.network.l2 = 1;
  CHECK(format_json(identify("hysteresis_network", training, DriveUnit::Ampere, options)
                        .model->to_json()) != format_json(fit.model->to_json()));
  options.network.hidden = {3, 3};
  CHECK(message_of([&] {
          identify("hysteresis_network", training, DriveUnit::Ampere, options);
        }).find("has one hidden layer") != std::string::npos);
}
