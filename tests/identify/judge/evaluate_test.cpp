#include "dashpot/evaluate.h"

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/registry.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A viscous damper of 1000 N s/m under a sine of 1 Hz at 1 A, its force shifted by `offset`.
Record viscous_record(const std::string& name, double offset) {
  Record record{.name = name, .condition = "sine", .drive_level = 1.0, .sample_time = 0.01};
  Channel x{"displacement", "m"}, v{"velocity", "m/s"}, f{"force", "N"}, i{"current", "A"};
  for (int k = 0; k < 200; ++k) {
    const double phase = 2 * 3.14159265358979323846 * 0.01 * k;
    record.time.push_back(0.01 * k);
    x.samples.push_back(0.01 * std::sin(phase));
    v.samples.push_back(0.0628 * std::cos(phase));
    f.samples.push_back(1000 * v.samples.back() + offset);
    i.samples.push_back(1);
  }
  record.channels = {x, v, f, i};
  return record;
}

LawModel viscous_model(double damping) {
  return LawModel::constant(find_law("bingham"), {damping, 0, 0, 0});
}

}  // namespace

TEST_CASE("the offset of a record is found, taken out, and shown") {
  const Evaluation e = evaluate(
      viscous_model(1000), {viscous_record("a", 40), viscous_record("b", -10)}, DriveUnit::Ampere);
  CHECK_CLOSE(e.records[0].offset, 40, 1e-12, 0);
  CHECK_CLOSE(e.records[1].offset, -10, 1e-12, 0);
  CHECK_CLOSE(e.pooled.rmse, 0, 0, 1e-10);
  CHECK_CLOSE(e.records[0].metrics_without_offset.rmse, 40, 1e-12, 0);
  CHECK_CLOSE(e.records[0].modelled[0], e.records[0].measured[0], 1e-12, 0);
}

TEST_CASE("a known offset is used, and none is looked for when told so") {
  const std::vector<Record> records = {viscous_record("a", 40)};
  EvaluateOptions options;
  options.known_offsets = {{"a", 25}};
  CHECK_CLOSE(evaluate(viscous_model(1000), records, DriveUnit::Ampere, options).pooled.rmse, 15,
              1e-12, 0);
  CHECK_CLOSE(
      evaluate(viscous_model(1000), records, DriveUnit::Ampere, {.offset = OffsetMode::None})
          .pooled.rmse,
      40, 1e-12, 0);
}

TEST_CASE("a record of a damper at rest is neither the worst nor in the mean") {
  Record resting = viscous_record("rest", 0);
  for (const char* name : {"displacement", "velocity", "force"})
    for (double& value : resting.find(name)->samples) value *= 1e-9;
  const Evaluation e =
      evaluate(viscous_model(1100), {viscous_record("moves", 0), resting}, DriveUnit::Ampere);
  CHECK(e.worst_record == "moves");
  CHECK_CLOSE(e.mean_esr, e.records[0].metrics.esr, 1e-12, 0);
  CHECK(e.pooled.samples == 400);
}

TEST_CASE("energy: a damper that is 10 % too strong dissipates 10 % too much") {
  const Evaluation e = evaluate(viscous_model(1100), {viscous_record("a", 0)}, DriveUnit::Ampere);
  CHECK_CLOSE(e.records[0].energy_error, 10, 1e-9, 0);
}

TEST_CASE("warm-up samples are simulated and not scored") {
  Record record = viscous_record("a", 0);
  record.find("force")->samples[3] = 1e6;
  record.warm_up = 10;
  const Evaluation e = evaluate(viscous_model(1000), {record}, DriveUnit::Ampere);
  CHECK(e.pooled.samples == 190);
  CHECK_CLOSE(e.pooled.rmse, 0, 0, 1e-10);
}

TEST_CASE("bands of speed cover every sample once") {
  const Evaluation e = evaluate(viscous_model(900), {viscous_record("a", 0)}, DriveUnit::Ampere);
  std::size_t samples = 0;
  for (const BandResult& band : e.bands) samples += band.metrics.samples;
  CHECK(samples == e.pooled.samples);
  CHECK(e.bands.back().metrics.rmse > e.bands.front().metrics.rmse);
}

TEST_CASE("a run that diverges is reported with its time and never averaged") {
  // between its wells this law has no step of its own that is so long, and these numbers are
  // hopeless for an explicit one
  const LawModel wild =
      LawModel::constant(find_law("landau_surrogate"), {800, 1000, 1e-6, 1e-6, -10, 0, 1, 0});
  const Evaluation e = evaluate(wild, {viscous_record("a", 0)}, DriveUnit::Ampere);
  CHECK(e.diverged == 1);
  REQUIRE(e.records[0].diverged_at);
  CHECK(*e.records[0].diverged_at < 1);
  CHECK(e.pooled.samples == 0);
}

TEST_CASE("a missing channel is named") {
  Record record = viscous_record("run 7", 0);
  record.channels.erase(record.channels.begin());
  const LawModel needs_x = LawModel::constant(find_law("tanh_kwok"), {1000, 0, 0, 1, 0, 0});
  CHECK(message_of([&] {
          evaluate(needs_x, {record}, DriveUnit::Ampere);
        }).find("run 7: has no displacement, which tanh_kwok needs") == 0);
  CHECK(message_of([&] { evaluate(viscous_model(1), {record}, DriveUnit::Volt); }).find("run 7") ==
        0);
}

TEST_CASE("the range of a switching drive leaves its spikes out") {
  Record record = viscous_record("a", 0);
  record.drive_level.reset();
  record.find("current")->samples[7] = -5;
  record.find("current")->samples[8] = 9;
  const DriveRange range = drive_range({record}, DriveUnit::Ampere);
  CHECK(range.varies);
  CHECK(range.low == 1);
  CHECK(range.high == 1);
}

TEST_CASE("figures by drive: one per constant level; quarters of its range where it varies") {
  const LawModel zero = LawModel::constant(find_law("bingham"), {0, 0, 0, 0});
  const auto record_at = [](std::vector<double> drive, std::optional<double> level) {
    Record record{.name = "r", .source = {}, .condition = {}, .drive_level = level};
    const std::size_t n = drive.size();
    for (std::size_t k = 0; k < n; ++k) record.time.push_back(0.01 * static_cast<double>(k));
    record.channels = {{"velocity", "m/s", std::vector<double>(n, 0.1), {}},
                       {"force", "N", drive, {}},
                       {"current", "A", drive, {}}};
    return record;
  };
  const Evaluation levels = evaluate(zero, {record_at({2, 2, 2}, 2), record_at({1, 1, 1}, 1)},
                                     DriveUnit::Ampere, {.offset = OffsetMode::None});
  REQUIRE(levels.drive.size() == 2);
  CHECK(levels.drive[0].low == 1);
  CHECK(levels.drive[0].metrics.rmse ==
        1);  // the force of these records is their drive, the model's 0
  CHECK(levels.drive[1].metrics.rmse == 2);
  const Evaluation varying = evaluate(zero, {record_at({0, 1, 2, 3, 4, 4}, {})}, DriveUnit::Ampere,
                                      {.offset = OffsetMode::None});
  REQUIRE(varying.drive.size() == 4);
  CHECK(varying.drive[0].metrics.samples == 1);  // [0, 1)
  CHECK(varying.drive[3].metrics.samples == 3);  // [3, 4], both ends
}
