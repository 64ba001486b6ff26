#include <algorithm>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <unistd.h>

#include <sys/resource.h>
#include <sys/wait.h>

#include "dashpot/base/file.h"
#include "handles.h"

// Every function of dashpot.h, used wrongly: a status and a message, nothing made, never a crash.
// The fuzz target `capi` goes further than these tables.

namespace {

/// One way of calling; it says what is wrong with it.
using Call = std::function<dashpot_status()>;

/// A call that gives no status: it must do nothing.
template <class Code>
Call quietly(Code code) {
  return [code] {
    code();
    return DASHPOT_OK;
  };
}

/// Every function with nothing but null pointers.
std::map<std::string, Call> null_calls() {
  return {
      {"version", quietly([] { CHECK(dashpot_version() != nullptr); })},
      {"last_error", quietly([] { CHECK(dashpot_last_error() != nullptr); })},
      {"text_free", quietly([] { dashpot_text_free(nullptr); })},
      {"model_free", quietly([] { dashpot_model_free(nullptr); })},
      {"recordings_free", quietly([] { dashpot_recordings_free(nullptr); })},
      {"ranking_free", quietly([] { dashpot_ranking_free(nullptr); })},
      {"recordings_count", quietly([] { CHECK(dashpot_recordings_count(nullptr) == 0); })},
      {"ranking_count", quietly([] { CHECK(dashpot_ranking_count(nullptr) == 0); })},
      {"model_load", [] { return dashpot_model_load(nullptr, nullptr); }},
      {"model_parse", [] { return dashpot_model_parse(nullptr, nullptr); }},
      {"model_published", [] { return dashpot_model_published(nullptr, nullptr); }},
      {"model_save", [] { return dashpot_model_save(nullptr, nullptr); }},
      {"model_parameters", [] { return dashpot_model_parameters(nullptr, nullptr); }},
      {"model_text", [] { return dashpot_model_text(nullptr, nullptr); }},
      {"model_get_info", [] { return dashpot_model_get_info(nullptr, nullptr); }},
      {"rest", [] { return dashpot_rest(nullptr, nullptr, nullptr, 0); }},
      {"advance", [] { return dashpot_advance(nullptr, nullptr, nullptr, 1, nullptr, 0); }},
      {"force", [] { return dashpot_force(nullptr, nullptr, nullptr, 0, nullptr); }},
      {"run", [] { return dashpot_run(nullptr, nullptr, nullptr); }},
      {"recordings_load", [] { return dashpot_recordings_load(nullptr, 1, nullptr, nullptr); }},
      {"recordings_new", [] { return dashpot_recordings_new(nullptr); }},
      {"recordings_add", [] { return dashpot_recordings_add(nullptr, nullptr); }},
      {"recordings_describe", [] { return dashpot_recordings_describe(nullptr, nullptr); }},
      {"recordings_unread", [] { return dashpot_recordings_unread(nullptr, nullptr); }},
      {"recordings_suspects", [] { return dashpot_recordings_suspects(nullptr, nullptr); }},
      {"recordings_get_info", [] { return dashpot_recordings_get_info(nullptr, 0, nullptr); }},
      {"recordings_channel", [] { return dashpot_recordings_channel(nullptr, 0, 0, nullptr); }},
      {"understand_column", [] { return dashpot_understand_column(nullptr, nullptr); }},
      {"fit", [] { return dashpot_fit(nullptr, nullptr, nullptr, nullptr, nullptr); }},
      {"identify", [] { return dashpot_identify(nullptr, nullptr, nullptr, nullptr); }},
      {"ranking_model", [] { return dashpot_ranking_model(nullptr, 0, nullptr); }},
      {"ranking_report", [] { return dashpot_ranking_report(nullptr, nullptr, nullptr); }},
      {"evaluate", [] { return dashpot_evaluate(nullptr, nullptr, nullptr, nullptr); }},
      {"traces", [] { return dashpot_traces(nullptr, nullptr, nullptr, nullptr); }},
      {"characterise", [] { return dashpot_characterise(nullptr, nullptr, nullptr); }},
      {"compare", [] { return dashpot_compare(nullptr, 0, nullptr, nullptr); }},
      {"export", [] { return dashpot_export(nullptr, nullptr, nullptr); }},
      {"simulate", [] { return dashpot_simulate(nullptr, nullptr, nullptr, nullptr); }},
      {"rides_new", [] { return dashpot_rides_new(nullptr); }},
      {"rides_load", [] { return dashpot_rides_load(nullptr, nullptr); }},
      {"rides_add", [] { return dashpot_rides_add(nullptr, nullptr); }},
      {"rides_count", quietly([] { CHECK(dashpot_rides_count(nullptr) == 0); })},
      {"rides_free", quietly([] { dashpot_rides_free(nullptr); })},
      {"identify_in_plant",
       [] {
         return dashpot_identify_in_plant(nullptr, nullptr, nullptr, nullptr, nullptr, nullptr);
       }},
      {"identify_dampers_in_plant",
       [] {
         return dashpot_identify_dampers_in_plant(nullptr, nullptr, nullptr, nullptr, nullptr, 0,
                                                  nullptr, nullptr);
       }},
      {"observe",
       [] {
         return dashpot_observe(nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr);
       }},
      {"observe_dampers",
       [] {
         return dashpot_observe_dampers(nullptr, 0, nullptr, nullptr, nullptr, nullptr, nullptr,
                                        nullptr);
       }},
      {"evaluate_in_plant",
       [] {
         return dashpot_evaluate_in_plant(nullptr, 0, nullptr, nullptr, nullptr, nullptr, nullptr,
                                          nullptr);
       }},
      {"watch", [] { return dashpot_watch(nullptr, nullptr, nullptr, nullptr, nullptr, nullptr); }},
      {"watch_dampers",
       [] {
         return dashpot_watch_dampers(nullptr, 0, nullptr, nullptr, nullptr, nullptr, nullptr);
       }},
  };
}

/// The names after dashpot_ of all functions that the header declares.
std::set<std::string> declared_functions() {
  const std::string header = dashpot::read_file(project_file("capi/dashpot.h"));
  const std::string begin = "DASHPOT_API ";
  std::set<std::string> names;
  for (std::size_t at = header.find(begin); at != std::string::npos;
       at = header.find(begin, at + 1)) {
    const std::size_t open = header.find('(', at), name = header.rfind("dashpot_", open) + 8;
    if (header[at - 1] == '\n') names.insert(header.substr(name, open - name));
  }
  return names;
}

/// Bad input, with a message of its own and not that of a call before.
void check_refused(const std::string& what, const Call& call) {
  CAPTURE(what);
  dashpot_model* none = nullptr;
  REQUIRE(dashpot_model_published("a call before", &none) == DASHPOT_BAD_INPUT);
  const std::string before = dashpot_last_error();
  CHECK(call() == DASHPOT_BAD_INPUT);
  CHECK(std::string(dashpot_last_error()) != before);
  CHECK(!std::string(dashpot_last_error()).empty());
}

}  // namespace

