#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <thread>

#include "dashpot/base/file.h"
#include "dashpot/value.h"
#include "handles.h"

using dashpot::parse_json;
using dashpot::Value;

namespace {

Recordings bench() {
  Recordings recordings;
  REQUIRE(dashpot_recordings_new(&recordings) == DASHPOT_OK);
  for (const double current : {0.0, 0.5, 1.0})
    REQUIRE(BinghamBench(current).add_to(
                recordings, ("at " + std::to_string(current) + " A").c_str()) == DASHPOT_OK);
  return recordings;
}

const Value& parameter(const Value& report, const std::string& name) {
  for (const Value& p : report.find("parameters")->items())
    if (p.find("name")->as_string() == name) return p;
  FAIL("no parameter " << name);
  return report;
}

}  // namespace

TEST_CASE("arrays are fitted: the damper's own numbers come out") {
  const Recordings recordings = bench();
  CHECK(dashpot_recordings_count(recordings) == 3);
  Model model;
  Text report;
  REQUIRE(dashpot_fit(recordings, R"({"models": ["bingham"], "starts": 1, "threads": 1})", nullptr,
                      &model, &report) == DASHPOT_OK);
  // The closed form that made the recordings.
  const dashpot_input fast = {0, 0.2, 0.5};
  double force = 0;
  REQUIRE(dashpot_force(model, &fast, nullptr, 0, &force) == DASHPOT_OK);
  CHECK_CLOSE(force, 400 + 200 * 0.5 + 1000 * 0.2, 1e-6, 0);
  const Value json = parse_json(report.handle, "report");
  CHECK(json.find("status")->as_string() == "converged");
  CHECK_CLOSE(parameter(json, "c0_a").find("value")->as_number(), 1000, 1e-6, 0);
}

TEST_CASE(
    "unless models are named, a budget chooses them and the report says what it left untried") {
  const Recordings recordings = bench();
  HeldRanking ranking;
  REQUIRE(dashpot_identify(recordings, R"({"budget": 1e-6, "starts": 1, "threads": 1})", nullptr,
                           &ranking) == DASHPOT_OK);
  CHECK(dashpot_ranking_count(ranking) == 1);
  Text json;
  REQUIRE(dashpot_ranking_report(ranking, "json", &json) == DASHPOT_OK);
  const Value budget = *parse_json(json.handle, "report").find("budget");
  CHECK(budget.find("minutes")->as_number() == 1e-6);
  CHECK(!budget.find("untried")->items().empty());

  dashpot_ranking* none = nullptr;
  CHECK(contains(message_of(DASHPOT_BAD_INPUT,
                            dashpot_identify(recordings, R"({"budget": -1})", nullptr, &none)),
                 "options, budget: is -1; minutes, 0 (no limit) or more"));
}

