#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/identify.h"
#include "dashpot/identify/fit/family_gates_fit.h"
#include "dashpot/rank.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr double kDrives[] = {0, 0.5, 1};

/// A slow sine of one member at one current. Its force is within what the gates can tell: stronger
/// with the field's share and the pole, weaker with the gap; `strength` is the build's.
Record sine_record(double gap, double length, double viscosity, double current, double strength) {
  Record record;
  const auto text = [](double value) { return std::to_string(value * 1e3); };
  record.condition = text(gap) + " " + text(length) + " " + text(viscosity);
  record.name = record.condition + " " + std::to_string(current);
  record.drive_level = current;
  record.conditions = {{"piston_area", 2e-4 - 0.04 * gap},
                       {"gap_area", 0.04 * gap},
                       {"gap", gap},
                       {"pole_length", length},
                       {"viscosity", viscosity},
                       {"yield_stress", 1000 + 2e4 * current}};
  std::vector<double> x, v, i, force;
  const double field = current / (current + 0.65077);
  const double size = strength * (10 + 8 * field + 2e3 * (length - 8e-3) - 4e3 * (gap - 1.5e-3));
  for (int k = 0; k < 200; ++k) {
    const double w = 1.5, t = 0.03 * k;
    record.time.push_back(t);
    x.push_back(0.015 * std::sin(w * t));
    v.push_back(0.015 * w * std::cos(w * t));
    i.push_back(current);
    force.push_back(size * std::tanh(v.back() / 0.00675) + 100 * std::sqrt(viscosity) * v.back());
  }
  record.channels = {{"displacement", "m", x, ""},
                     {"velocity", "m/s", v, ""},
                     {"current", "A", i, ""},
                     {"force", "N", force, ""}};
  record.sample_time = 0.03;
  return record;
}

Dataset family_data(double spread) {
  Dataset data;
  data.name = "family";
  int geometry = 0;
  for (const double gap : {1e-3, 1.5e-3, 2e-3})
    for (const double length : {6e-3, 8e-3, 10e-3}) {
      // A chessboard: nothing that is linear in gap and length tells of it.
      const double strength = 1 + spread * (++geometry % 2 ? 1 : -1);
      for (const double viscosity : {0.05, 0.3})
        for (const double level : kDrives)
          data.records.push_back(sine_record(gap, length, viscosity, level, strength));
    }
  return data;
}

double spread_of(const Dataset& data) {
  const FitReport report =
      identify("family_gated", data.records, DriveUnit::Ampere, {.offset = OffsetMode::None});
  REQUIRE(report.parameters.size() == 1);
  return report.parameters.front().value;
}

}  // namespace

TEST_CASE("a gated family predicts geometries that it has not seen" * doctest::test_suite("long")) {
  const Ranking ranking =
      rank({"family_gated"}, family_data(0), parse_leave_out("each=gap,pole_length"),
           {.offset = OffsetMode::None});
  CHECK(ranking.folds.size() == 9);
  CHECK(ranking.models.front().left_out.pooled.r2 > 0.995);
}

TEST_CASE("the spread of builds is found from left-out designs") {
  CHECK(spread_of(family_data(0)) < 0.05);
  const double spread = spread_of(family_data(0.2));
  CHECK(spread > 0.15);
  CHECK(spread < 0.3);
}

TEST_CASE("the paper's network learns a small family, the same for the same seed" *
          doctest::test_suite("long")) {
  const Dataset data = family_data(0);
  IdentifyOptions options{.offset = OffsetMode::None};
  options.network.epochs = 60;
  for (const char* name : {"family_h3x15", "family_h3x15_residual", "family_h3x15_total"}) {
    CAPTURE(name);
    const FitReport report = identify(name, data.records, DriveUnit::Ampere, options);
    const Evaluation on_training =
        evaluate(*report.model, data.records, DriveUnit::Ampere, {.offset = OffsetMode::None});
    CHECK(on_training.pooled.r2 > 0.99);
    CHECK(on_training.records.front().extrapolations.empty());
    options.threads = 1;
    const FitReport again = identify(name, data.records, DriveUnit::Ampere, options);
    CHECK(format_json(again.model->to_json()) == format_json(report.model->to_json()));
  }
}

TEST_CASE("records without a member's conditions are refused") {
  Dataset data = family_data(0);
  std::erase_if(data.records[3].conditions, [](const auto& c) { return c.first == "gap"; });
  CHECK(message_of([&] {
          identify("family_gated", data.records, DriveUnit::Ampere, {});
        }).find("no condition 'gap'") != std::string::npos);
}

// Acceptance of the family model: a plain ridge on interpolated features has 0.974 and 1.27 N.
TEST_CASE("measured dampers of geometries never seen are predicted, with intervals that hold" *
          doctest::test_suite("long")) {
  const auto folder = shared_data("family-dnn");
  if (folder.empty()) return;
  const Dataset data = load_dataset({folder});
  const Ranking ranking = rank({"family_gated"}, data, parse_leave_out("each=gap,pole_length"),
                               {.offset = OffsetMode::None});
  const Evaluation& left_out = ranking.models.front().left_out;
  CHECK(left_out.pooled.r2 >= 0.978);
  CHECK(left_out.pooled.mae <= 1.15);
  CHECK(left_out.coverage.percent() >= 85);
  CHECK(left_out.coverage.percent() <= 95);
  CHECK(ranking.models.front().band->spread > 0);  // of builds
}