TEST_CASE("every function takes null pointers, and says what is null") {
  const std::map<std::string, Call> calls = null_calls();
  std::set<std::string> known;
  for (const auto& [name, call] : calls) known.insert(name);
  CHECK(known == declared_functions());
  for (const auto& [name, call] : calls) {
    CAPTURE(name);
    if (name.ends_with("_free") || name.ends_with("_count") || name == "version" ||
        name == "last_error")
      CHECK(call() == DASHPOT_OK);
    else
      check_refused(name, call);
  }
}

TEST_CASE("steps with wrong sizes, with numbers that are none, out of their order") {
  const Model model = published();
  dashpot_model_info info;
  REQUIRE(dashpot_model_get_info(model, &info) == DASHPOT_OK);
  const std::size_t size = info.state_size;
  REQUIRE(size > 0);
  std::vector<double> state(size);
  const dashpot_input good = {0.01, 0.1, 1};
  double force = 0;
  for (const std::size_t wrong :
       {std::size_t{0}, size - 1, size + 1, std::numeric_limits<std::size_t>::max()}) {
    CAPTURE(wrong);
    check_refused("rest", [&] { return dashpot_rest(model, &good, state.data(), wrong); });
    check_refused("advance",
                  [&] { return dashpot_advance(model, &good, &good, 1e-3, state.data(), wrong); });
    check_refused("force",
                  [&] { return dashpot_force(model, &good, state.data(), wrong, &force); });
  }
  for (const double odd : {kNaN, kInfinity, -kInfinity})
    for (const dashpot_input& bad : {dashpot_input{odd, 0, 0}, {0, odd, 0}, {0, 0, odd}}) {
      check_refused("rest", [&] { return dashpot_rest(model, &bad, state.data(), size); });
      check_refused("from",
                    [&] { return dashpot_advance(model, &bad, &good, 1e-3, state.data(), size); });
      check_refused("to",
                    [&] { return dashpot_advance(model, &good, &bad, 1e-3, state.data(), size); });
      check_refused("force",
                    [&] { return dashpot_force(model, &bad, state.data(), size, &force); });
    }
  for (const double dt : {0.0, -1e-3, kNaN, kInfinity})
    check_refused("dt",
                  [&] { return dashpot_advance(model, &good, &good, dt, state.data(), size); });
  check_refused("no state", [&] { return dashpot_rest(model, &good, nullptr, size); });
  check_refused("no input", [&] { return dashpot_rest(model, nullptr, state.data(), size); });
  check_refused("no force",
                [&] { return dashpot_force(model, &good, state.data(), size, nullptr); });
  // A state that no model was ever in is a result that cannot be used, and no bad call.
  std::fill(state.begin(), state.end(), kNaN);
  CHECK(dashpot_force(model, &good, state.data(), size, &force) == DASHPOT_NOT_USABLE);
}

