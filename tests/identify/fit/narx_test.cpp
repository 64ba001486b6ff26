#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/narx/narx_model.h"
#include "dashpot/identify.h"
#include "dashpot/identify/fit/network_design.h"
#include "identify/small_campaign.h"
#include "support.h"

using namespace dashpot;

namespace {

Dataset sampled_campaign(std::vector<SineMotion> motions, double sample_rate = 100) {
  Dataset dataset = small_campaign(std::move(motions), {.sample_rate = sample_rate});
  for (Record& record : dataset.records)
    record.warm_up = 20;  // they begin in motion, models at rest
  return dataset;
}

IdentifyOptions with(const std::string& settings) {
  IdentifyOptions options{.starts = 2, .threads = 1};
  for (const std::string& setting : split(settings, ','))
    parse_network_setting(setting, "--network", options.network);
  return options;
}

const NarxModel& narx(const FitReport& fit) { return dynamic_cast<const NarxModel&>(*fit.model); }

}  // namespace

TEST_CASE(
    "a NARX network learns a damper in free run, with the same bits on any number of threads") {
  const std::vector<Record> training = sampled_campaign({{0.01, 1}, {0.005, 3}}).records;
  IdentifyOptions options = with("hidden=6,epochs=20,l2=1e-5");
  const FitReport one = identify("narx_one_sensor", training, DriveUnit::Ampere, options);
  options.threads = 3;
  const FitReport three = identify("narx_one_sensor", training, DriveUnit::Ampere, options);
  CHECK(format_json(one.model->to_json()) == format_json(three.model->to_json()));
  CHECK(one.offsets.size() == training.size());
  const Evaluation seen = evaluate(*one.model, training, DriveUnit::Ampere);
  CHECK(seen.pooled.esr < 1);
  CHECK_CLOSE(one.training_rmse, seen.pooled.rmse, 0.5, 0);
  REQUIRE(seen.one_step);
  CHECK(seen.one_step->esr < 1);
  CHECK(evaluate(*one.model, sampled_campaign({{0.007, 2}}).records, DriveUnit::Ampere).pooled.esr <
        3);
}

TEST_CASE("a network's design says what it reads and what comes back") {
  const std::vector<Record> training = sampled_campaign({{0.01, 1}}).records;
  const FitReport fit =
      identify("narx_two_sensors", training, DriveUnit::Ampere,
               with("hidden=3-2,activation=relu,delays=1,feedback=3,spacing=2,members=2,"
                    "training=series_parallel,output=bounded,epochs=5"));
  const NarxModel& model = narx(fit);
  CHECK(model.name() == "narx_two_sensors");
  CHECK(model.regressors().count() == 2 + 2 + 1 + 3);  // the current is steady
  CHECK(model.feedback_step() == 0.02);
  CHECK(model.members().size() == 2);
  CHECK(model.members().front().layers == std::vector<std::size_t>{8, 3, 2, 1});
  CHECK(model.members().front().activations ==
        std::vector{Activation::Relu, Activation::Relu, Activation::Tanh});
  CHECK(model.needs_displacement());
  const auto error = [&](const char* settings) {
    return identify("narx_one_sensor", training, DriveUnit::Ampere, with(settings)).training_rmse;
  };
  CHECK(error("hidden=4,l2=1e-5,trainer=lbfgs,window=60,epochs=150") <
        error("hidden=4,l2=1e-5,training=series_parallel"));
}

TEST_CASE(
    "the weight decay is found on parts of the training records, the same on any number of "
    "threads") {
  const std::vector<Record> training = sampled_campaign({{0.01, 1}, {0.005, 3}}).records;
  IdentifyOptions options = with("hidden=3,epochs=5");
  const FitReport one = identify("narx_one_sensor", training, DriveUnit::Ampere, options);
  options.threads = 3;
  CHECK(format_json(
            identify("narx_one_sensor", training, DriveUnit::Ampere, options).model->to_json()) ==
        format_json(one.model->to_json()));
  std::size_t tried = 0;
  for (const char* decay : {"1e-2", "1e-3", "1e-4", "1e-5"}) {
    const std::string settings = std::string("hidden=3,epochs=5,l2=") + decay;
    tried += format_json(identify("narx_one_sensor", training, DriveUnit::Ampere, with(settings))
                             .model->to_json()) == format_json(one.model->to_json());
  }
  CHECK(tried == 1);
}

TEST_CASE(
    "a step of the network is a millisecond, or a sample where that is longer, unless stated") {
  const std::vector<Record> training = sampled_campaign({{0.01, 1}}, 3000).records;
  const auto step = [&](const std::string& settings) {
    return narx(identify("narx_one_sensor", training, DriveUnit::Ampere,
                         with("hidden=2,epochs=2,l2=1e-5" + settings)))
        .feedback_step();
  };
  CHECK_CLOSE(step(""), 1e-3, 1e-12, 0);
  CHECK_CLOSE(step(",spacing=1"), 1.0 / 3000, 1e-12, 0);
}

TEST_CASE("a model that can diverge says so, a bounded one does not") {
  const std::vector<Record> training = sampled_campaign({{0.01, 1}}).records;
  const auto warnings = [&](const std::string& settings) {
    return identify("narx_one_sensor", training, DriveUnit::Ampere,
                    with("hidden=3,epochs=3,activation=relu" + settings))
        .warnings.size();
  };
  CHECK(warnings("") == 1);
  CHECK(warnings(",output=bounded") == 0);
  CHECK(message_of([&] {
          identify("narx_one_sensor", training, DriveUnit::Ampere, with("trainer=adam"));
        }).find("lm or lbfgs") != std::string::npos);
}

TEST_CASE("a static preset with delays reads past inputs and feeds nothing back") {
  const std::vector<Record> training = sampled_campaign({{0.01, 1}, {0.005, 3}}).records;
  const FitReport fit =
      identify("mlp_one_sensor", training, DriveUnit::Ampere, with("hidden=5,l2=1e-4,delays=2"));
  CHECK(narx(fit).regressors().count() == 3 + 1);
  CHECK(fit.model->name() == "mlp_one_sensor");
  const Evaluation seen = evaluate(*fit.model, training, DriveUnit::Ampere);
  CHECK_FALSE(seen.one_step);
  const FitReport present =
      identify("mlp_one_sensor", training, DriveUnit::Ampere, with("hidden=5"));
  CHECK(seen.pooled.esr <
        evaluate(*present.model, training, DriveUnit::Ampere).pooled.esr);  // there is hysteresis
}

TEST_CASE("records of several rates are brought to the step of the slowest") {
  std::vector<Record> training = sampled_campaign({{0.01, 1}}, 100).records;
  for (const Record& record : sampled_campaign({{0.01, 1.5}}, 250).records)
    training.push_back(record);
  const FitReport fit =
      identify("narx_one_sensor", training, DriveUnit::Ampere, with("hidden=4,epochs=15,l2=1e-5"));
  CHECK(fit.model->feedback_step() == 0.01);
  const Evaluation seen = evaluate(*fit.model, training, DriveUnit::Ampere);
  CHECK(seen.pooled.esr < 3);
  REQUIRE(seen.one_step);
  CHECK(seen.one_step->esr < 3);
}

TEST_CASE("records that are shorter than the network's past are refused") {
  std::vector<Record> training = {sampled_campaign({{0.01, 1}}).records.front().slice(0, 10)};
  const std::string message = message_of(
      [&] { identify("narx_one_sensor", training, DriveUnit::Ampere, with("delays=20")); });
  CHECK(message.find("no record is longer than the network's past") != std::string::npos);
}