TEST_CASE("models are ranked, reported and taken from the ranking") {
  const Recordings recordings = bench();
  HeldRanking ranking;
  REQUIRE(
      dashpot_identify(recordings,
                       R"({"models": ["bingham", "biviscous"], "leave_out": "current", "starts": 1,
                               "threads": 1, "command": "a test"})",
                       nullptr, &ranking) == DASHPOT_OK);
  CHECK(dashpot_ranking_count(ranking) == 2);
  Model best;
  REQUIRE(dashpot_ranking_model(ranking, 0, &best) == DASHPOT_OK);
  dashpot_model_info info;
  REQUIRE(dashpot_model_get_info(best, &info) == DASHPOT_OK);
  CHECK(info.velocity_max == std::ranges::max(BinghamBench(0).v));
  CHECK(info.current_max == 1);
  CHECK(info.interval_level == 0.9);
  Text json, html, table;
  REQUIRE(dashpot_ranking_report(ranking, "json", &json) == DASHPOT_OK);
  CHECK(parse_json(json.handle, "report").find("models")->items()[0].find("name")->as_string() ==
        info.name);
  CHECK(dashpot_ranking_report(ranking, "html", &html) == DASHPOT_OK);
  REQUIRE(dashpot_ranking_report(ranking, "text", &table) == DASHPOT_OK);
  CHECK(contains(table.handle, "Bingham"));
  CHECK(parse_json(json.handle, "report").find("leaders")->items()[0].as_string() == info.name);
  char* text = nullptr;
  CHECK(contains(message_of(DASHPOT_BAD_INPUT, dashpot_ranking_report(ranking, "pdf", &text)),
                 "markdown"));
  dashpot_model* none = nullptr;
  CHECK(contains(message_of(DASHPOT_BAD_INPUT, dashpot_ranking_model(ranking, 2, &none)),
                 "there are 2"));

  // What the ranking's model has as its band is there for every sample.
  const BinghamBench motion(0.5);
  dashpot_motion input = {};
  input.samples = motion.v.size();
  input.sample_time = 0.005;
  input.displacement = {motion.x.data(), 1}, input.velocity = {motion.v.data(), 1};
  input.current = {motion.i.data(), 1};
  std::vector<double> force(input.samples), half(input.samples);
  const dashpot_response response = {force.data(), half.data(), nullptr, 0};
  REQUIRE(dashpot_run(best, &input, &response) == DASHPOT_OK);
  CHECK(half[17] > 0);

  Text evaluation;
  REQUIRE(dashpot_evaluate(best, recordings, nullptr, &evaluation) == DASHPOT_OK);
  CHECK(
      parse_json(evaluation.handle, "evaluation").find("pooled")->find("esr_percent")->as_number() <
      2);
}

TEST_CASE(
    "recordings in arrays are read as a file's columns: units, derived velocity, nothing flipped") {
  const BinghamBench motion(1);
  std::vector<double> x_mm, pushed;
  for (std::size_t k = 0; k < motion.x.size(); ++k) {
    x_mm.push_back(1000 * motion.x[k]);
    pushed.push_back(-motion.f[k]);
  }
  Recordings recordings;
  REQUIRE(dashpot_recordings_new(&recordings) == DASHPOT_OK);
  const dashpot_named_column columns[] = {
      {"x_mm", {x_mm.data(), 1}}, {"F_N", {pushed.data(), 1}}, {"i_A", {motion.i.data(), 0}}};
  const dashpot_table table = {nullptr, x_mm.size(), 0.005, columns, 3, "{\"gap\": 0.001}"};
  REQUIRE(dashpot_recordings_add(recordings, &table) == DASHPOT_OK);
  dashpot_record_info info;
  REQUIRE(dashpot_recordings_get_info(recordings, 0, &info) == DASHPOT_OK);
  CHECK(std::string(info.name) == "recording 1");
  CHECK(info.sample_time == 0.005);
  std::map<std::string, const double*> channels;
  for (std::size_t c = 0; c < info.channel_count; ++c) {
    dashpot_channel channel;
    REQUIRE(dashpot_recordings_channel(recordings, 0, c, &channel) == DASHPOT_OK);
    channels[channel.name] = channel.data;
  }
  REQUIRE(channels.count("velocity") == 1);
  CHECK_CLOSE(channels.at("displacement")[30], motion.x[30], 1e-12, 0);
  CHECK_CLOSE(channels.at("velocity")[200], motion.v[200], 0.02, 1e-3);
  CHECK(channels.at("force")[30] == pushed[30]);
  Text text;
  REQUIRE(dashpot_recordings_describe(recordings, &text) == DASHPOT_OK);
  CHECK(contains(text.handle, "x_mm"));
}

