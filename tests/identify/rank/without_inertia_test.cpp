#include <cmath>

#include "dashpot/damper/virtual_bench.h"
#include "dashpot/rank.h"
#include "studies/ride_rank/true_dampers.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A damper that is no law of Dashpot's, a valve behind a spring with friction of the seals, and so
/// many kilograms between it and the load cell.
Dataset recorded(double mass) {
  const TrueDamperParts parts{
      .name = "a valve", .what = "", .orifice = 600, .spring = 4e6, .friction = 60};
  BenchOptions bench;
  bench.motions = {{0.02, 1}, {0.01, 3}, {0.005, 8}, {0.002, 20}};
  bench.drive_levels = {0, 1, 2};
  bench.sample_rate = 250;
  bench.cycles = 1;
  Dataset data = run_virtual_bench(*make_true_damper(parts), DriveUnit::Ampere, bench);

  // The bench's motions are sines, which are their own acceleration.
  for (std::size_t r = 0; r < data.records.size(); ++r) {
    Record& record = data.records[r];
    const double w = 2 * M_PI * bench.motions[r / bench.drive_levels.size()].frequency;
    std::vector<double>& force = record.find("force")->samples;
    for (std::size_t k = 0; k < force.size(); ++k)
      force[k] -= mass * w * w * record.channel("displacement").samples[k];
  }
  return data;
}

Ranking ranked(Dataset& data) {
  return rank_without_inertia({"tanh_kwok", "bouc_wen"}, data, {.by = LeaveOut::By::Condition}, {});
}

}  // namespace

TEST_CASE("the inertia before a load cell is found, taken off the force, and told" *
          doctest::test_suite("long")) {
  const Dataset true_force = recorded(0);
  Dataset data = recorded(5);
  const Ranking ranking = ranked(data);

  REQUIRE(ranking.inertia);
  CHECK(ranking.inertia->mass < 5.2);
  CHECK(ranking.inertia->after < 0.9 * ranking.inertia->before);
  CHECK(contains(data.records.front().notes.back(), "kg between load cell and damper taken off"));

  // What the models are then fitted to is nearer to the damper's force. A part stays: the lag that
  // the valve's spring makes, and no law here has, hides it.
  double left = 0, added = 0;
  const Dataset with_mass = recorded(5);
  for (std::size_t r = 0; r < data.records.size(); ++r) {
    const Record& asked = with_mass.records[r];
    for (std::size_t k = 0; k < asked.size(); ++k) {
      const double truth = true_force.records[r].channel("force").samples[k];
      left += std::pow(data.records[r].channel("force").samples[k] - truth, 2);
      added += std::pow(asked.channel("force").samples[k] - truth, 2);
    }
  }
  CHECK(left < 0.25 * added);

  // A model file says what was taken off, and further recordings lose as much before they judge it.
  const ModelFile file = to_model_file(ranking.models.front(), data, "");
  CHECK(parse_model(format_model(file), "m.json").moving_mass == ranking.inertia->mass);
  const auto rmse = [&](const Dataset& judged) {
    return evaluate(*file.model, judged.records, judged.drive_unit).pooled.rmse;
  };
  Dataset further = with_mass;
  CHECK(take_off_inertia(file, further) == further.records.size());
  CHECK(rmse(further) < 0.85 * rmse(with_mass));
  CHECK(take_off_inertia(file, further) == 0);  // it is off already
}

TEST_CASE("where there is no inertia none is found, though no law is the damper" *
          doctest::test_suite("long")) {
  Dataset data = recorded(0);
  const Ranking plain = rank({"tanh_kwok", "bouc_wen"}, data, {.by = LeaveOut::By::Condition}, {});
  const Ranking ranking = ranked(data);
  CHECK_FALSE(ranking.inertia);
  CHECK(ranking.models.front().left_out.pooled.esr == plain.models.front().left_out.pooled.esr);
}

TEST_CASE("without an acceleration the force stays as it was recorded" *
          doctest::test_suite("long")) {
  Dataset data = recorded(5);
  Record& record = data.records.back();
  record.sample_time = 0;
  const std::vector<double> before = record.channel("force").samples;
  CHECK_FALSE(ranked(data).inertia);
  CHECK(record.channel("force").samples == before);
}
