#include "dashpot/identify.h"

#include <atomic>

#include "dashpot/base/random.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/registry.h"
#include "dashpot/damper/virtual_bench.h"
#include "dashpot/error.h"
#include "dashpot/rank.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A small campaign with a tanh damper whose parameters are known.
Dataset tanh_campaign() {
  BenchOptions options;
  options.motions = {{0.01, 1}, {0.005, 3}};
  options.drive_levels = {0, 0.5, 1};
  options.sample_rate = 200;
  options.cycles = 2;
  return run_virtual_bench(load_parameters("kwok2006"), DriveUnit::Ampere, options);
}

}  // namespace

TEST_CASE("known parameters lie in their intervals, give or take the odds") {
  const Dataset data = tanh_campaign();
  const FitReport report = identify("tanh_kwok", data.records, DriveUnit::Ampere, {});
  CHECK(report.status == FitReport::Status::Converged);
  const LawModel truth = load_parameters("kwok2006");
  std::vector<double> p(truth.law().params.size());
  int outside = 0, checked = 0;
  for (const FittedParameter& fitted : report.parameters) {
    for (std::size_t k = 0; k < truth.law().params.size(); ++k)
      for (std::size_t c = 0; c < truth.parameters().coefficients[k].size(); ++c) {
        const std::string name =
            coefficient_name(truth.law().params[k].name, truth.parameters().forms[k], c);
        if (name != fitted.name || fitted.fixed || truth.law().params[k].fit == Fit::Bias) continue;
        ++checked;
        const double slack = fitted.high - fitted.low;  // four standard errors, not two
        outside += std::abs(truth.parameters().coefficients[k][c] - fitted.value) > slack;
      }
  }
  CHECK(checked >= 8);
  CHECK(outside == 0);
}

TEST_CASE("offsets of the records are found") {
  const Dataset data = tanh_campaign();
  const FitReport report = identify("tanh_kwok", data.records, DriveUnit::Ampere, {});
  REQUIRE(report.offsets.size() == data.records.size());
  double sum = 0;
  for (const auto& [record, offset] : report.offsets) sum += offset;
  CHECK_CLOSE(sum, 0, 0, 1e-6);  // the mean is the model's own bias
}

TEST_CASE("the offset of a single record is as uncertain as its noise makes it") {
  // A dashpot and an offset of 5 N under white noise of 10 N.
  constexpr double kNoise = 10, kOffset = 5;
  int held = 0;
  for (int seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Record record{.name = "one", .drive_level = 0, .sample_time = 1e-2};
    std::vector<double> v, force;
    for (int k = 0; k < 1000; ++k) {
      record.time.push_back(record.sample_time * k);
      v.push_back(0.1 * std::sin(6.0 * record.time.back()));
      force.push_back(1000 * v.back() + kOffset + kNoise * random.normal());
    }
    record.channels = {{.name = "velocity", .unit = "m/s", .samples = v},
                       {.name = "force", .unit = "N", .samples = force},
                       {.name = "current", .unit = "A", .samples = std::vector<double>(1000)}};
    const FitReport report = identify("bingham", {record}, DriveUnit::Ampere, {});
    const FittedParameter& offset =
        *std::ranges::find(report.parameters, "f0", &FittedParameter::name);
    const double half = 0.5 * (offset.high - offset.low);
    CHECK(half > 0.7 * 1.96 * kNoise / std::sqrt(1000));
    CHECK(half < 1.4 * 1.96 * kNoise / std::sqrt(1000));
    held += offset.low < kOffset && kOffset < offset.high;
  }
  CHECK(held >= 16);  // of 20, at 95 %
}

TEST_CASE("the same bits on any number of threads" * doctest::test_suite("long")) {
  const Dataset data = tanh_campaign();
  LeaveOut by_condition;
  const auto run = [&](int threads) {
    IdentifyOptions options;
    options.threads = threads;
    options.starts = 2;
    return rank({"bingham", "tanh_kwok", "mlp_one_sensor", "anfis"}, data, by_condition, options);
  };
  const Ranking one = run(1), two = run(2);
  REQUIRE(one.models.size() == 4);
  CHECK(one.models[0].name == "tanh_kwok");
  for (std::size_t k = 0; k < one.models.size(); ++k) {
    CHECK(one.models[k].name == two.models[k].name);
    CHECK(one.models[k].left_out.pooled.esr == two.models[k].left_out.pooled.esr);
    CHECK(format_json(one.models[k].fit.model->to_json()) ==
          format_json(two.models[k].fit.model->to_json()));
  }
}

TEST_CASE("the saved model is the ranked one, with its domain and where it comes from") {
  const Dataset data = tanh_campaign();
  LeaveOut by_condition;
  const Ranking ranking = rank({"bingham"}, data, by_condition, {});
  const ModelFile file = to_model_file(ranking.models[0], data, "dashpot identify x");
  CHECK(file.domain.current_max == 1);
  CHECK_CLOSE(file.domain.displacement_max, 0.01, 0.01, 0);
  CHECK(file.provenance.training_records.size() == data.records.size());
  const ModelFile again = parse_model(format_model(file), "again");
  const Evaluation e = evaluate(*again.model, data.records, DriveUnit::Ampere);
  CHECK_CLOSE(e.pooled.rmse, ranking.models[0].training.pooled.rmse, 1e-3, 0);
}

TEST_CASE("a monitor stops a fit") {
  Dataset data = tanh_campaign();
  for (Record& record : data.records)
    record.conditions = {{"piston_area", 1e-4}, {"gap_area", 2e-5},  {"gap", 1e-3},
                         {"pole_length", 6e-3}, {"viscosity", 0.28}, {"yield_stress", 2e3}};
  std::atomic<bool> stop = true;
  IdentifyOptions options;
  options.monitor.stop = &stop;
  for (const std::string& model : model_names()) {
    CAPTURE(model);
    CHECK_THROWS_AS(identify(model, data.records, DriveUnit::Ampere, options), Interrupted);
  }
}

TEST_CASE("records that cannot serve are refused in words") {
  CHECK(message_of([] { identify("bingham", {}, DriveUnit::Ampere, {}); }) ==
        "bingham: there is no record to fit it on");
  Dataset data = tanh_campaign();
  for (Record& record : data.records)
    std::erase_if(record.channels, [](const Channel& c) { return c.name == "displacement"; });
  CHECK(message_of([&] {
          identify("tanh_kwok", data.records, DriveUnit::Ampere, {});
        }).find("has no displacement") != std::string::npos);
  for (Record& record : data.records)
    for (double& v : record.find("velocity")->samples) v = 0;
  CHECK(message_of([&] {
          identify("bingham", data.records, DriveUnit::Ampere, {});
        }).find("nothing moves") != std::string::npos);
}