TEST_CASE("a file of a folder that cannot be read is left out, and told") {
  const TemporaryFolder folder;
  std::string good = "t_s,x_mm,F_N,i_A\n";
  for (int k = 0; k < 200; ++k)
    good += std::to_string(0.01 * k) + ',' + std::to_string(5 * std::sin(0.1 * k)) + ',' +
            std::to_string(90 * std::cos(0.1 * k)) + ",1\n";
  folder.write("data/good.csv", good);
  folder.write("data/torn.csv", good.substr(0, 1000) + "1.5,,\n" + good.substr(1000));
  const std::string data = (folder.path() / "data").string();
  const char* path = data.c_str();
  Recordings recordings;
  REQUIRE(dashpot_recordings_load(&path, 1, nullptr, &recordings) == DASHPOT_OK);
  CHECK(dashpot_recordings_count(recordings) == 1);
  Text text;
  REQUIRE(dashpot_recordings_unread(recordings, &text) == DASHPOT_OK);
  const Value unread = parse_json(text.handle, "unread");
  REQUIRE(unread.items().size() == 1);
  CHECK(unread.items()[0].find("file")->as_string() == "torn.csv");
  CHECK(contains(unread.items()[0].find("why")->as_string(), "torn.csv:"));
}

TEST_CASE("what a column is by its name") {
  dashpot_column_meaning meaning;
  REQUIRE(dashpot_understand_column("velocity [mm/s]", &meaning) == DASHPOT_OK);
  CHECK(std::string(meaning.channel) == "velocity");
  CHECK_CLOSE(meaning.factor, 1e-3, 1e-15, 0);
  REQUIRE(dashpot_understand_column("temperature [degC]", &meaning) == DASHPOT_OK);
  CHECK_CLOSE(meaning.shift, 273.15, 1e-12, 0);
  REQUIRE(dashpot_understand_column("operator", &meaning) == DASHPOT_OK);
  CHECK(std::string(meaning.channel).empty());
  CHECK(dashpot_understand_column(nullptr, &meaning) == DASHPOT_BAD_INPUT);
}

TEST_CASE("recordings that cannot serve are refused, and nothing is added") {
  Recordings recordings;
  REQUIRE(dashpot_recordings_new(&recordings) == DASHPOT_OK);
  BinghamBench motion(1);
  dashpot_named_column columns[] = {
      {"x", {motion.x.data(), 1}}, {"F", {motion.f.data(), 1}}, {"i", {motion.i.data(), 1}}};
  dashpot_table table = {"one", motion.x.size(), 0.005, columns, 3, nullptr};
  const auto refusal = [&] {
    return message_of(DASHPOT_BAD_INPUT, dashpot_recordings_add(recordings, &table));
  };
  table.samples = 1;
  CHECK(contains(refusal(), "has 1 sample"));
  table.samples = 0;
  CHECK(contains(refusal(), "has 0 samples"));
  table.samples = motion.x.size();
  table.sample_time = -1;
  CHECK(contains(refusal(), "sample_time"));
  table.sample_time = 0;
  CHECK(contains(refusal(), "no column is time"));
  CHECK(contains(refusal(), "; give a sample_time in s, or name a column 'time [s]'"));
  table.sample_time = 0.005;
  table.conditions = "{\"gap\": \"wide\"}";
  CHECK(contains(refusal(), "conditions"));
  table.conditions = nullptr;
  table.column_count = 1;
  CHECK(contains(refusal(), "no column is force"));
  table.column_count = 3;
  motion.f[5] = std::nan("");
  CHECK(contains(refusal(), "one, row 6: force (F) is 'nan', not a finite number; leave that"));
  motion.f[5] = 0;
  columns[1].column.data = nullptr;
  CHECK(contains(refusal(), "F: is null"));
  columns[1].column.data = motion.f.data();
  columns[0].name = nullptr;
  CHECK(contains(refusal(), "null"));
  columns[0].name = "x";
  CHECK(dashpot_recordings_count(recordings) == 0);
  REQUIRE(dashpot_recordings_add(recordings, &table) == DASHPOT_OK);
  CHECK(contains(refusal(), "one: is there already"));
  table.name = "two";
  columns[2].name = "voltage [V]";
  CHECK(contains(refusal(), "two: has a drive in V; the recordings before it have a drive in A"));
  table.column_count = 2;
  CHECK(contains(refusal(), "two: has no current or voltage"));
}

