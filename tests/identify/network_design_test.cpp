#include "dashpot/identify/network_design.h"

#include "dashpot/base/text.h"
#include "support.h"

using namespace dashpot;

namespace {

NetworkDesign parsed(const std::vector<std::string>& texts) {
  NetworkDesign design;
  for (const std::string& text : texts) parse_network_setting(text, "--network", design);
  return design;
}

std::string refusal(const std::string& text) {
  return message_of([&] { parsed({text}); });
}

}  // namespace

TEST_CASE("a network's design is read, written and read again") {
  const NetworkDesign design =
      parsed({"hidden=15-20", "activation=relu", "trainer=adamw", "rate=1e-3", "batch=20", "epochs=100",
              "l1=0", "l2=3e-4", "patience=0", "members=5", "delays=2", "feedback=1", "training=free_run"});
  CHECK(design.hidden == std::vector<std::size_t>{15, 20});
  CHECK(design.activation == Activation::Relu);
  CHECK(design.trainer == Trainer::AdamW);
  CHECK(design.rate == 1e-3);
  CHECK(design.patience == 0);
  CHECK(design.training == FeedbackTraining::FreeRun);
  const std::string text = format_design(design);
  CHECK(text.starts_with("hidden=15-20,activation=relu,trainer=adamw,rate=0.001,batch=20"));
  CHECK(parsed(split(text, ',')) == design);
  CHECK(format_design({}).empty());
}

TEST_CASE("a wrong setting is told, with what would be right") {
  CHECK(refusal("hiden=3").find("did you mean 'hidden'") != std::string::npos);
  CHECK(refusal("hidden").find("has no value") != std::string::npos);
  CHECK(refusal("hidden=15-0").find("a whole number from 1") != std::string::npos);
  CHECK(refusal("hidden=500").find("at most 128") != std::string::npos);
  CHECK(refusal("trainer=adm").find("did you mean 'adam'") != std::string::npos);
  CHECK(refusal("rate=0").find("a number above 0") != std::string::npos);
  CHECK(refusal("l2=-1").find("a number of 0 or more") != std::string::npos);
  CHECK(refusal("batch=2.5").find("a whole number") != std::string::npos);
}

TEST_CASE("what no model follows is refused") {
  const std::string message = message_of([] { require_design(parsed({"rate=1e-3"}), {"bingham"}); });
  CHECK(message.find("none of the models follows 'rate'") != std::string::npos);
  require_design(parsed({"rate=1e-3"}), {"bingham", "mlp_one_sensor"});
}
