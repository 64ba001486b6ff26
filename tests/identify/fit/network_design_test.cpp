#include "dashpot/identify/fit/network_design.h"

#include "dashpot/base/text.h"
#include "dashpot/identify/fit/fit.h"
#include "support.h"

using namespace dashpot;

namespace {

NetworkDesign parsed(const std::vector<std::string>& texts) {
  NetworkDesign design;
  for (const std::string& text : texts) parse_network_setting(text, "--network", design);
  return design;
}

std::string design_refusal(const std::string& text) {
  return message_of([&] { parsed({text}); });
}

}  // namespace

TEST_CASE("a network's design is read, written and read again") {
  const NetworkDesign design =
      parsed({"hidden=15-20", "activation=relu", "trainer=adamw", "rate=1e-3", "schedule=step",
              "batch=20", "epochs=100", "l1=0", "l2=3e-4", "patience=0", "members=5", "delays=2",
              "feedback=1", "training=free_run"});
  CHECK(design.hidden == std::vector<std::size_t>{15, 20});
  CHECK(design.activation == Activation::Relu);
  CHECK(design.trainer == Trainer::AdamW);
  CHECK(design.rate == 1e-3);
  CHECK(design.patience == 0);
  CHECK(design.training == FeedbackTraining::FreeRun);
  const std::string text = format_design(design);
  CHECK(text.starts_with(
      "hidden=15-20,activation=relu,trainer=adamw,rate=0.001,schedule=step,batch=20"));
  CHECK(parsed(split(text, ',')) == design);
  CHECK(format_design({}).empty());
}

TEST_CASE("a wrong setting is told, with what would be right") {
  CHECK(design_refusal("hiden=3").find("did you mean 'hidden'") != std::string::npos);
  CHECK(design_refusal("hidden").find("has no value") != std::string::npos);
  CHECK(design_refusal("hidden=15-0").find("a whole number from 1") != std::string::npos);
  CHECK(design_refusal("hidden=500").find("at most 128") != std::string::npos);
  CHECK(design_refusal("trainer=adm").find("did you mean 'adam'") != std::string::npos);
  CHECK(design_refusal("rate=0").find("a number above 0") != std::string::npos);
  CHECK(design_refusal("l2=-1").find("a number of 0 or more") != std::string::npos);
  CHECK(design_refusal("members=1000").find("from 1 to 100") != std::string::npos);
  CHECK(design_refusal("schedule=cosin").find("did you mean 'cosine'") != std::string::npos);
  CHECK(design_refusal("batch=2.5").find("a whole number") != std::string::npos);
}

TEST_CASE("what no model follows is refused") {
  const std::string message =
      message_of([] { require_design(parsed({"rate=1e-3"}), {"bingham"}); });
  CHECK(message.find("none of the models follows 'rate'") != std::string::npos);
  require_design(parsed({"trainer=adam", "rate=1e-3"}), {"bingham", "mlp_one_sensor"});
  require_design(parsed({"hidden=8", "epochs=9", "l2=0", "members=2"}), {"hysteresis_network"});
}

TEST_CASE("what the trainer does not use is refused") {
  const auto refused = [](const std::vector<std::string>& texts) {
    return message_of([&] { require_design(parsed(texts), {"mlp_one_sensor"}); });
  };
  CHECK(refused({"rate=1e-3"}) ==
        "--network rate: trainer=lm, the usual one, has none; choose a batch trainer, as "
        "trainer=adam");
  for (const char* trainer : {"lm", "bayesian", "lbfgs"})
    for (const char* setting : {"rate=1e-3", "schedule=step", "batch=20", "l1=1e-5"}) {
      const std::string message = refused({std::string("trainer=") + trainer, setting});
      CAPTURE(message);
      CHECK(message.find("choose a batch trainer") != std::string::npos);
    }
  CHECK(refused({"trainer=bayesian", "l2=1e-3"}).find("finds the weight decay by itself") !=
        std::string::npos);
  for (const char* trainer : {"lm", "lbfgs", "sgd", "momentum", "rmsprop", "adam", "adamw"})
    CHECK(refused({std::string("trainer=") + trainer, "l2=1e-3", "patience=5"}).empty());
}
