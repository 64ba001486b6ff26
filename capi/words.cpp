#include "words.h"

#include <algorithm>
#include <cmath>

#include "dashpot.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/registry.h"
#include "dashpot/error.h"
#include "dashpot/machine/in_plant_setup.h"

namespace dashpot::capi {
namespace {

/// Largest whole number that a double holds with all those below it.
constexpr double kLargestWhole = 9007199254740992.0;

Value parse_options(const char* text) {
  return text ? parse_json(text, "options") : Value::object();
}

std::vector<std::string> texts(ObjectReader& reader, std::string_view key) {
  std::vector<std::string> out;
  if (const Value* list = reader.optional(key))
    for (const Value& item : list->items()) out.push_back(item.as_string());
  return out;
}

/// A whole number from 0 (or `least`) on.
double whole(ObjectReader& reader, std::string_view key, double fallback, double least = 0) {
  const double value = reader.number(key, fallback);
  if (!(value >= least && value <= kLargestWhole && value == std::floor(value)))
    throw Error("options, " + std::string(key), "is " + format_number(value),
                "a whole number, " + format_number(least) + " or more");
  return value;
}

void require_at_least_0(double value, std::string_view key, const char* right) {
  if (!(value >= 0) || !std::isfinite(value))
    throw Error("options, " + std::string(key), "is " + format_number(value), right);
}

int whole_int(ObjectReader& reader, std::string_view key, int fallback, int least = 0) {
  constexpr double kMost = 1e9;
  return static_cast<int>(std::min(whole(reader, key, fallback, least), kMost));
}

}  // namespace

FitOptions read_fit_options(const char* text) {
  const Value value = parse_options(text);
  ObjectReader reader(value, "the JSON");
  FitOptions out;

  // The words are those of the command line, so that both mean the same.
  FitWords& words = out.words;
  if (reader.optional("models")) {
    words.models = texts(reader, "models");
    for (std::string& model : words.models) model = model_named(model);
  }
  words.budget = reader.number("budget", words.budget);
  words.force_offset = reader.string("force_offset", words.force_offset);
  words.forms = texts(reader, "form");
  words.fixed = texts(reader, "fix");
  words.freed = texts(reader, "free");
  words.bounds = texts(reader, "bounds");
  words.priors = texts(reader, "prior");
  words.options.allow_active = reader.boolean("allow_active", words.options.allow_active);
  words.options.asymmetric = reader.boolean("asymmetric", words.options.asymmetric);
  words.network = texts(reader, "network");
  words.from = texts(reader, "from");

  // The effort of the fits, and their random numbers.
  words.options.starts = whole_int(reader, "starts", words.options.starts, 1);
  words.options.search = whole_int(reader, "search", words.options.search);
  words.options.seed = static_cast<std::uint64_t>(whole(reader, "seed", 1));
  words.options.threads = whole_int(reader, "threads", words.options.threads);

  // A single fit leaves nothing out; its file keeps the command that made it.
  if (const Value* leave_out = reader.optional("leave_out"))
    out.leave_out = parse_leave_out(leave_out->as_string());
  out.keep_inertia = reader.boolean("keep_inertia", out.keep_inertia);
  out.command = reader.string("command", "");

  // A key that nothing has read is a mistake of the caller's.
  reader.finish();
  if (words.models.empty()) throw Error("options, models", "names no model");
  return out;
}

LoadOptions read_load_options(const char* text) {
  const Value value = parse_options(text);
  ObjectReader reader(value, "the JSON");
  LoadOptions options;
  options.dataset_file = reader.string("dataset", "");
  options.recognise = reader.boolean("recognise", options.recognise);
  options.velocity_cutoff_hz = reader.number("velocity_cutoff", 0);
  reader.finish();
  require_at_least_0(options.velocity_cutoff_hz, "velocity_cutoff",
                     "Hz, 0 (from the motion) or more");
  return options;
}

LookOptions read_look_options(const char* text) {
  const Value value = parse_options(text);
  ObjectReader reader(value, "the JSON");
  LookOptions options;
  if (const Value* speeds = reader.optional("speeds")) options.speeds = speeds->as_numbers();
  options.format = reader.string("format", options.format);
  options.command = reader.string("command", "");
  reader.finish();
  for (const double speed : options.speeds)
    if (!(speed > 0) || !std::isfinite(speed))
      throw Error("options, speeds", "holds " + format_number(speed), "m/s, above 0");
  std::ranges::sort(options.speeds);
  return options;
}

EvaluateWords read_evaluate_options(const char* text) {
  const Value value = parse_options(text);
  ObjectReader reader(value, "the JSON");
  EvaluateWords out;
  EvaluateOptions& options = out.options;
  options.offset = offset_mode(reader.string("force_offset", "record"), "options, force_offset");
  options.threads = whole_int(reader, "threads", options.threads);
  out.keep_inertia = reader.boolean("keep_inertia", out.keep_inertia);
  reader.finish();
  return out;
}

ExportWords read_export_options(const char* text) {
  const Value value = parse_options(text);
  ObjectReader reader(value, "the JSON");
  ExportWords out;
  ExportOptions& options = out.options;

  // Every key is read before any is judged, so that an unknown one is reported first.
  out.formats = texts(reader, "to");
  out.folder = reader.string("folder", out.folder);
  options.name = reader.string("name", "");
  const std::string precision = reader.string("precision", "double");
  options.sample_time = reader.number("sample_time", 0);
  options.compiler = reader.string("compiler", "");
  options.sources_only = reader.boolean("sources_only", false);
  options.command = reader.string("command", "");
  reader.finish();

  // Options without which nothing can be written, or that have few values.
  if (out.formats.empty()) throw Error("options, to", "names no format", "as [\"c\", \"fmu3\"]");
  if (out.folder.empty()) throw Error("options, folder", "is empty");
  if (precision != "double" && precision != "float")
    throw Error("options, precision", "is '" + precision + "'", "double or float");
  if (precision == "float") options.precision = CPrecision::Single;
  if (options.sample_time != 0)
    require_export_sample_time(options.sample_time, "options, sample_time");

  // Defaults that depend on the machine and on this build.
  if (options.compiler.empty()) options.compiler = usual_compiler();
  options.version = dashpot_version();
  return out;
}

DriveOptions read_drive_options(const char* text) {
  const Value value = parse_options(text);
  ObjectReader reader(value, "the JSON");
  DriveOptions out;

  // The plant and its dampers.
  VehicleWords& words = out.vehicle;
  words.where = "options";
  words.plant = reader.string("plant", words.plant);
  words.values = texts(reader, "set");
  words.dampers = texts(reader, "dampers");

  // The controller, the way from its force to a current, and the coil.
  words.controller = reader.string("controller", "");
  words.inverse = reader.string("inverse", "");
  words.current = reader.number("current", words.current);
  words.current_max = reader.number("current_max", words.current_max);
  words.lag_rate = reader.number("lag_rate", words.lag_rate);
  words.sample_time = reader.number("sample_time", words.sample_time);

  // The sensors and the road share one seed, as on the command line.
  words.sensors.in_car = reader.boolean("in_car", words.sensors.in_car);
  words.sensors.delay = reader.number("delay", words.sensors.delay);
  out.road = reader.string("road", out.road);
  out.duration = reader.number("duration", out.duration);
  out.output_step = reader.number("output_step", out.output_step);
  out.seed = words.sensors.seed = static_cast<std::uint64_t>(whole(reader, "seed", 1));

  reader.finish();

  // Times are finite and not negative, or the simulation would have no end; nor is a current.
  require_at_least_0(out.duration, "duration", "s, 0 or more");
  require_at_least_0(out.output_step, "output_step", "s, 0 or more");
  require_at_least_0(words.current, "current", "A or V, 0 or more");
  require_at_least_0(words.current_max, "current_max", "A or V, 0 (the model's) or more");
  if (const std::vector<IdleWord> idle = idle_words(words); !idle.empty())
    throw Error("options, " + idle.front().key, idle.front().why, idle.front().right);
  return out;
}

InPlantWords read_in_plant_options(const char* text) {
  const Value value = parse_options(text);
  ObjectReader reader(value, "the JSON");
  InPlantWords out;

  // One law, with the words that have a meaning inside a plant.
  FitWords& words = out.fit.words;
  words.models = texts(reader, "models");
  words.forms = texts(reader, "form");
  words.fixed = texts(reader, "fix");
  words.freed = texts(reader, "free");
  words.bounds = texts(reader, "bounds");
  words.options.starts = whole_int(reader, "starts", InPlantOptions().starts, 1);
  words.options.seed = static_cast<std::uint64_t>(whole(reader, "seed", 1));
  words.options.threads = whole_int(reader, "threads", words.options.threads);

  // What is asked of the result.
  out.grade = reader.string("grade", InPlantOptions().grade);
  out.profiles = texts(reader, "profile");
  out.fit.command = reader.string("command", "");
  reader.finish();
  if (words.models.size() != 1)
    throw Error("options, models", "are " + std::to_string(words.models.size()) + " laws", "one");
  words.models.front() = model_named(words.models.front());
  return out;
}

PlantEvaluationOptions read_plant_evaluation_options(const char* text) {
  const Value value = parse_options(text);
  ObjectReader reader(value, "the JSON");
  PlantEvaluationOptions options;
  const int steps = whole_int(reader, "steps", 0);
  if (steps < 0) throw Error("options, steps", "is " + std::to_string(steps), "0 or more");
  options.steps = static_cast<std::size_t>(steps);
  options.threads = whole_int(reader, "threads", options.threads);
  reader.finish();
  return options;
}

ObserveOptions read_observe_options(const char* text) {
  const Value value = parse_options(text);
  ObjectReader reader(value, "the JSON");
  ObserveOptions options;
  options.causal = reader.boolean("causal", options.causal);
  options.level = reader.number("level", options.level);
  options.steps = whole_int(reader, "steps", options.steps);
  options.threads = whole_int(reader, "threads", options.threads);

  // Errors of the force: how large, N, and for how long, s; without that, one that stays.
  if (const Value* errors = reader.optional("force_error"))
    for (const Value& one : errors->items()) {
      const std::vector<double> numbers = one.as_numbers();
      if (numbers.empty() || numbers.size() > 2 || !(numbers.front() > 0) || !(numbers.back() > 0))
        throw Error("options, force_error", "holds another thing than [N, s] or [N]",
                    "[[30, 0.01], [20]]");
      options.force.push_back({numbers[0], numbers.size() > 1 ? numbers[1] : kStayingError});
    }

  // The velocity by which the force goes, likewise: m/s and s.
  if (const Value* shift = reader.optional("velocity_shift")) {
    const std::vector<double> numbers = shift->as_numbers();
    if (numbers.size() != 2 || !(numbers[0] > 0) || !(numbers[1] > 0))
      throw Error("options, velocity_shift", "is another thing than [m/s, s]", "[0.004, 0.015]");
    options.shift = {numbers[0], numbers[1]};
  }
  reader.finish();
  if (!(options.level > 0 && options.level < 1))
    throw Error("options, level", "is " + format_number(options.level), "between 0 and 1");
  return options;
}

WatchWords read_watch_options(const char* text) {
  const Value value = parse_options(text);
  ObjectReader reader(value, "the JSON");
  WatchWords words;
  WatchOptions& options = words.options;
  const auto read_names = [&](const char* key, std::vector<std::string>& names) {
    const Value* given = reader.optional(key);
    if (!given) return;
    names.clear();
    for (const Value& name : given->items()) names.push_back(name.as_string());
  };
  read_names("tracked", options.wears);
  read_names("known", options.known);
  options.level = reader.string("level", "");
  options.threads = whole_int(reader, "threads", options.threads);
  options.chart.reference = static_cast<std::size_t>(
      whole(reader, "reference", static_cast<double>(options.chart.reference)));
  const double false_alarms = reader.number("false_alarms", 1 / options.chart.days);
  if (const Value* state = reader.optional("state")) words.state = *state;
  reader.finish();

  // What the charts cannot do.
  if (options.wears.empty()) throw Error("options, tracked", "names nothing", "[\"force\"]");
  for (const std::string& name : options.wears) find_wear(name, "options, tracked");
  if (!(false_alarms > 0 && false_alarms < 0.1))
    throw Error("options, false_alarms", "must lie between 0 and 0.1", "0.001 is one in 1000 days");
  options.chart.days = 1 / false_alarms;
  return words;
}

std::vector<std::pair<std::string, double>> read_conditions(const char* text) {
  std::vector<std::pair<std::string, double>> conditions;
  if (!text) return conditions;
  const Value value = parse_json(text, "conditions");
  for (const auto& [name, number] : value.members())
    conditions.emplace_back(name, number.as_number());
  return conditions;
}

}  // namespace dashpot::capi