TEST_CASE("recordings in memory without a drive are fitted at one constant, unknown drive") {
  Recordings recordings;
  REQUIRE(dashpot_recordings_new(&recordings) == DASHPOT_OK);
  BinghamBench motion(1);
  for (double& x : motion.x) x += 0.075;
  dashpot_named_column columns[] = {{"x", {motion.x.data(), 1}}, {"F", {motion.f.data(), 1}}};
  const dashpot_table table = {"one", motion.x.size(), 0.005, columns, 2, nullptr};
  REQUIRE(dashpot_recordings_add(recordings, &table) == DASHPOT_OK);

  Model model;
  REQUIRE(dashpot_fit(recordings, "{\"models\": [\"bingham\"]}", nullptr, &model, nullptr) ==
          DASHPOT_OK);
  dashpot_model_info info;
  REQUIRE(dashpot_model_get_info(model, &info) == DASHPOT_OK);
  CHECK(std::string(info.drive_unit).empty());

  // Arrays are taken as they are: no stroke is centred behind the back of who gives them.
  dashpot_channel x;
  REQUIRE(dashpot_recordings_channel(recordings, 0, 1, &x) == DASHPOT_OK);
  CHECK(x.data[0] == motion.x[0]);
  char* text = nullptr;
  REQUIRE(dashpot_recordings_describe(recordings, &text) == DASHPOT_OK);
  CHECK(contains(text, "is an absolute stroke: laws of displacement expect its middle at 0"));
  dashpot_text_free(&text);
}

TEST_CASE("wrong options, paths and calls in the wrong order give a status") {
  const Recordings recordings = bench();
  dashpot_model* model = nullptr;
  const auto refusal = [&](const char* options) {
    return message_of(DASHPOT_BAD_INPUT,
                      dashpot_fit(recordings, options, nullptr, &model, nullptr));
  };
  CHECK(contains(refusal("{"), "options"));
  CHECK(contains(refusal("[]"), "options"));
  CHECK(contains(refusal(R"({"model": "bingham"})"),
                 "options, model: the JSON has an unknown key 'model'"));
  CHECK(contains(refusal(R"({"models": ["bingam"]})"), "did you mean 'bingham'"));
  CHECK(contains(refusal(R"({"models": []})"), "names no model"));
  CHECK(contains(refusal(nullptr), "options, models: 'usual' is "));
  CHECK(contains(refusal(nullptr), "one; dashpot_identify compares several"));
  CHECK(contains(refusal(R"({"models": ["bingham"], "starts": 0})"), "1 or more"));
  CHECK(contains(refusal(R"({"models": ["bingham"], "seed": -1})"), "0 or more"));
  CHECK(contains(refusal(R"({"models": ["bingham"], "force_offset": "some"})"), "record or none"));
  CHECK(contains(refusal(R"({"models": ["bingham"], "fix": ["alpha=1"]})"), "alpha"));
  CHECK(contains(refusal(R"({"models": ["bingham"], "leave_out": "nothing"})"), "nothing"));

  Recordings empty, read;
  REQUIRE(dashpot_recordings_new(&empty) == DASHPOT_OK);
  CHECK(contains(message_of(DASHPOT_BAD_INPUT, dashpot_fit(empty, R"({"models": ["bingham"]})",
                                                           nullptr, &model, nullptr)),
                 "there are none"));
  dashpot_ranking* ranking = nullptr;
  CHECK(dashpot_identify(empty, nullptr, nullptr, &ranking) == DASHPOT_BAD_INPUT);
  const char* paths[] = {"/nowhere", nullptr};
  CHECK(contains(message_of(DASHPOT_BAD_INPUT, dashpot_recordings_load(paths, 1, nullptr, &read)),
                 "nowhere"));
  CHECK(dashpot_recordings_load(paths, 2, nullptr, &read) == DASHPOT_BAD_INPUT);
  CHECK(dashpot_recordings_load(paths, 0, nullptr, &read) == DASHPOT_BAD_INPUT);
  CHECK(dashpot_recordings_load(nullptr, 1, nullptr, &read) == DASHPOT_BAD_INPUT);
  dashpot_record_info info;
  dashpot_channel channel;
  CHECK(dashpot_recordings_get_info(recordings, 3, &info) == DASHPOT_BAD_INPUT);
  CHECK(dashpot_recordings_get_info(recordings, 0, nullptr) == DASHPOT_BAD_INPUT);
  CHECK(dashpot_recordings_channel(recordings, 0, 99, &channel) == DASHPOT_BAD_INPUT);
  CHECK(dashpot_recordings_channel(nullptr, 0, 0, &channel) == DASHPOT_BAD_INPUT);
  CHECK(dashpot_recordings_add(recordings, nullptr) == DASHPOT_BAD_INPUT);
  CHECK(dashpot_recordings_add(nullptr, nullptr) == DASHPOT_BAD_INPUT);
  CHECK(dashpot_recordings_describe(nullptr, nullptr) == DASHPOT_BAD_INPUT);
  CHECK(dashpot_recordings_count(nullptr) == 0);
  CHECK(dashpot_ranking_count(nullptr) == 0);
  CHECK(dashpot_ranking_model(nullptr, 0, &model) == DASHPOT_BAD_INPUT);
  CHECK(dashpot_ranking_report(nullptr, "json", nullptr) == DASHPOT_BAD_INPUT);
  CHECK(dashpot_evaluate(nullptr, recordings, nullptr, nullptr) == DASHPOT_BAD_INPUT);
  char* report = nullptr;
  const Model of_volts = published();
  CHECK(contains(
      message_of(DASHPOT_BAD_INPUT, dashpot_evaluate(of_volts, recordings, nullptr, &report)),
      "driven in V, but the recordings are driven in A"));
}

