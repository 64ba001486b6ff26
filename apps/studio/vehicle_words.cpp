#include "vehicle_words.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "dashpot/base/text.h"
#include "dashpot/controller.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/error.h"
#include "dashpot/plant.h"
#include "dashpot/suspension/dampers/damper_words.h"
#include "dashpot/suspension/dampers/passive_curve.h"
#include "dashpot/suspension/ground/ground_sequences.h"

namespace fs = std::filesystem;

namespace dashpot::studio {
namespace {

constexpr double kLongestDrive = 60;  // s
constexpr double kNotStated = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kLongestWords = 400;

/// Throws Error where `text` is no "name=value,name=value": numbers, units and words, no path.
void require_settings(const std::string& text) {
  if (text.size() > kLongestWords) throw Error("settings", "are too long");
  for (const std::string& setting : split(text, ',')) {
    const std::string_view one = trim(setting);
    const std::size_t equal = one.find('=');
    const std::string_view name = one.substr(0, equal), value = one.substr(equal + 1);
    const auto is_letter = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
    };
    constexpr std::string_view kValue =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.+-*/^% ";
    if (equal == std::string_view::npos || name.empty() || value.empty() || name == "file" ||
        !std::ranges::all_of(name, is_letter) ||
        value.find_first_not_of(kValue) != std::string_view::npos || value.front() == '/' ||
        value.find("..") != std::string_view::npos)
      throw Error("'" + setting + "'", "is no setting", "as speed=20 m/s");
  }
}

/// Head and settings of "iso8608,class=C"; throws Error where the head is none of `names`.
void require_words(const std::string& words, const std::string& what,
                   const std::vector<std::string>& names) {
  const std::size_t comma = words.find(',');
  const std::string head(trim(std::string_view(words).substr(0, comma)));
  if (std::ranges::find(names, head) == names.end())
    throw Error("'" + head + "'", "is no " + what, suggest(head, names));
  if (comma != std::string::npos) require_settings(words.substr(comma + 1));
}

std::vector<std::string> known_plants() {
  std::vector<std::string> names = plant_set_names();
  for (const PlantModel* model : plant_models()) names.emplace_back(model->name);
  return names;
}

std::vector<std::string> known_roads() {
  std::vector<std::string> names;
  for (const GroundSequence& sequence : ground_sequences()) names.emplace_back(sequence.info.name);
  return names;
}

std::vector<std::string> known_controllers() {
  std::vector<std::string> names;
  for (const ControlLaw* law : control_laws()) names.emplace_back(law->name);
  return names;
}

/// A damper that comes with Dashpot, or a model of the project by its path from the folder.
std::string damper_words(const Project& project, const std::string& damper) {
  std::vector<std::string> names = parameter_set_names();
  for (const std::string& curve : passive_curve_names()) names.push_back(curve);
  for (const SimpleDamper& simple : simple_dampers()) names.emplace_back(simple.name);
  if (std::ranges::find(names, damper) != names.end()) return damper;

  // The command separates dampers and settings by these.
  const fs::path file = project.inside(damper);
  if (!fs::is_regular_file(file) || file.extension() != ".json")
    throw Error("'" + damper + "'", "is no model of this project");
  if (file.string().find_first_of(",;") != std::string::npos)
    throw Error("'" + damper + "'", "cannot be driven: its path has a comma or a semicolon",
                "fit it under another name");
  return file.string();
}

/// A number as it was asked for; throws Error where it does not lie within the limits.
std::string number_word(double value, double low, double high, const std::string& what) {
  if (!(value >= low && value <= high))
    throw Error(what, "is " + format_number(value),
                "from " + format_number(low) + " to " + format_number(high));
  return format_number(value);
}

}  // namespace

void require_controller(const std::string& words) {
  require_words(words, "controller", known_controllers());
}

std::vector<std::string> vehicle_words(const Project& project, ObjectReader& asked) {
  // The plant, with values of its own.
  const std::string plant = asked.string("plant"), values = asked.string("values", "");
  require_words(plant, "plant", known_plants());
  std::vector<std::string> words{"--plant", plant};
  if (!values.empty()) {
    require_settings(values);
    words.insert(words.end(), {"--set", values});
  }

  // The damper; none: the plant's own range, ideal.
  const std::string damper = asked.string("damper", ""), settings = asked.string("settings", "");
  if (!damper.empty()) {
    if (!settings.empty()) require_settings(settings);
    words.insert(words.end(), {"--damper", damper_words(project, damper) +
                                               (settings.empty() ? "" : "," + settings)});
  }

  // What drives it: a controller, or a current that stays.
  if (const std::string controller = asked.string("controller", ""); !controller.empty()) {
    require_controller(controller);
    words.insert(words.end(), {"--controller", controller});
    if (asked.boolean("in_car", false)) words.emplace_back("--in-car");
  } else if (const double current = asked.number("current", 0); current != 0) {
    words.insert(words.end(), {"--current", number_word(current, 0, 1000, "current")});
  }

  // The ground below, and for how long.
  const std::string road = asked.string("road");
  require_words(road, "road", known_roads());
  words.insert(words.end(), {"--road", road});
  if (const double duration = asked.number("duration", kNotStated); !std::isnan(duration))
    words.insert(words.end(),
                 {"--duration", number_word(duration, 0.1, kLongestDrive, "duration")});
  return words;
}

}  // namespace dashpot::studio
