#include "dashpot/damper/inverse/inverse_file.h"

#include "damper/inverse/example_network.h"
#include "damper/inverse/inverses.h"
#include "dashpot/base/random.h"
#include "dashpot/base/text.h"
#include "support.h"

using namespace dashpot;

namespace {

InverseFile example_file(const InverseNetworkPreset& preset) {
  InverseFile file{.network = example_network(preset), .drive_unit = DriveUnit::Volt};
  file.domain = {.displacement_min = -0.02, .displacement_max = 0.01, .current_max = 1};
  file.quality = Value::object({{"left_out_current_rmse", 0.1 / 3}});
  file.provenance.command = "dashpot invert";
  file.provenance.training_records = {"a", "b"};
  return file;
}

/// The message when `from` in a good file is replaced by `to`.
std::string message_with(const std::string& from, const std::string& to) {
  std::string text = format_inverse(example_file(find_inverse_network("static")));
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  text.replace(at, from.size(), to);
  return message_of([&] { parse_inverse(text, "i.json"); });
}

}  // namespace

TEST_CASE("inverse file: read back bit for bit, and the same currents") {
  const TemporaryFolder folder;
  for (const InverseNetworkPreset& preset : inverse_network_presets()) {
    InverseFile file = example_file(preset);
    if (preset.name == "history") file.network.rate_max = 30;
    save_inverse(file, folder.path() / "i.json");
    const InverseFile again = load_inverse(folder.path() / "i.json");
    CHECK(format_inverse(again) == format_inverse(file));
    CHECK(again.network.taps == file.network.taps);
    CHECK(again.network.mlp.parameters == file.network.mlp.parameters);
    CHECK(again.drive_unit == DriveUnit::Volt);

    const HistoryNetwork one(file.network, {}), other(again.network, {});
    std::vector<double> state(one.state_size()), others(other.state_size());
    one.rest({}, state);
    other.rest({}, others);
    Random random(3);
    for (int k = 0; k < 100; ++k) {
      const InverseInput input{1000 * random.normal(), 0.01 * random.normal(),
                               0.1 * random.normal(), 0.5, 0};
      CHECK(one.command(input, state) == other.command(input, others));
    }
  }
}

TEST_CASE("inverse file: what is wrong is named with its key") {
  const struct {
    const char *from, *to, *message;
  } cases[] = {
      {"dashpot-inverse", "dashpot-model",
       "is a model file, not a file of an inverse; one that 'dashpot invert' wrote"},
      {"dashpot-inverse", "dashpot-invers",
       "is 'dashpot-invers', not a file of an inverse; write dashpot-inverse"},
      {"\"version\": 1", "\"version\": 2", "version 2 is not known here"},
      {"\"sample_time\": 0.005", "\"sample_time\": -1", "its step is not between"},
      {"\"signal\": \"force\"", "\"signal\": \"forse\"",
       "unknown signal 'forse'; did you mean 'force'?"},
      {"\"signal\": \"force\"", "\"signal\": \"current\"", "a delay of 0 steps of the current"},
      {"\"delay\": 0", "\"delay\": 0.5", "its delay is no number of steps"},
      {"\"unit\": \"V\"", "\"unit\": \"A\"", "unit is 'A'; write V"},
      {"\"layers\"", "\"layer\"", "layers"},
      {"\"name\": \"static\",", "\"name\": \"static\", \"rate_max\": -2,",
       "its rate limit is below 0"},
      {"\"quality\"", "\"qualities\"", "qualities"},
  };
  for (const auto& c : cases) {
    const std::string message = message_with(c.from, c.to);
    CAPTURE(message);
    CHECK(message.starts_with("i.json"));
    CHECK(message.find(c.message) != std::string::npos);
  }
}