TEST_CASE(
    "a monitor is told of progress, stops the work, and is called on the caller's thread alone") {
  struct Seen {
    std::thread::id caller = std::this_thread::get_id();
    int questions = 0, reports = 0, elsewhere = 0;
  } seen;
  dashpot_monitor monitor = {};
  monitor.context = &seen;
  monitor.is_cancelled = [](void* context) {
    auto& s = *static_cast<Seen*>(context);
    s.elsewhere += std::this_thread::get_id() != s.caller;
    return static_cast<int>(++s.questions > 2);
  };
  monitor.on_progress = [](const char* stage, double fraction, void* context) {
    auto& s = *static_cast<Seen*>(context);
    s.elsewhere += std::this_thread::get_id() != s.caller;
    s.reports += std::strlen(stage) > 0 && fraction >= 0 && fraction <= 1;
  };
  const Recordings recordings = bench();
  dashpot_ranking* ranking = nullptr;
  // Many starts of a slow law: minutes, if nobody stopped it.
  CHECK(message_of(
            DASHPOT_CANCELLED,
            dashpot_identify(recordings, R"({"models": ["modified_bouc_wen"], "starts": 1000})",
                             &monitor, &ranking)) == "interrupted");
  CHECK(ranking == nullptr);
  CHECK(seen.questions >= 3);
  CHECK(seen.reports >= 1);
  CHECK(seen.elsewhere == 0);
}

TEST_CASE("errors are each thread's own") {
  dashpot_model* model = nullptr;
  CHECK(dashpot_model_published("nobody", &model) == DASHPOT_BAD_INPUT);
  std::string other = "not asked";
  std::thread([&] { other = dashpot_last_error(); }).join();
  CHECK(other.empty());
  CHECK(contains(dashpot_last_error(), "nobody"));
}

TEST_CASE("a cut-off of a negative frequency is refused") {
  const char* path = "anywhere";
  dashpot_recordings* recordings = nullptr;
  CHECK(contains(
      message_of(DASHPOT_BAD_INPUT,
                 dashpot_recordings_load(&path, 1, R"({"velocity_cutoff": -5})", &recordings)),
      "velocity_cutoff: is -5; Hz, 0 (from the motion) or more"));
}
