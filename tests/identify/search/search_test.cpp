#include "dashpot/identify/search/search.h"

#include <cmath>

#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/virtual_bench.h"
#include "dashpot/error.h"
#include "dashpot/rank.h"
#include "dashpot/report/search_report.h"
#include "support.h"

using namespace dashpot;

namespace {

const Dataset& searched_campaign() {
  static const Dataset data = [] {
    BenchOptions options;
    options.motions = {{0.01, 1}, {0.005, 3}};
    options.drive_levels = {0.5, 1};
    options.sample_rate = 100;
    options.cycles = 2;
    return run_virtual_bench(load_parameters("kwok2006"), DriveUnit::Ampere, options);
  }();
  return data;
}

SearchOptions grid(const std::vector<std::string>& axes) {
  SearchOptions options;
  options.method = SearchMethod::Grid;
  options.fit.starts = 1;
  for (const std::string& axis : axes)
    options.space.axes.push_back(parse_search_axis(axis, "--over"));
  return options;
}

}  // namespace

TEST_CASE("a trial's error is what rank gives the same network on the same folds" *
          doctest::test_suite("long")) {
  const SearchOptions options = grid({"hidden=2,4"});
  const SearchReport report = search(searched_campaign(), {}, options);
  REQUIRE(report.trials.size() == 2);
  CHECK(report.folds.size() == 2);
  CHECK(report.results == 4);
  for (const Trial& trial : report.trials) {
    const Ranking ranking =
        rank({options.model}, searched_campaign(), {}, options_of(trial.design, options));
    const RankedModel& ranked = ranking.models.front();
    // Sums of the same numbers in another order.
    CHECK_CLOSE(trial.left_out.esr, ranked.left_out.pooled.esr, 1e-12, 0);
    CHECK(trial.worst_esr == ranked.left_out.worst_esr);
    CHECK(trial.left_out.samples == ranked.left_out.pooled.samples);
    CHECK(trial.parameters == ranked.fit.model->parameter_count());
    const double first = metrics(trial.folds[0].sums).esr,
                 second = metrics(trial.folds[1].sums).esr;
    CHECK_CLOSE(trial.standard_error, std::abs(first - second) / 2, 1e-12, 0);  // of a mean of two
  }
}

TEST_CASE("the table is the same bit for bit with any number of threads and from kept results" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  SearchOptions options = grid({"hidden=1:9", "activation=tanh,relu"});
  options.method = SearchMethod::Halving;
  options.trials = 10;
  options.fit.threads = 1;
  const std::string one = csv_search(search(searched_campaign(), {}, options));
  options.fit.threads = 3;
  TrialStore store(folder.path() / "search.sqlite",
                   describe_search(searched_campaign(), {}, options, "1"));
  const SearchReport first = search(searched_campaign(), {}, options, &store);
  CHECK(csv_search(first) == one);
  CHECK(first.kept == 0);
  CHECK(store.size() == first.results);
  const SearchReport again = search(searched_campaign(), {}, options, &store);
  CHECK(csv_search(again) == one);
  CHECK(again.kept == first.results);
}

TEST_CASE("an interruption keeps what is finished, and the search goes on from there") {
  const TemporaryFolder folder;
  const SearchOptions options = grid({"hidden=1,2,3,4"});
  const std::string whole = csv_search(search(searched_campaign(), {}, options));
  const NamedTexts identity = describe_search(searched_campaign(), {}, options, "1");
  TrialStore store(folder.path() / "search.sqlite", identity);
  std::atomic<bool> stop = false;
  SearchOptions stopped = options;
  stopped.fit.monitor.stop = &stop;
  stopped.fit.threads = 1;
  int ended = 0;
  CHECK_THROWS_AS(search(searched_campaign(), {}, stopped, &store,
                         [&](const Trial&, const SearchReport&) { stop = ++ended == 2; }),
                  Interrupted);
  CHECK(store.size() == 4);  // two trials of two folds
  const SearchReport report = search(searched_campaign(), {}, options, &store);
  CHECK(report.kept == 4);
  CHECK(csv_search(report) == whole);
}

TEST_CASE("more trials go on with those that are there; what changes results is another search" *
          doctest::test_suite("long")) {
  SearchOptions options = grid({"hidden=1:30"});
  options.method = SearchMethod::Random;
  options.trials = 3;
  const NamedTexts three = describe_search(searched_campaign(), {}, options, "1");
  const TemporaryFolder folder;
  TrialStore store(folder.path() / "search.sqlite", three);
  search(searched_campaign(), {}, options, &store);
  options.trials = 5;
  options.fit.threads = 2;
  CHECK(describe_search(searched_campaign(), {}, options, "1") == three);
  CHECK(search(searched_campaign(), {}, options, &store).kept == 6);

  const auto differs = [&](auto change) {
    SearchOptions other = options;
    change(other);
    return describe_search(searched_campaign(), {}, other, "1") != three;
  };
  CHECK(differs([](SearchOptions& o) { o.fit.seed = 2; }));
  CHECK(differs([](SearchOptions& o) { o.fit.starts = 2; }));
  CHECK(differs([](SearchOptions& o) { o.model = "mlp_two_sensors"; }));
  CHECK(differs([](SearchOptions& o) { o.space.fixed.l2 = 1e-3; }));
  CHECK(differs([](SearchOptions& o) { o.space.axes[0].high = 31; }));
  CHECK(differs([](SearchOptions& o) { o.method = SearchMethod::Grid; }));
  CHECK(describe_search(searched_campaign(), {}, options, "2") != three);
  CHECK(describe_search(searched_campaign(), {.by = LeaveOut::By::Record}, options, "1") != three);
  Dataset changed = searched_campaign();
  changed.records[0].channels[0].samples[3] += 1e-9;
  CHECK(describe_search(changed, {}, options, "1") != three);
}

