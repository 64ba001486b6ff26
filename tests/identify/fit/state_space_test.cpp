#include "dashpot/damper/kinds/state_space/state_space_model.h"
#include "dashpot/identify.h"
#include "identify/small_campaign.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("a neural state space learns a damper, with the same bits on any number of threads" *
          doctest::test_suite("long")) {
  const std::vector<Record> training = small_campaign({{0.01, 1}, {0.005, 3}}).records;
  IdentifyOptions options{.threads = 1};
  options.network = {.epochs = 8, .members = 2};
  const FitReport one = identify("neural_state_space", training, DriveUnit::Ampere, options);
  options.threads = 3;
  const FitReport three = identify("neural_state_space", training, DriveUnit::Ampere, options);
  CHECK(format_json(one.model->to_json()) == format_json(three.model->to_json()));
  CHECK(one.offsets.size() == training.size());
  const Evaluation unseen =
      evaluate(*one.model, small_campaign({{0.007, 2}}).records, DriveUnit::Ampere);
  CHECK(unseen.pooled.esr < 2);
}

TEST_CASE("a neural state space is built and trained as the design says") {
  const std::vector<Record> one = {small_campaign({{0.01, 1}}).records.back()};
  IdentifyOptions options;
  options.network = {.hidden = {2, 3}, .epochs = 4, .l2 = 1e-3, .members = 1};
  const FitReport fit = identify("neural_state_space", one, DriveUnit::Ampere, options);
  const auto* model = dynamic_cast<const StateSpaceModel*>(fit.model.get());
  REQUIRE(model);
  CHECK(model->members().size() == 1);
  CHECK(model->members()[0].cell.hidden() == 2);
  CHECK(model->members()[0].network.hidden() == 3);
  CHECK(fit.iterations <= 4);
  CHECK(evaluate(*fit.model, one, DriveUnit::Ampere).pooled.esr < 2);
  options.network.hidden = {33};
  CHECK(message_of([&] {
          identify("neural_state_space", one, DriveUnit::Ampere, options);
        }).find("at most 32") != std::string::npos);
}
