// What the models reach on the measured recordings: the gates of the project, with the shipped
// dataset files. Fits take minutes under the sanitizers, so they run in the release build only.
#include "identify/measured.h"

#include <cmath>

#include "dashpot/base/file.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/identify.h"
#include "dashpot/rank.h"
#include "support.h"

using namespace dashpot;

namespace {

/// 90 % intervals on what they were made without: the project's gate. Measured: 90.0 % and 89.4 %.
void check_coverage(const RankedModel& model) {
  CHECK(model.left_out.coverage.percent() >= 86);
  CHECK(model.left_out.coverage.percent() <= 94);
}

/// Of the dataset's only fold, without the fits that an interval needs. A single start is the
/// harder test: with more of them the best is taken.
Metrics of_left_out(const std::string& model, const Dataset& dataset) {
  const Fold fold = split(dataset, *dataset.leave_out).front();
  const FitReport fit = identify(model, fold.training, dataset.drive_unit, {.starts = 1});
  return evaluate(*fit.model, fold.left_out, dataset.drive_unit, {.known_offsets = fit.offsets})
      .pooled;
}

}  // namespace

TEST_CASE("nees: modified Bouc-Wen beats the published parameters on the last third" *
          doctest::test_suite("long")) {
  const auto folder = recordings("nees-2012-1158");
  if (folder.empty()) return;
  CHECK(of_left_out("modified_bouc_wen", load_dataset({folder})).r2 >=
        0.965);  // published parameters, unfitted: 0.946
}

TEST_CASE("nees: the large-scale Bouc-Wen law on the last third" * doctest::test_suite("long")) {
  const auto folder = recordings("nees-2012-1158");
  if (folder.empty()) return;
  CHECK(of_left_out("large_scale_bouc_wen", load_dataset({folder})).r2 >= 0.975);
}

TEST_CASE("utfsm: modified Bouc-Wen on conditions left out" * doctest::test_suite("long")) {
  const auto folder = recordings("utfsm");
  if (folder.empty()) return;
  const Dataset data = load_dataset({folder});
  CHECK(data.records.size() == 20);
  const RankedModel model = ranked("modified_bouc_wen", data);
  CHECK(model.left_out.pooled.esr <= 3);
  check_coverage(model);
}

TEST_CASE(
    "utfsm: records that begin in motion are no worse at their start, so that rest is a fair "
    "start") {
  const auto folder = recordings("utfsm");
  if (folder.empty()) return;
  const Dataset data = load_dataset({folder});
  const FitReport fit = identify("arctan", data.records, data.drive_unit, {});
  double start = 0, all = 0;
  for (const RecordResult& r : evaluate(*fit.model, data.records, data.drive_unit).records) {
    CHECK(r.warm_up == 0);
    for (std::size_t k = 0; k < r.measured.size(); ++k) {
      const double square = std::pow(r.measured[k] - r.modelled[k], 2);
      all += square;
      if (k < r.measured.size() / 50) start += square;
    }
  }
  MESSAGE("the first 2 % of the samples hold " << 100 * start / all << " % of the squared error");
  CHECK(start < 0.04 * all);
}

TEST_CASE("utfpr: inner voltages left out") {
  const auto folder = recordings("utfpr");
  if (folder.empty()) return;
  const RankedModel model = ranked("tanh_kwok", load_dataset({folder}));
  CHECK(model.left_out.pooled.r2 >= 0.97);
  check_coverage(model);
}

TEST_CASE("utfpr: laws at a voltage two thirds beyond all that they have seen" *
          doctest::test_suite("long")) {
  const auto folder = recordings("utfpr");
  if (folder.empty()) return;
  Dataset dataset = load_dataset({folder});
  dataset.leave_out = parse_leave_out("current=3.21");

  // With a damping in series that falls over the drive, and is all but gone there: 79 %.
  for (const char* model : {"modified_bouc_wen", "tanh_kwok"}) {
    CAPTURE(model);
    CHECK(of_left_out(model, dataset).esr <= 2.5);
  }
}

TEST_CASE(
    "sysidentpy: the simulated damper, trained and tested on the halves that are used publicly") {
  const auto folder = recordings("sysidentpy-simulated");
  if (folder.empty()) return;
  CHECK(of_left_out("modified_bouc_wen", load_dataset({folder})).rrse <=
        0.01);  // best public free-run figure: 0.0451
}

TEST_CASE("sysidentpy: the stated parameters meet the second half of the data and not the first") {
  const auto folder = shared_data("sysidentpy-simulated");
  if (folder.empty()) return;
  // With column v as the velocity, which the dataset file leaves out for what is found here.
  TemporaryFolder own;
  std::string file = read_file(project_file("data/datasets/sysidentpy-simulated.yaml"));
  file.insert(file.find("      force:"), "      velocity: {column: v, unit: cm/s}\n");
  LoadOptions options;
  options.dataset_file = own.write("with-v.yaml", file);
  Record record = load_dataset({folder}, options).records.back();  // rows 0...3599
  const auto rmse = [&](std::size_t first, std::size_t last) {
    Record part = record.slice(0, last);
    part.warm_up = first;
    return evaluate(load_parameters("leva_piroddi2002"), {part}, DriveUnit::Volt,
                    {.offset = OffsetMode::None})
        .pooled.rmse;
  };
  // What the dataset file of the exchanged halves and the parameter file say of these recordings,
  // in N.
  CHECK_CLOSE(rmse(400, 2000), 10.1, 0.02, 0);
  CHECK_CLOSE(rmse(2000, 3600), 1.87, 0.02, 0);
}

TEST_CASE("sysidentpy: every parameter that the data tell to 2 % is found to 2 %" *
          doctest::test_suite("long")) {
  const auto folder = recordings("sysidentpy-simulated");
  if (folder.empty()) return;
  LoadOptions options;
  options.dataset_file = project_file("data/datasets/sysidentpy-simulated-swapped.yaml");
  const RankedModel model = ranked("modified_bouc_wen", load_dataset({folder}, options));
  CHECK(model.left_out.pooled.rrse <= 0.02);

  const LawModel truth = load_parameters("leva_piroddi2002");
  const auto true_value = [&](const std::string& name) {
    for (std::size_t k = 0; k < truth.law().params.size(); ++k)
      for (std::size_t c = 0; c < truth.parameters().coefficients[k].size(); ++c)
        if (coefficient_name(truth.law().params[k].name, truth.parameters().forms[k], c) == name)
          return truth.parameters().coefficients[k][c];
    return truth.lag_rate();
  };
  // z has no scale of its own: alpha A, gamma A and beta A are what the data tell.
  const double rescale = true_value("A") / truth.law().params[truth.law().index_of("A")].value;
  std::vector<std::string> told;
  for (const FittedParameter& p : model.fit.parameters) {
    if (p.fixed || p.name == "f0" || p.high - p.value > 0.02 * std::abs(p.value)) continue;
    const bool scaled = p.name.starts_with("alpha") || p.name == "gamma" || p.name == "beta";
    CAPTURE(p.name);
    CHECK_CLOSE(p.value, true_value(p.name) * (scaled ? rescale : 1), 0.02, 0);
    told.push_back(p.name);
  }
  CHECK(told == std::vector<std::string>{"alpha_b", "c0_a", "c1_a", "gamma", "beta", "lag_rate"});
}
