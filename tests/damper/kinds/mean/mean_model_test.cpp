#include "dashpot/damper/kinds/mean/mean_model.h"

#include <cmath>

#include "damper/kinds/narx/narx_example.h"
#include "damper/kinds/passive_network/passive_network_example.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/narx/narx_model.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/registry.h"
#include "dashpot/identify.h"
#include "identify/small_campaign.h"
#include "support.h"

using namespace dashpot;

namespace {

DamperInput moved_at(double time) {
  return {0.01 * std::sin(20 * time), 0.2 * std::cos(20 * time), 1 + std::sin(3 * time)};
}

const LawModel& member_law() {
  static const LawModel kMemberLaw = load_parameters("spencer1997");
  return kMemberLaw;
}

const PassiveNetworkModel& member_network() {
  static const PassiveNetworkModel kMemberNetwork(
      "passive_network", {example_passive_network(1), example_passive_network(2)});
  return kMemberNetwork;
}

MeanModel example_mean(double offset = 2) {
  return MeanModel({{member_law().with_offset(0), 0.3}, {member_network().with_offset(0), 0.7}},
                   offset);
}

}  // namespace

TEST_CASE("each member of a mean goes on as by itself, and their forces are weighted") {
  const MeanModel mean = example_mean();
  CHECK(mean.needs_displacement());
  CHECK(mean.parameter_count() ==
        member_law().parameter_count() + member_network().parameter_count() + 1);
  std::vector<double> state(mean.state_size()), of_law(member_law().state_size()),
      of_network(member_network().state_size());
  mean.rest(moved_at(0), state);
  member_law().rest(moved_at(0), of_law);
  member_network().rest(moved_at(0), of_network);
  for (int k = 0; k < 200; ++k) {
    const DamperInput from = moved_at(k * 1e-3), to = moved_at((k + 1) * 1e-3);
    mean.advance(from, to, 1e-3, state);
    member_law().advance(from, to, 1e-3, of_law);
    member_network().advance(from, to, 1e-3, of_network);
    const double a = member_law().force(to, of_law), b = member_network().force(to, of_network);
    CHECK_CLOSE(mean.force(to, state), 0.3 * a + 0.7 * b + 2, 1e-12, 0);

    // Two members that differ by d scatter by sqrt(w (1 - w)) |d|, and the network within itself.
    const double within = member_network().spread(to, of_network);
    CHECK_CLOSE(mean.spread(to, state),
                std::sqrt(0.3 * 0.7 * (a - b) * (a - b) + 0.7 * within * within), 1e-9, 1e-9);
  }
}

TEST_CASE("offsets of a mean add up, and JSON keeps every bit of it") {
  const auto moved = example_mean().with_offset(3);
  const auto back = read_model(ModelKind::Mean, parse_json(format_json(moved->to_json()), "m"));
  CHECK(format_json(back->to_json()) == format_json(moved->to_json()));
  CHECK(model_as<MeanModel>(*back)->offset() == 5);
  std::vector<double> state(moved->state_size());
  moved->rest(moved_at(0.1), state);
  CHECK(back->force(moved_at(0.1), state) == moved->force(moved_at(0.1), state));
}

TEST_CASE("a mean of too few, of wrong weights or of models that cannot be members is refused") {
  const auto said = [](std::vector<MeanModel::Member> members) {
    return message_of([&] { MeanModel(std::move(members), 0, "m.json"); });
  };
  const std::shared_ptr<const DamperModel> one = member_law().with_offset(0), two = one;
  CHECK(said({{one, 1}}).find("m.json: has 1 members") == 0);
  CHECK(said({{one, 0.5}, {two, 0.4}}).find("weights that add up to 0.9") != std::string::npos);
  CHECK(said({{one, 1.5}, {two, -0.5}}).find("the weight -0.5") != std::string::npos);

  // One that feeds its force back, and a mean within a mean.
  const Regressors regressors = example_regressors();
  const std::shared_ptr<const DamperModel> fed_back =
      NarxModel("narx_one_sensor", regressors, {example_narx_network(regressors)}, 0)
          .with_offset(0);
  CHECK(said({{one, 0.5}, {fed_back, 0.5}}).find("the member narx_one_sensor") !=
        std::string::npos);
  CHECK(said({{one, 0.5}, {example_mean().with_offset(0), 0.5}}).find("the member mean") !=
        std::string::npos);
}

TEST_CASE("a mean is not fitted by itself") {
  CHECK(message_of([] {
          identify("mean", small_campaign({{0.01, 1}}).records, DriveUnit::Ampere, {});
        }).find("is made of other models") != std::string::npos);
}
