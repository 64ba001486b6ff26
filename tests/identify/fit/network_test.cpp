#include <cmath>
#include <numbers>

#include "dashpot/base/random.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/network/network_model.h"
#include "dashpot/error.h"
#include "dashpot/identify.h"
#include "dashpot/identify/fit/network_design.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A static damper that a few neurons can follow.
double true_force(double velocity, double current) {
  return 400 * velocity + (100 + 300 * current) * std::tanh(velocity / 0.15);
}

/// A sine of top speed 0.6 m/s under it with noise and a force zero of its own.
Record sine(double frequency, double current, double offset, double noise) {
  Record record;
  record.condition = format_number(frequency) + " Hz";
  record.name = record.condition + " " + format_number(current) + " A";
  record.drive_level = current;
  record.sample_time = 0.01;
  Random random(static_cast<std::uint64_t>(10 * frequency + current));
  Channel v{"velocity", "m/s", {}, ""}, f{"force", "N", {}, ""}, i{"current", "A", {}, ""};
  for (std::size_t k = 0; k < 150; ++k) {
    const double t = 0.01 * static_cast<double>(k);
    record.time.push_back(t);
    v.samples.push_back(0.2 * frequency * std::cos(2 * std::numbers::pi * frequency * t));
    f.samples.push_back(true_force(v.samples[k], current) + offset + noise * random.normal());
    i.samples.push_back(current);
  }
  record.channels = {v, f, i};
  return record;
}

/// The force zeros sum up to nothing at each current and at each frequency: neither explains them.
std::vector<Record> campaign() {
  constexpr double kOffsets[] = {60, -60, 0};
  std::vector<Record> records;
  for (std::size_t f = 0; f < 3; ++f)
    for (std::size_t c = 0; c < 3; ++c)
      records.push_back(
          sine(1 + static_cast<double>(f), 0.5 * static_cast<double>(c), kOffsets[(f + c) % 3], 5));
  return records;
}

FitReport fitted(const std::vector<std::string>& settings, const std::vector<Record>& records,
                 IdentifyOptions options = {.starts = 1, .threads = 1}) {
  for (const std::string& text : settings)
    parse_network_setting(text, "--network", options.network);
  return identify("mlp_one_sensor", records, DriveUnit::Ampere, options);
}

/// Root mean square of the model's error against the damper itself, over its motions at its
/// currents, N.
double true_error(const DamperModel& model) {
  double squares = 0, n = 0;
  for (double velocity = -0.55; velocity < 0.56; velocity += 0.05)
    for (double current = 0; current <= 1; current += 0.5, ++n)
      squares +=
          std::pow(model.force({0, velocity, current}, {}) - true_force(velocity, current), 2);
  return std::sqrt(squares / n);
}

const std::vector<std::vector<std::string>> kTrainers = {
    {"trainer=lm"},
    {"trainer=bayesian"},
    {"trainer=lbfgs"},
    {"trainer=sgd", "rate=0.1", "epochs=200"},
    {"trainer=momentum", "rate=0.02", "epochs=200"},
    {"trainer=rmsprop", "rate=0.003"},
    {"trainer=adam", "rate=0.005"},
    {"trainer=adamw", "rate=0.005"}};

}  // namespace

TEST_CASE("every trainer learns the damper, whatever the force zeros of the records" *
          doctest::test_suite("long")) {
  for (const std::vector<std::string>& trainer : kTrainers) {
    CAPTURE(trainer.front());
    const FitReport fit = fitted(trainer, campaign());
    REQUIRE(fit.model);
    CHECK(fit.status != FitReport::Status::Failed);
    CHECK(true_error(*fit.model) < 15);
    CHECK(fit.training_rmse < 12);  // the noise is 5 N
    REQUIRE(fit.offsets.size() == 9);
    CHECK_CLOSE(fit.offsets[0].second - fit.offsets[1].second, 120, 0.1, 0);
  }
}

TEST_CASE("without offsets a trainer leaves those of the records in the force" *
          doctest::test_suite("long")) {
  for (const char* trainer : {"trainer=lm", "trainer=lbfgs", "trainer=adam"}) {
    const FitReport fit = fitted({trainer, "epochs=60"}, campaign(),
                                 {.offset = OffsetMode::None, .starts = 1, .threads = 1});
    CHECK(fit.training_rmse > 25);  // 60 N of alternating sign
    CHECK(fit.offsets.empty());
  }
}

TEST_CASE("settings reach the trainer") {
  std::vector<Record> records = campaign();
  records.resize(3);
  using Settings = std::vector<std::string>;
  const auto model_of = [&](const Settings& settings) {
    return format_json(fitted(settings, records).model->to_json());
  };
  const auto check_each = [&](const Settings& settings, const Settings& changes) {
    const std::string before = model_of(settings);
    for (const std::string& change : changes) {
      Settings changed = settings;
      changed.push_back(change);
      CAPTURE(change);
      CHECK(model_of(changed) != before);
    }
  };
  check_each({"trainer=adam", "epochs=10"},
             {"rate=0.01", "schedule=constant", "schedule=step", "batch=50", "epochs=3", "l1=1e-3",
              "l2=1e-3", "patience=1", "activation=relu", "hidden=4-3"});
  for (const char* trainer : {"trainer=lm", "trainer=lbfgs"}) {
    CAPTURE(trainer);
    check_each({trainer, "hidden=3", "l2=1e-3", "epochs=20"}, {"epochs=2", "l2=0.1", "patience=1"});
  }
  CHECK(fitted({"epochs=3"}, records).iterations == 3);
  CHECK(message_of([&] {
          fitted({"rate=0.1"}, records);
        }).find("trainer=lm, the usual one, has none") != std::string::npos);
}

TEST_CASE("an ensemble is the mean of its members, the same on any number of threads" *
          doctest::test_suite("long")) {
  const std::vector<Record> records = campaign();
  for (const char* patience : {"patience=0", "patience=10"}) {
    const std::vector<std::string> settings = {"hidden=4", "members=3", "epochs=40", patience};
    const FitReport fit = fitted(settings, records);
    const auto& model = dynamic_cast<const NetworkModel&>(*fit.model);
    REQUIRE(model.members().size() == 3);
    CHECK(model.parameter_count() == 3 * 17);
    CHECK(model.members()[0].parameters != model.members()[1].parameters);
    const FitReport two = fitted(settings, records, {.starts = 1, .threads = 2});
    CHECK(format_json(two.model->to_json()) == format_json(model.to_json()));
    CHECK(true_error(*fit.model) < 60);  // of 600 N; four neurons, one start each
  }
}

TEST_CASE("a rate that is too large is told, not passed on as a model") {
  const FitReport fit = fitted({"trainer=sgd", "rate=1000", "epochs=3"}, campaign());
  CHECK(fit.status == FitReport::Status::Failed);
  CHECK(fit.message.find("smaller rate") != std::string::npos);
  CHECK(!fit.model);
}
