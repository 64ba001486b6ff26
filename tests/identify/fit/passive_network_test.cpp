#include "dashpot/damper/kinds/passive_network/passive_network_model.h"
#include "dashpot/identify.h"
#include "dashpot/identify/fit/passive_network_fit.h"
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

TEST_CASE(
    "a passive network's efforts are tried on motions, ends of the drive, or what comes later") {
  const auto trials_of = [](const Dataset& data) {
    return passive_trials(data.records, drive_range(data.records, DriveUnit::Ampere));
  };
  const PassiveTrials strange =
      trials_of(small_campaign({{0.01, 1}, {0.005, 3}}, {.drive_levels = {0, 0.5, 1}}));
  CHECK_FALSE(strange.later);
  REQUIRE(strange.folds.size() == 4);  // two motions, two ends, each pair a half
  CHECK(strange.folds[0].fold.left_out.size() == 3);
  CHECK(strange.folds[3].fold.left_out.front().drive_level == 1);
  CHECK(strange.folds[3].weight == 0.5);

  // One motion at two levels: the ends of its records.
  const Dataset same = small_campaign({{0.01, 1}});
  const PassiveTrials later = trials_of(same);
  CHECK(later.later);
  REQUIRE(later.folds.size() == 1);
  const Record& before = later.folds[0].fold.training.front();
  const Record& after = later.folds[0].fold.left_out.front();
  CHECK(before.size() < same.records.front().size());
  CHECK(after.warm_up == before.size());
}

TEST_CASE("a passive network learns as long as asked where more of the same is to come") {
  const std::vector<Record> same = small_campaign({{0.01, 1}}).records;
  IdentifyOptions options;
  options.network = {.epochs = 7, .members = 1};
  CHECK(identify("passive_network", same, DriveUnit::Ampere, options).iterations == 7);
}
