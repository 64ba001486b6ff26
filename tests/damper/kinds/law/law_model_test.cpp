#include "dashpot/damper/kinds/law/law_model.h"

#include <vector>

#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/registry.h"
#include "dashpot/value.h"
#include "support.h"

using namespace dashpot;

namespace {

/// F = i v, where i is the current in the coil.
LawModel current_times_speed(double rate) {
  return LawModel(
      find_law("bingham"),
      {{Form::Linear, Form::Constant, Form::Constant, Form::Constant}, {{0, 1}, {0}, {0}, {0}}},
      DriveUnit::Ampere, rate);
}

}  // namespace

TEST_CASE("the current in the coil lags exactly, for a step and for a ramp") {
  const LawModel model = current_times_speed(80);
  REQUIRE(model.state_size() == 1);
  std::vector<double> state(1);
  model.rest({0, 0, 0.5}, state);
  CHECK(state[0] == 0.5);
  for (int k = 0; k < 10; ++k) model.advance({0, 1, 2}, {0, 1, 2}, 0.003, state);
  CHECK_CLOSE(state[0], 2 - 1.5 * std::exp(-80 * 0.03), 1e-13, 0);
  CHECK_CLOSE(model.force({0, 1, 99}, state), state[0], 1e-15,
              0);  // the coil's current counts, not the command

  // i' = -r (i - s t), i(0) = 0: i = s t - s/r (1 - exp(-r t)), in one step
  model.rest({}, state);
  model.advance({0, 0, 0}, {0, 0, 5}, 0.05, state);
  CHECK_CLOSE(state[0], 5 - 100.0 / 80 * (1 - std::exp(-80 * 0.05)), 1e-13, 0);
}

TEST_CASE("without lag the command is the current, and there is no state for it") {
  const LawModel model = current_times_speed(0);
  CHECK(model.state_size() == 0);
  CHECK(model.force({0, 3, 2}, {}) == 6);
}

TEST_CASE("the offset goes into the bias and nowhere else") {
  const LawModel model = load_parameters("kwok2006");
  const auto moved = model.with_offset(12.5);
  for (const double i : {0.0, 1.3})
    CHECK_CLOSE(moved->force({0.01, 0.1, i}, {}), model.force({0.01, 0.1, i}, {}) + 12.5, 1e-14, 0);
  const auto& after = static_cast<const LawModel&>(*moved).parameters().coefficients;
  CHECK(after[model.law().index_of("f0")] == std::vector<double>{69.5, -18});
  CHECK(after[0] == model.parameters().coefficients[0]);
}

TEST_CASE("free coefficients are counted") {
  CHECK(load_parameters("kwok2006").parameter_count() == 12);     // 2 + 2 + 3 + 1 + 2 + 2
  CHECK(load_parameters("spencer1997").parameter_count() == 11);  // without x0, A and n
}

TEST_CASE("large steps are divided: 500 Hz samples follow the converged force") {
  const LawModel model = load_parameters("spencer1997");
  const auto at = [](double t) {
    return DamperInput{0.015 * std::sin(15.708 * t), 0.015 * 15.708 * std::cos(15.708 * t), 1.5};
  };
  double worst = 0;
  std::vector<double> coarse(3), fine(3);
  model.rest(at(0), coarse);
  fine = coarse;
  for (int k = 0; k < 500; ++k) {
    const double t = 0.002 * k, h = 0.002 / 200;
    model.advance(at(t), at(t + 0.002), 0.002, coarse);
    for (int s = 0; s < 200; ++s) model.advance(at(t + s * h), at(t + (s + 1) * h), h, fine);
    worst = std::max(
        worst, std::abs(model.force(at(t + 0.002), coarse) - model.force(at(t + 0.002), fine)));
  }
  CHECK(worst <
        3);  // N, of a span of 2500 N: 2.0 at the two reversals of a period, below 0.1 elsewhere
}

