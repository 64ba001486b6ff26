#include "dashpot/damper/kinds/passive_hybrid/passive_hybrid_model.h"

#include <cmath>

#include "dashpot/base/random.h"
#include "dashpot/damper/inverse/observer.h"
#include "dashpot/damper/registry.h"
#include "dashpot/model_file.h"
#include "passive_hybrid_example.h"
#include "support.h"

using namespace dashpot;

namespace {

DamperInput at(double time) {
  return {0.01 * std::sin(20 * time), 0.2 * std::cos(20 * time), 1 + std::sin(3 * time)};
}

/// A Bingham damper with friction that follows the current, beside a random network.
PassiveHybridModel of_bingham(std::uint64_t seed, double network_share) {
  const Law& law = find_law("bingham");
  Dependence d{std::vector<Form>(law.params.size(), Form::Constant), {{800}, {100}, {0}, {0.01}}};
  d.forms[1] = Form::Linear;
  d.coefficients[1] = {100, 300};
  return {LawModel(law, d, DriveUnit::Ampere, 0),
          {"passive_network", {example_passive_network(seed, 1)}},
          network_share};
}

}  // namespace

TEST_CASE("law and network share a motion, and neither knows of the other") {
  const PassiveHybridModel model = example_passive_hybrid();
  CHECK(model.name() == "modified_bouc_wen+passive_network");
  CHECK(model.kind() == ModelKind::PassiveHybrid);
  CHECK(model.needs_displacement());
  std::vector<double> state(model.state_size()), of_law(model.law().state_size()),
      of_network(model.network().state_size());
  model.rest(at(0), state);
  model.law().rest(at(0), of_law);
  model.network().rest(at(0), of_network);
  for (int k = 0; k < 200; ++k) {
    const DamperInput from = at(k * 1e-3), to = at((k + 1) * 1e-3);
    model.advance(from, to, 1e-3, state);
    model.law().advance(from, to, 1e-3, of_law);
    model.network().advance(from, to, 1e-3, of_network);
    const double force =
        0.7 * model.law().force(to, of_law) + 0.3 * model.network().force(to, of_network) + 2;
    CHECK_CLOSE(model.force(to, state), force, 1e-13, 0);
    CHECK_CLOSE(model.spread(to, state), 0.3 * model.network().spread(to, of_network), 1e-13, 0);
  }
}

TEST_CASE("with any network and share, no more comes out than went in, whatever the current does") {
  Random random(3);
  constexpr double kStep = 1e-5;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const PassiveHybridModel model = of_bingham(seed, random.uniform());
    const PassiveNetworkModel& network = model.network();
    DamperInput now;
    std::vector<double> state(model.state_size());
    model.rest(now, state);
    const double begin = network.stored_energy(now, state);
    double work = 0, turned_over = 0, worst = -INFINITY;
    for (int k = 0; k < 400; ++k) {
      DamperInput next = now;
      next.velocity = 0.98 * now.velocity + 0.05 * random.normal();
      next.displacement += kStep * (now.velocity + next.velocity) / 2;
      if (random.uniform() < 0.02) next.current = 2 * random.uniform();
      const double before = model.force(now, state) * now.velocity;
      model.advance(now, next, kStep, state);
      const double done = kStep * (before + model.force(next, state) * next.velocity) / 2;
      work += done;
      turned_over += std::abs(done);
      now = next;
      // The law stores nothing: what is stored is the network's, by its share.
      const double stored = model.network_share() * (network.stored_energy(now, state) - begin);
      worst = std::max(worst, stored - work);
    }
    CAPTURE(seed);
    CHECK(worst <= 1e-4 * turned_over + 1e-12);
  }
}

TEST_CASE("a passive hybrid has a law that dissipates wherever its bounds hold, and no other") {
  CHECK(dissipation(example_passive_hybrid(), {-0.02, 0.02, -0.3, 0.3, 0, 2}).dissipates());
  const std::string said = message_of([] {
    PassiveHybridModel(load_parameters("vrths_mr_tanh_acceleration"),
                       {"passive_network", {example_passive_network()}}, 0.5);
  });
  CHECK(said.find("has the law tanh_acceleration, which may feed energy in") != std::string::npos);
}

TEST_CASE("offsets add up, and JSON keeps every bit of a passive hybrid") {
  const auto moved = example_passive_hybrid().with_offset(3);
  const auto back = passive_hybrid_model_from_json(parse_json(format_json(moved->to_json()), "m"));
  CHECK(format_json(back->to_json()) == format_json(moved->to_json()));
  CHECK(back->offset() == 5);
  std::vector<double> state(moved->state_size());
  moved->rest(at(0.1), state);
  CHECK(back->force(at(0.1), state) == moved->force(at(0.1), state));
}

TEST_CASE("a passive hybrid that could generate energy is refused") {
  const auto message = [](const std::string& from, const std::string& to) {
    std::string text = format_json(example_passive_hybrid().to_json(), false);
    const std::size_t place = text.find(from);
    REQUIRE(place != std::string::npos);
    text.replace(place, from.size(), to);
    return message_of([&] { passive_hybrid_model_from_json(parse_json(text, "m.json")); });
  };
  for (const char* share : {"-0.3", "1.3"}) {
    const std::string said =
        message("\"network_share\":0.3", "\"network_share\":" + std::string(share));
    CAPTURE(said);
    CHECK(said.find("m.json") == 0);
    CHECK(said.find("the network's share is " + std::string(share)) != std::string::npos);
    CHECK(said.find("would generate energy") != std::string::npos);
  }
  CHECK(message("\"network_share\"", "\"netwrk_share\"").find("needs 'network_share'") !=
        std::string::npos);
  CHECK(message("\"saturation\":[", "\"saturation\":[-").find("would generate energy") !=
        std::string::npos);

  // In a model file the law keeps to its bounds, all over the file's currents.
  ModelFile file{.model = std::make_unique<PassiveHybridModel>(of_bingham(1, 0.5)),
                 .domain = {-0.02, 0.02, -0.3, 0.3, -1, 2}};
  CHECK(message_of([&] { parse_model(format_model(file), "m.json"); }).find("f_c is -200 N") !=
        std::string::npos);
}

TEST_CASE("an observer keeps the lags of a law and of a network beside it apart") {
  const BareDamper bare = without_coil_lag(example_passive_hybrid());
  CHECK(bare.lag_rate == 0);
  CHECK(bare.model->kind() == ModelKind::PassiveHybrid);
}