TEST_CASE("halving: rounds of a third each, of which the best go on; finalists stand first") {
  SearchOptions options = grid({"hidden=1:10", "l2=1e-6:1e-2"});
  options.method = SearchMethod::Halving;
  const auto rungs = [&](std::size_t trials) {
    options.trials = trials;
    std::vector<std::pair<std::size_t, double>> result;
    for (const Rung& rung : search_rungs(options)) result.emplace_back(rung.trials, 1 / rung.share);
    return result;
  };
  using Rungs = std::vector<std::pair<std::size_t, double>>;
  CHECK(rungs(9) == Rungs{{9, 3}, {3, 1}});
  CHECK(rungs(27) == Rungs{{27, 9}, {9, 3}, {3, 1}});
  CHECK(rungs(60).size() == 3);
  options.effort = SearchEffort::Epochs;
  CHECK(message_of([&] { rungs(9); }).starts_with("--effort: epochs"));
  options.effort = SearchEffort::Samples;
  CHECK(message_of([&] { rungs(8); }).starts_with("--method: 8 trials are too few"));

  options.trials = 9;
  const SearchReport report = search(searched_campaign(), {}, options);
  REQUIRE(report.trials.size() == 9);
  CHECK(report.results == 24);  // 9 and 3 trials, two folds each
  double worst_finalist = 0;
  for (std::size_t k = 0; k < 9; ++k) {
    CHECK(report.trials[k].rung == (k < 3 ? 1 : 0));
    CHECK(report.is_finalist(report.trials[k]) == (k < 3));
    if (k < 3) CHECK(report.trials[k].left_out.esr >= worst_finalist);
    if (k < 3) worst_finalist = report.trials[k].left_out.esr;
  }
}

namespace {

Trial made_trial(double esr, std::size_t parameters, double error) {
  Trial trial;
  trial.left_out.esr = esr;
  trial.left_out.samples = 1;
  trial.parameters = parameters;
  trial.standard_error = error;
  return trial;
}

}  // namespace

TEST_CASE(
    "best, smallest within one standard error of it; ties go to fewer parameters; bad ones last") {
  SearchReport report;
  report.rungs = {{7, 1}};
  report.trials = {made_trial(1.4, 9, 0.1),  made_trial(1, 30, 0.5), made_trial(1, 20, 0.5),
                   made_trial(1.6, 5, 0.1),  made_trial(0.5, 2, 0),  made_trial(0.1, 1, 0),
                   made_trial(1.45, 11, 0.1)};
  report.trials[4].diverged = 1;
  report.trials[5].failure = "no motion";
  sort_trials(report.trials);
  std::vector<std::size_t> order;
  for (const Trial& trial : report.trials) order.push_back(trial.parameters);
  CHECK(order == std::vector<std::size_t>{20, 30, 9, 11, 5, 2, 1});
  REQUIRE(report.best());
  CHECK(report.best()->parameters == 20);
  CHECK(report.smallest()->parameters == 9);  // 1.4 <= 1 + 0.5 < 1.6
  report.trials[0].standard_error = std::nan("");
  CHECK(report.smallest() == report.best());
  report.trials = {report.trials.back()};
  CHECK(!report.best());
  CHECK(!report.smallest());
  CHECK(search_verdict(report).starts_with("No trial can be used"));
}

TEST_CASE("no finalist on the front is beaten with as few parameters" *
          doctest::test_suite("long")) {
  const SearchReport report =
      search(searched_campaign(), {}, grid({"hidden=1,2,3,4,6", "activation=tanh,relu"}));
  for (const Trial& a : report.trials) {
    bool beaten = false;
    for (const Trial& b : report.trials)
      beaten |= b.left_out.esr < a.left_out.esr && b.parameters <= a.parameters;
    CHECK(a.on_front == !beaten);
  }
}

TEST_CASE("a fit that cannot be is a failed trial, not the end of the search") {
  Dataset data = searched_campaign();
  for (Record& record : data.records)
    std::erase_if(record.channels, [](const Channel& c) { return c.name == "displacement"; });
  SearchOptions options = grid({"hidden=2,3"});
  options.model = "mlp_two_sensors";
  const SearchReport report = search(data, {}, options);
  CHECK(!report.best());
  CHECK(report.trials.front().failure.find("has no displacement") != std::string::npos);
}