TEST_CASE("a hopelessly stiff law ends as a force that is not finite, in bounded time") {
  // between the wells of k1 < 0 this law has no step of its own that is so long
  const LawModel model =
      LawModel::constant(find_law("landau_surrogate"), {800, 1000, 1e-6, 1e-6, -10, 0, 1, 0});
  std::vector<double> state(1);
  model.rest({}, state);
  for (int k = 0; k < 20; ++k) model.advance({0, 1, 0}, {0, 1, 0}, 0.1, state);
  CHECK_FALSE(std::isfinite(model.force({0, 1, 0}, state)));
}

TEST_CASE("the law's own step: bounded at any stiffness, and of second order") {
  const Law& law = find_law("modified_bouc_wen");
  const double z_max = std::sqrt(301 / 2e8);
  const LawModel stiff = LawModel::constant(law, {1e6, 100, 2e4, 0, 0, 0, 1e8, 1e8, 301, 2, 0});
  std::vector<double> state(2);
  stiff.rest({}, state);
  for (int k = 0; k < 200; ++k) {
    const double v = std::cos(0.1 * k), next = std::cos(0.1 * (k + 1));
    stiff.advance({0, v, 0}, {0, next, 0}, 0.1, state);
    CHECK(std::abs(state[1]) <= z_max * (1 + 1e-12));
  }
  // Straight-line motion through a reversal: halving the step divides the error by four.
  const auto end_of = [&](int steps) {
    const double p[] = {118250, 2625, 28742.5, 4690, 500, 0, 3.63e6, 3.63e6, 301, 2, 0};
    double z[] = {0, -0.005};
    const double h = 4e-3 / steps;
    for (int k = 0; k < steps; ++k) {
      const double x[] = {1e-4 * k / steps, 1e-4 * (k + 1) / steps}, v[] = {0.025, 0.025};
      REQUIRE(law.step(p, x, v, h, z) == 1);
    }
    return z[1];
  };
  const double truth = end_of(4096);
  CHECK_CLOSE((end_of(16) - truth) / (end_of(32) - truth), 4, 0.1, 0);
}

TEST_CASE("a wrong number of parameters or coefficients is refused") {
  const Law& law = find_law("bingham");
  CHECK(message_of([&] { LawModel::constant(law, {1, 2}); }) ==
        "parameters of bingham: got 2; the law has 4");
  CHECK(message_of([&] {
          LawModel(law,
                   {{Form::Linear, Form::Constant, Form::Constant, Form::Constant},
                    {{1}, {0}, {0}, {0}}},
                   DriveUnit::Ampere, 0);
        }) == "parameters of bingham, c0: has 1 coefficients; a linear one has 2");
  CHECK(message_of([&] {
          LawModel(law, load_parameters("kwok2006").parameters(), DriveUnit::Ampere, 0);
        }) != "");
  CHECK(message_of([&] {
          LawModel(law, LawModel::constant(law, {1, 2, 3, 0}).parameters(), DriveUnit::Ampere, -1);
        }) == "lag_rate: is -1; write a rate in 1/s, 0 for none");
}

TEST_CASE("JSON: what is unknown, missing or of the wrong kind is refused by its key") {
  const std::string good =
      format_json(LawModel::constant(find_law("bingham"), {1, 2, 3, 0}).to_json(), false);
  const auto message = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
    return message_of([&] { law_model_from_json(parse_json(text, "model.json")); });
  };
  const auto mentions = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  CHECK(message("bingham", "bingham") == "");
  CHECK(mentions(message("bingham", "bingam"), "did you mean 'bingham'"));
  CHECK(mentions(message("\"f_c\"", "\"fc\""), "needs 'f_c'"));
  CHECK(mentions(message("\"v_s\":", "\"w\":1,\"v_s\":"), "unknown key 'w'"));
  CHECK(mentions(message("\"lag_rate\"", "\"lag\""), "needs 'lag_rate'"));
  CHECK(mentions(message("constant", "quartic"), "unknown form 'quartic'"));
  CHECK(mentions(message("constant", "linear"), "has 1 numbers; a linear parameter has 2"));
  CHECK(mentions(message("N*s/m", "m"), "'m' does not measure c0"));
  CHECK(mentions(message("[1", "[\"1\""), "not a number"));
  CHECK(mentions(message("\"A\"", "\"kV\""), "drive_unit"));
}
