#include "drive.h"

#include <algorithm>
#include <vector>

#include "child.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "vehicle_words.h"

namespace fs = std::filesystem;

namespace dashpot::studio {
namespace {

constexpr ChildLimits kDriving{
    .memory = std::size_t{2} << 30, .cpu_seconds = 60, .file = std::size_t{256} << 20};
constexpr int kMostDriving = 4;
constexpr std::size_t kMostDrives = 100;
constexpr const char* kAnswerFile = "drive.json";
constexpr int kKeyLength = 32;

/// What the drive depends on: its words, and the bytes of the model that they name.
std::string key_of(const std::vector<std::string>& words) {
  std::string text = join(words, "\n");
  const auto at = std::ranges::find(words, "--damper");
  if (at != words.end())
    if (const fs::path file = at[1].substr(0, at[1].find(',')); fs::is_regular_file(file))
      text += sha256_of_file(file);
  return sha256(text).substr(0, kKeyLength);
}

/// The names and units of the columns of its first run.
Value channels_of(const fs::path& samples) {
  const fs::path file = samples / "samples.json";
  const Value index = parse_json(read_file(file), file.string());
  Value channels = Value::array();
  for (const Value& column : index.find("records")->items().front().find("columns")->items())
    channels.push_back(
        Value::object({{"name", *column.find("name")}, {"unit", *column.find("unit")}}));
  return channels;
}

/// Counts a drive while it lasts.
class Running {
 public:
  Running(std::mutex& mutex, int& running) : mutex_(mutex), running_(running) {
    const std::lock_guard lock(mutex_);
    if (running_ >= kMostDriving)
      throw Error("", "too many drives at once", "wait for one of them");
    ++running_;
  }
  ~Running() {
    const std::lock_guard lock(mutex_);
    --running_;
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

 private:
  std::mutex& mutex_;
  int& running_;
};

}  // namespace

Value Drives::drive(const Value& asked) {
  // The command's words; those that are no option of it are refused.
  ObjectReader reader(asked, "a drive");
  std::vector<std::string> words{"simulate"};
  const std::vector<std::string> vehicle = vehicle_words(project_, reader);
  words.insert(words.end(), vehicle.begin(), vehicle.end());
  const std::string against = reader.string("against", "");
  reader.finish();
  if (!against.empty() && against != "none")
    throw Error("'" + against + "'", "is nothing to compare with", "none, or empty");
  if (!against.empty()) words.insert(words.end(), {"--against", against});

  // The same drive was driven before.
  const std::string key = key_of(words);
  const fs::path place = folder() / key;
  if (fs::exists(place / kAnswerFile))
    return parse_json(read_file(place / kAnswerFile), kAnswerFile);

  // Otherwise it is driven now; its answer is written last.
  const Running running(mutex_, running_);
  std::vector<std::string> arguments = words;
  arguments.insert(arguments.end(), {"--samples", place.string(), "--json", "--quiet"});
  const ChildEnd end = run_self(arguments, project_.folder(), kDriving);
  constexpr int kNotUsable = 3;
  if ((end.exit_code != 0 && end.exit_code != kNotUsable) || end.out.empty())
    throw Error("", project_.without_folder(error_of(end)));
  Value answer = parse_json(end.out, "dashpot simulate");
  answer.add("key", key);
  answer.add("channels", channels_of(place));
  answer.add("arguments", Value::array(words));
  write_file(place / kAnswerFile, format_json(answer, false));
  forget_old();
  return answer;
}

fs::path Drives::traces(const std::string& key) const {
  if (key.size() != kKeyLength || key.find_first_not_of("0123456789abcdef") != std::string::npos)
    throw Error("'" + key + "'", "is no drive");
  return folder() / key;
}

void Drives::forget_old() const {
  using Entry = std::pair<fs::file_time_type, fs::path>;
  std::vector<Entry> all;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder(), error)) {
    std::error_code none;
    all.emplace_back(fs::last_write_time(entry.path(), none), entry.path());
  }
  std::ranges::sort(all);
  for (std::size_t k = 0; k + kMostDrives < all.size(); ++k) fs::remove_all(all[k].second, error);
}

}  // namespace dashpot::studio
