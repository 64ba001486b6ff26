#include <atomic>
#include <barrier>
#include <functional>
#include <thread>

#include "handles.h"

// What the header lets threads share, used by several at once. tests/campaign/threads lets
// ThreadSanitizer watch the same.

namespace {

constexpr int kThreads = 4;

/// What each of some threads that begin at the same moment found. No CHECKs inside: doctest's are
/// slow enough to keep threads apart.
std::vector<std::string> found_by_threads(const std::function<std::string()>& work) {
  std::vector<std::string> found(kThreads);
  std::barrier begin(kThreads);
  std::vector<std::jthread> threads;
  for (std::string& text : found)
    threads.emplace_back([&] {
      begin.arrive_and_wait();
      text = work();
    });
  threads.clear();
  return found;
}

void check_all_found(const std::vector<std::string>& found, const std::string& expected) {
  for (const std::string& text : found) CHECK(text == expected);
}

Recordings two_levels() {
  Recordings recordings;
  REQUIRE(dashpot_recordings_new(&recordings) == DASHPOT_OK);
  REQUIRE(BinghamBench(0).add_to(recordings, "0 A") == DASHPOT_OK);
  REQUIRE(BinghamBench(1).add_to(recordings, "1 A") == DASHPOT_OK);
  return recordings;
}

/// Force after a second of a sine, by steps with a state of its own.
std::string stepped(const dashpot_model* model) {
  dashpot_model_info info;
  if (dashpot_model_get_info(model, &info) != DASHPOT_OK) return "no info";
  std::vector<double> state(info.state_size);
  dashpot_input from{0, 0.1, 1};
  double force = 0;
  auto status = dashpot_rest(model, &from, state.data(), state.size());
  for (int k = 1; k <= 1000 && status == DASHPOT_OK; ++k) {
    const double t = 0.001 * k;
    const dashpot_input to{0.01 * std::sin(10 * t), 0.1 * std::cos(10 * t), 1};
    status = dashpot_advance(model, &from, &to, 0.001, state.data(), state.size());
    from = to;
  }
  if (status == DASHPOT_OK)
    status = dashpot_force(model, &from, state.data(), state.size(), &force);
  return status == DASHPOT_OK ? std::to_string(force) : dashpot_last_error();
}

std::string evaluated(const dashpot_model* model, const dashpot_recordings* recordings) {
  Text report;
  const auto status = dashpot_evaluate(model, recordings, R"({"threads": 2})", &report);
  return status == DASHPOT_OK ? report.handle : dashpot_last_error();
}

std::string fitted(const dashpot_recordings* recordings) {
  Model model;
  Text text;
  auto status = dashpot_fit(recordings, R"({"models": ["tanh_kwok"], "threads": 2})", nullptr,
                            &model, nullptr);
  if (status == DASHPOT_OK) status = dashpot_model_parameters(model, &text);
  return status == DASHPOT_OK ? text.handle : dashpot_last_error();
}

std::string driven() {
  Recordings trace;
  Text report;
  const auto status =
      dashpot_simulate(R"({"road": "step", "duration": 0.5})", nullptr, &trace, &report);
  return status == DASHPOT_OK ? report.handle : dashpot_last_error();
}

}  // namespace

TEST_CASE("threads share a model, each with a state of its own") {
  const Model model = published();
  const std::string alone = stepped(model);
  check_all_found(found_by_threads([&] { return stepped(model); }), alone);
}

TEST_CASE("threads share recordings and a model") {
  const Recordings recordings = two_levels();
  Model model;
  REQUIRE(dashpot_fit(recordings, R"({"models": ["bingham"]})", nullptr, &model, nullptr) ==
          DASHPOT_OK);
  const std::string alone = evaluated(model, recordings);
  check_all_found(found_by_threads([&] { return evaluated(model, recordings); }), alone);
}

TEST_CASE("threads fit on the same recordings, and drive, at once") {
  const Recordings recordings = two_levels();
  check_all_found(found_by_threads([&] { return fitted(recordings); }), fitted(recordings));
  check_all_found(found_by_threads(driven), driven());
}

TEST_CASE("threads read one ranking") {
  const Recordings recordings = two_levels();
  HeldRanking ranking;
  REQUIRE(dashpot_identify(recordings, R"({"models": ["bingham", "tanh_kwok"]})", nullptr,
                           &ranking) == DASHPOT_OK);
  const auto read = [&]() -> std::string {
    Text json, page;
    Model best;
    const bool is_read = dashpot_ranking_report(ranking, "json", &json) == DASHPOT_OK &&
                         dashpot_ranking_report(ranking, "html", &page) == DASHPOT_OK &&
                         dashpot_ranking_model(ranking, 0, &best) == DASHPOT_OK;
    return is_read ? std::string(json.handle) + page.handle : dashpot_last_error();
  };
  check_all_found(found_by_threads(read), read());
}
