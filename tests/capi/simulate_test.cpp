#include "dashpot/suspension/ground/ground_sequences.h"
#include "dashpot/value.h"
#include "dashpot/vehicle.h"
#include "handles.h"

TEST_CASE("a vehicle by words drives as it does inside the library") {
  Recordings trace;
  Text report;
  REQUIRE(dashpot_simulate(R"({"road": "step,height=3cm", "duration": 1, "controller": "sh_add"})",
                           nullptr, &trace, &report) == DASHPOT_OK);
  const dashpot::Vehicle vehicle = dashpot::make_vehicle({.controller = "sh_add"});
  const dashpot::GroundPointer ground = dashpot::make_ground("step,height=3cm", 1);
  const dashpot::Trace expected = dashpot::simulate(vehicle.on(*ground), vehicle.options(1));
  dashpot_record_info info;
  REQUIRE(dashpot_recordings_get_info(trace, 0, &info) == DASHPOT_OK);
  REQUIRE(info.samples == expected.record.size());
  CHECK(info.channel_count == expected.record.channels.size());
  for (std::size_t c = 0; c < info.channel_count; ++c) {
    dashpot_channel channel;
    REQUIRE(dashpot_recordings_channel(trace, 0, c, &channel) == DASHPOT_OK);
    CHECK(channel.name == expected.record.channels[c].name);
    CHECK(std::equal(channel.data, channel.data + info.samples,
                     expected.record.channels[c].samples.begin()));
  }
  const dashpot::Value json = dashpot::parse_json(report.handle, "report");
  CHECK(json.find("controller")->as_string() == "sh_add");
  CHECK(json.find("diverged_at")->is_null());
}

TEST_CASE("the trace has the drive in the damper's unit") {
  for (const auto& [damper, unit] : {std::pair{"spencer1997", "V"}, {"vrths_mr_bingham", "A"}}) {
    CAPTURE(damper);
    Recordings trace;
    const std::string options =
        R"({"duration": 0.1, "current": 1, "dampers": [")" + std::string(damper) + R"("]})";
    REQUIRE(dashpot_simulate(options.c_str(), nullptr, &trace, nullptr) == DASHPOT_OK);
    dashpot_record_info info;
    REQUIRE(dashpot_recordings_get_info(trace, 0, &info) == DASHPOT_OK);
    int drives = 0;
    for (std::size_t c = 0; c < info.channel_count; ++c) {
      dashpot_channel channel;
      REQUIRE(dashpot_recordings_channel(trace, 0, c, &channel) == DASHPOT_OK);
      const std::string name = channel.name;
      if (!name.ends_with("_current") && !name.ends_with("_command")) continue;
      ++drives;
      CHECK(std::string(channel.unit) == unit);
    }
    CHECK(drives == 2);
  }
}

TEST_CASE("words that nothing is known by are refused") {
  dashpot_recordings* trace = nullptr;
  const auto refusal = [&](const char* options) {
    return message_of(DASHPOT_BAD_INPUT, dashpot_simulate(options, nullptr, &trace, nullptr));
  };
  CHECK(contains(refusal(R"({"plant": "savaresi"})"), "savaresi"));
  CHECK(contains(refusal(R"({"road": "gravel"})"), "gravel"));
  CHECK(contains(refusal(R"({"controller": "sh3"})"), "sh3"));
  CHECK(contains(refusal(R"({"duration": -1})"), "duration"));
  for (const char* current : {"current", "current_max"})
    CHECK(contains(refusal(("{\"" + std::string(current) + "\": -1}").c_str()),
                   current + std::string(": is -1; A or V, 0")));
  CHECK(contains(refusal(R"({"speed": 1})"), "unknown key 'speed'"));
  CHECK(contains(refusal("nonsense"), "options"));
  // What would have no effect is refused, as on the command line.
  CHECK(contains(refusal(R"({"current": 1, "controller": "mix1"})"),
                 "current: is where there is no controller"));
  for (const char* idle : {"\"inverse\": \"numeric\"", "\"in_car\": true", "\"delay\": 0.005"})
    CHECK(contains(refusal(("{" + std::string(idle) + "}").c_str()),
                   "serves a controller, and there is none"));
  CHECK(dashpot_simulate(nullptr, nullptr, nullptr, nullptr) == DASHPOT_BAD_INPUT);
  CHECK(trace == nullptr);
}

TEST_CASE("a trace takes no arrays") {
  Recordings trace;
  REQUIRE(dashpot_simulate(R"({"road": "step", "duration": 0.1})", nullptr, &trace, nullptr) ==
          DASHPOT_OK);
  const double value = 0;
  const dashpot_named_column column = {"F_N", {&value, 0}};
  const dashpot_table table = {nullptr, 2, 0.1, &column, 1, nullptr};
  CHECK(contains(message_of(DASHPOT_BAD_INPUT, dashpot_recordings_add(trace, &table)),
                 "not made empty"));
}