TEST_CASE("a step that is not a multiple of a model's own sample time is taken") {
  const Model model = published();
  dashpot_model_info info;
  REQUIRE(dashpot_model_get_info(model, &info) == DASHPOT_OK);
  std::vector<double> state(info.state_size);
  const dashpot_input at_rest = {0, 0, 0}, moving = {1e-4, 0.1, 0.5};
  REQUIRE(dashpot_rest(model, &at_rest, state.data(), state.size()) == DASHPOT_OK);
  for (const double dt : {1e-3, 0.3e-3, 1.7e-3, 1e-9, 0.05}) {
    CAPTURE(dt);
    CHECK(dashpot_advance(model, &at_rest, &moving, dt, state.data(), state.size()) == DASHPOT_OK);
    double force = kNaN;
    CHECK(dashpot_force(model, &moving, state.data(), state.size(), &force) == DASHPOT_OK);
    CHECK(std::isfinite(force));
  }
}

TEST_CASE("a motion that cannot be run") {
  const Model model = published();
  double zeros[4] = {}, force[4] = {};
  const dashpot_column values = {zeros, 1};
  const dashpot_motion good = {4, 1e-3, {}, values, values, values};
  const dashpot_response response = {force, nullptr, nullptr, 0};
  REQUIRE(dashpot_run(model, &good, &response) == DASHPOT_OK);
  const auto refused = [&](const std::string& what, auto spoil) {
    dashpot_motion motion = good;
    dashpot_response to = response;
    spoil(motion, to);
    check_refused(what, [&] { return dashpot_run(model, &motion, &to); });
  };
  refused("no velocity", [](auto& motion, auto&) { motion.velocity = {}; });
  refused("no current", [](auto& motion, auto&) { motion.current = {}; });
  refused("no displacement", [](auto& motion, auto&) { motion.displacement = {}; });
  refused("no sample time", [](auto& motion, auto&) { motion.sample_time = 0; });
  refused("a sample time that is none", [](auto& motion, auto&) { motion.sample_time = kNaN; });
  refused("time that stands still", [&](auto& motion, auto&) { motion.time = values; });
  refused("no place for the force", [](auto&, auto& to) { to.force = nullptr; });
  refused("a band that the model has not", [&](auto&, auto& to) { to.half_width = force; });
  refused("a state of another size", [&](auto&, auto& to) { to.state = force, to.state_size = 3; });
  zeros[2] = kNaN;
  refused("not a number", [](auto&, auto&) {});
}

TEST_CASE("what is taken from a ranking, from recordings and from names that are not there") {
  Recordings recordings;
  REQUIRE(dashpot_recordings_new(&recordings) == DASHPOT_OK);
  dashpot_record_info info;
  dashpot_channel channel;
  for (const std::size_t far : {std::size_t{0}, std::numeric_limits<std::size_t>::max()}) {
    check_refused("record", [&] { return dashpot_recordings_get_info(recordings, far, &info); });
    check_refused("channel",
                  [&] { return dashpot_recordings_channel(recordings, far, far, &channel); });
  }
  char* text = nullptr;
  check_refused("nothing to describe",
                [&] { return dashpot_recordings_describe(recordings, &text); });
  dashpot_ranking* ranking = nullptr;
  check_refused("nothing to identify",
                [&] { return dashpot_identify(recordings, nullptr, nullptr, &ranking); });
  const Model model = published();
  check_refused("nothing to evaluate",
                [&] { return dashpot_evaluate(model, recordings, nullptr, &text); });
  const dashpot_thing both[] = {{"model", model, nullptr}, {"both", model, recordings}};
  check_refused("one thing alone", [&] { return dashpot_compare(both, 1, nullptr, &text); });
  check_refused("a model and recordings in one",
                [&] { return dashpot_compare(both, 2, nullptr, &text); });
  CHECK(text == nullptr);
  CHECK(ranking == nullptr);
}

TEST_CASE("a model file that was cut off anywhere is refused") {
  const Model model = published();
  Text text;
  REQUIRE(dashpot_model_text(model, &text) == DASHPOT_OK);
  const std::string whole = text.handle;
  REQUIRE(whole.size() > 200);
  for (std::size_t length = 0; length + 2 < whole.size(); length += 37) {
    CAPTURE(length);
    dashpot_model* none = nullptr;
    check_refused("cut",
                  [&] { return dashpot_model_parse(whole.substr(0, length).c_str(), &none); });
    CHECK(none == nullptr);
  }
}

#ifndef __SANITIZE_ADDRESS__  // which needs more memory than is left here
TEST_CASE("a text that takes more memory than there is gives a status, and its host lives on") {
  std::string text = "[0";
  for (int k = 0; k < 1'900'000; ++k) text += ",0";
  text += ']';

  // In a child, whose room is what it has by now and 60 MB.
  const pid_t child = fork();
  if (child == 0) {
    std::ifstream sizes("/proc/self/statm");
    rlim_t pages = 0;
    sizes >> pages;
    const rlim_t room = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + 60'000'000;
    const rlimit limit{room, room};
    if (setrlimit(RLIMIT_AS, &limit) != 0) _exit(90);
    dashpot_model* model = nullptr;
    const dashpot_status status = dashpot_model_parse(text.c_str(), &model);
    _exit(status == DASHPOT_FAILED && !model &&
                  std::string(dashpot_last_error()) == "there is not enough memory"
              ? 0
              : 1 + static_cast<int>(status));
  }
  int status = 0;
  waitpid(child, &status, 0);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}
#endif
