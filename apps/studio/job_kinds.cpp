#include "job_kinds.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/registry.h"
#include "dashpot/dataset.h"
#include "dashpot/design/design_request.h"
#include "dashpot/error.h"
#include "dashpot/machine/comfort_ride.h"
#include "dashpot/physics/damper_description.h"
#include "start_model.h"
#include "vehicle_words.h"

namespace fs = std::filesystem;

namespace dashpot::studio {
namespace {

constexpr const char* kRequestFile = "request.yaml";
constexpr const char* kStartFile = "start.json";

std::vector<std::string> strings(const Value& list) {
  std::vector<std::string> texts;
  for (const Value& item : list.items()) texts.push_back(item.as_string());
  return texts;
}

void require_models(const std::vector<std::string>& models) {
  std::vector<std::string> known = model_names();
  for (const std::string& more : more_model_names()) known.push_back(more);
  known.insert(known.end(), {"usual", "all", "family"});
  if (models.empty()) throw Error("models", "none is chosen");
  for (const std::string& model : models)
    if (std::ranges::find(known, model) == known.end())
      throw Error("'" + model + "'", "is no model", suggest(model, known));
}

/// Where a fit of one law begins; it stands in its folder once the fit has begun.
std::string start_of(const Project& project, const Value& asked) {
  const std::vector<std::string> models = strings(*asked.find("models"));
  if (models.size() != 1) throw Error("from", "is a start of one law", "one model");
  return start_model(project, *asked.find("from"), models.front());
}

std::vector<std::string> fit_command(const Project& project, const fs::path& folder,
                                     const Value& asked) {
  ObjectReader reader(asked, "a fit");
  const std::vector<std::string> models = strings(reader.required("models"));
  const std::string leave_out = reader.string("leave_out", "");
  const Value* from = reader.optional("from");
  reader.finish();
  require_models(models);
  std::vector<std::string> words{"rank", project.folder().string(), "--models", join(models, ",")};
  if (!leave_out.empty()) {
    parse_leave_out(leave_out);
    words.insert(words.end(), {"--leave-out", leave_out});
  }
  if (from) {
    const fs::path start =
        project.inside((folder / kStartFile).lexically_relative(project.folder()).string());
    if (!fs::exists(start)) start_of(project, asked);
    words.insert(words.end(), {"--from", start.string(), "--starts", "1"});
  }
  return words;
}

void write_start(const Project& project, const fs::path& folder, const Value& asked) {
  if (asked.find("from") && !fs::exists(folder / kStartFile))
    write_file(folder / kStartFile, start_of(project, asked));
}

std::vector<std::string> ride_command(const Project& project, const fs::path&, const Value& asked) {
  ObjectReader reader(asked, "a ride");
  const std::vector<std::string> controllers = strings(reader.required("controllers"));
  const bool bound = reader.boolean("bound", false);
  std::vector<std::string> words{"ride"};
  const std::vector<std::string> vehicle = vehicle_words(project, reader);
  reader.finish();
  words.insert(words.end(), vehicle.begin(), vehicle.end());
  if (controllers.empty()) throw Error("controllers", "none is chosen");
  for (const std::string& controller : controllers) require_controller(controller);
  words.insert(words.end(), {"--controllers", join(controllers, ";")});
  if (bound) words.emplace_back("--bound");
  return words;
}

/// A whole number as it was asked for; throws Error where it does not lie within the limits.
std::string count_word(double value, double low, double high, const std::string& what) {
  if (!(value >= low && value <= high) || value != std::floor(value))
    throw Error(what, "is " + format_number(value),
                "a whole number from " + format_number(low) + " to " + format_number(high));
  return format_number(value, 10);
}

DesignRequest parsed_request(const std::string& text) {
  return parse_request(text, kRequestFile, {}, Goals::Required, read_comfort_ride);
}

/// The request's text; throws Error where it is none, or names a file: what it starts from comes
/// with Dashpot.
std::string checked_request(const Value& asked) {
  const std::string text = asked.find("request") ? asked.find("request")->as_string() : "";
  const Value request = parse_yaml(text, kRequestFile);
  const Value* damper = request.kind() == Value::Kind::Object ? request.find("damper") : nullptr;
  const std::vector<std::string> known = description_names();
  if (!damper || damper->kind() != Value::Kind::String)
    throw Error(kRequestFile, "names no damper to start from", join(known, ", "));
  if (std::ranges::find(known, damper->as_string()) == known.end())
    throw Error(damper->where(),
                "'" + damper->as_string() + "' is no damper that comes with Dashpot",
                join(known, ", "));
  parsed_request(text);
  return text;
}

std::vector<std::string> design_command(const Project&, const fs::path& folder,
                                        const Value& asked) {
  ObjectReader reader(asked, "a design");
  reader.required("request");
  const std::string points = count_word(reader.number("points", 60), 4, 400, "points"),
                    generations =
                        count_word(reader.number("generations", 100), 1, 2000, "generations"),
                    seed = count_word(reader.number("seed", 1), 0, 1e9, "seed");
  const bool goes_on = reader.boolean("goes_on", false);
  reader.finish();
  checked_request(asked);
  std::vector<std::string> words{"design", (folder / kRequestFile).string()};
  words.insert(words.end(), {"--points", points, "--generations", generations, "--seed", seed});
  if (goes_on) words.insert(words.end(), {"--start-from", folder.string()});
  return words;
}

/// A front goes on from the designs that it has.
Value continued_design(const fs::path& folder, const Value& asked) {
  const std::string text = checked_request(asked);
  const bool has_front =
      parsed_request(text).goals.size() > 1 && fs::exists(folder / "designs" / "design_001.yaml");
  Value next = Value::object();
  for (const auto& [key, member] : asked.members())
    if (key != "goes_on") next.add(key, member);
  if (has_front) next.add("goes_on", true);
  return next;
}

void write_request(const Project&, const fs::path& folder, const Value& asked) {
  write_file(folder / kRequestFile, asked.find("request")->as_string());
}

constexpr std::array kJobKinds{
    JobKind{"fit", "fits", "report.html", fit_command, nullptr, write_start},
    JobKind{"ride", "rides", "report.html", ride_command, nullptr, nullptr},
    JobKind{"design", "designs", "design.html", design_command, continued_design, write_request}};

}  // namespace

std::span<const JobKind> job_kinds() { return kJobKinds; }

const JobKind& job_kind(std::string_view name) {
  const auto at = std::ranges::find(kJobKinds, name, &JobKind::name);
  if (at == kJobKinds.end())
    throw Error("'" + std::string(name) + "'", "is no kind of work", "fit, ride or design");
  return *at;
}

}  // namespace dashpot::studio
