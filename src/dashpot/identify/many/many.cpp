#include "dashpot/identify/many/many.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <optional>

#include "dashpot/base/any_number.h"
#include "dashpot/base/file.h"
#include "dashpot/base/parallel.h"
#include "dashpot/base/ranks.h"
#include "dashpot/base/task_farm.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/nets/kernel.h"
#include "dashpot/error.h"
#include "dashpot/identify/rank/fit_identity.h"
#include "dashpot/model_file.h"
#include "dashpot/record/characterise.h"

namespace dashpot {
namespace {

namespace fs = std::filesystem;

constexpr double kNone = ManyReport::kNoNumber;
/// A warm fit whose relative error is so many times the pilot's median is made from all starts too.
constexpr double kSuspicious = 1.5;
constexpr double kSameLevel = 0.02;  ///< of the largest drive: levels of two dampers are one
constexpr double kSameSpeed = 0.05;  ///< of the speed: beyond the measured ones by so much

/// What a damper says by its own: its fits, and the sheet of its recordings.
struct FittedDamper {
  std::vector<FitReport> fits;  ///< by model
  std::vector<double> errors;   ///< of each fit: its RMSE, share of the force's rms
  Characterisation sheet;
  DriveUnit drive_unit = DriveUnit::Ampere;
  Domain domain;
};

/// A level of the drive and a speed at which forces are compared.
struct ForcePoint {
  double drive = 0, speed = 0;
};

/// What the pilot settles for all: which numbers a row has, and where its fits start.
struct Plan {
  std::vector<Quantity> quantities;
  std::vector<std::vector<std::string>> parameters;  ///< by model: the names that are quantities
  std::vector<ForcePoint> points;
  std::vector<std::shared_ptr<const DamperModel>> starts;  ///< by model; null: none
  std::vector<double> usual_errors;                        ///< by model
  std::string identity;  ///< a hash of all that the rows depend on
  double seconds = 0;
  std::size_t fits = 0;
};

double rms_force(const std::vector<Record>& records) {
  double squares = 0, count = 0;
  for (const Record& record : records)
    for (const double force : record.channel("force").samples) squares += force * force, ++count;
  return count > 0 ? std::sqrt(squares / count) : 0;
}

/// Thrown where a file of a damper cannot be used, rather than its numbers.
struct Unread {
  std::string why;
};

Dataset load_damper(const DamperFolders& folders, std::size_t damper, LoadOptions options) {
  try {
    if (options.dataset_file.empty()) options.dataset_file = folders.statement_of(damper).string();
    Dataset dataset = load_dataset({folders.path_of(damper)}, options);
    // Part of the recordings would give numbers that compare with nobody's.
    if (!dataset.unread.empty()) throw Unread{dataset.unread.front().why};
    return dataset;
  } catch (const Error& error) {
    throw Unread{error.what()};
  }
}

/// One fit of each model. `starts`: as Plan has it; empty: from all starts.
FittedDamper fit_damper(const Dataset& dataset, const ManyOptions& options, const Plan* plan,
                        bool& restarted) {
  FittedDamper damper;
  damper.drive_unit = dataset.drive_unit;
  damper.domain = domain_of(dataset.records, dataset.drive_unit);
  damper.sheet = characterise(dataset, {options.speeds});
  const double size = rms_force(dataset.records);
  for (std::size_t m = 0; m < options.models.size(); ++m) {
    const std::string& model = options.models[m];
    IdentifyOptions cold = options.fit;
    cold.threads = 1;  // the cores have other dampers
    const auto made = [&](const IdentifyOptions& how) {
      return identify(model, dataset.records, dataset.drive_unit, how);
    };
    const auto usable = [](const FitReport& fit) {
      return fit.model && std::isfinite(fit.training_rmse);
    };

    // From the pilot's model, and from all starts as well where that leads to an unusual error.
    FitReport fit;
    if (plan && plan->starts[m]) {
      IdentifyOptions warm = cold;
      warm.from = {plan->starts[m]};
      warm.starts = 1;
      warm.search = 0;
      fit = made(warm);
      if (!usable(fit) || fit.training_rmse > kSuspicious * plan->usual_errors[m] * size) {
        restarted = true;
        FitReport again = made(cold);
        if (usable(again) && (!usable(fit) || again.training_rmse < fit.training_rmse))
          fit = std::move(again);
      }
    } else {
      fit = made(cold);
    }
    if (!usable(fit)) throw Error(model, fit.message.empty() ? "the fit failed" : fit.message);
    damper.errors.push_back(size > 0 ? fit.training_rmse / size : kNone);
    damper.fits.push_back(std::move(fit));
  }
  return damper;
}

/// Runs `make`, which fills members of a row, and gives the row as its text. A damper that cannot
/// serve has its reason.
template <class Make>
std::string row_text(const std::string& content, const Make& make) {
  Value row = Value::object({{"files", content}});
  const double begin = cpu_seconds();
  const auto failed = [&](const std::string& why, bool is_unread) {
    row = Value::object({{"files", content}, {"failure", why}, {"is_unread", is_unread}});
  };
  try {
    make(row);
  } catch (const Unread& unread) {
    failed(unread.why, true);
  } catch (const Error& error) {
    failed(error.what(), false);
  }
  row.add("seconds", cpu_seconds() - begin);
  return format_json(row, false);
}

/// A row that was kept. Nothing where it cannot be read or is of other files: it is made anew.
std::optional<Value> kept_row(const Store& store, const std::string& key,
                              const std::string& content) {
  const std::optional<std::string> bytes = store.load(key);
  if (!bytes) return std::nullopt;
  try {
    Value row = parse_json(*bytes, key);
    const Value* files = row.find("files");
    if (files && (content.empty() || files->as_string() == content)) return row;
  } catch (const Error&) {
    return std::nullopt;
  }
  return std::nullopt;
}

const std::string& failure_in(const Value& row) {
  static const std::string none;
  const Value* failure = row.find("failure");
  return failure ? failure->as_string() : none;
}

/// What is kept of a pilot damper: its models, parameters and errors, and its levels and speeds.
void tell_pilot(const FittedDamper& damper, Value& row) {
  // Each fit as a model file, with the parameters that were fitted.
  Value fits = Value::array(), levels = Value::array();
  for (std::size_t m = 0; m < damper.fits.size(); ++m) {
    const FitReport& fit = damper.fits[m];
    Value parameters = Value::array();
    for (const FittedParameter& p : fit.parameters)
      if (!p.fixed) parameters.push_back(Value::array({p.name, p.unit, p.meaning, p.value}));
    ModelFile file;
    file.model = fit.model->with_offset(0);
    file.drive_unit = damper.drive_unit;
    file.domain = damper.domain;
    fits.push_back(Value::object({{"model", format_model(file)},
                                  {"parameters", std::move(parameters)},
                                  {"error", any_number(damper.errors[m])}}));
  }

  // The speeds at which its forces were measured, level by level.
  for (const LevelFigures& level : damper.sheet.levels) {
    if (!level.drive) continue;
    std::vector<double> speeds;
    for (const SpeedFigures& figures : level.speeds) speeds.push_back(figures.speed);
    levels.push_back(Value::object({{"drive", *level.drive}, {"speeds", Value::array(speeds)}}));
  }

  row.add("drive_unit", to_string(damper.drive_unit));
  row.add("fits", std::move(fits));
  row.add("levels", std::move(levels));
}

double middle_of(std::vector<double> numbers) {
  std::ranges::sort(numbers);
  return numbers.empty() ? kNone : numbers[(numbers.size() - 1) / 2];
}

/// Which pilot every fit of a model starts from: the one whose parameters lie nearest to the
/// medians of all, each counted in its median distance. So it is a fit that was found, not a mean
/// of fits, and no single bad damper has a say.
std::size_t central_pilot(const std::vector<std::vector<double>>& parameters) {
  std::vector<double> far(parameters.size());
  for (std::size_t p = 0; p < parameters.front().size(); ++p) {
    std::vector<double> values, distances;
    for (const std::vector<double>& pilot : parameters) values.push_back(pilot[p]);
    const double median = middle_of(values);
    for (const double value : values) distances.push_back(std::abs(value - median));
    const double usual = middle_of(distances);
    for (std::size_t k = 0; k < far.size() && usual > 0; ++k) far[k] += distances[k] / usual;
  }
  return static_cast<std::size_t>(std::ranges::min_element(far) - far.begin());
}

std::string level_of(double drive, const std::string& unit) {
  return unit.empty() ? "" : format_number(drive, 3) + unit;
}

/// The points of force, and friction and gas force at the lowest level, as quantities.
void add_sheet_quantities(Plan& plan, const Value& pilot, const std::vector<double>& stated) {
  const std::string unit = pilot.find("drive_unit")->as_string();
  constexpr double kMillimetres = 1000;
  for (const Value& level : pilot.find("levels")->items()) {
    const double drive = level.find("drive")->as_number();
    for (const double speed : stated.empty() ? level.find("speeds")->as_numbers() : stated) {
      plan.points.push_back({drive, speed});
      const std::string where = format_number(kMillimetres * speed, 4) + "mm/s" +
                                (unit.empty() ? "" : "_" + level_of(drive, unit));
      plan.quantities.push_back({"rebound_" + where, "N", "force at mid stroke, rebound"});
      plan.quantities.push_back({"compression_" + where, "N", "force at mid stroke, compression"});
    }
  }
  plan.quantities.push_back({"friction", "N", "at the lowest level of the drive"});
  plan.quantities.push_back({"gas_force", "N", "and zero of the load cell, lowest level"});
}

/// The parameters and the error of a model as quantities, and the fit to start from.
void add_model(Plan& plan, const std::string& model, std::size_t m, bool is_alone,
               const std::vector<Value>& pilots, bool is_warm) {
  const std::string prefix = is_alone ? "" : model + '.';
  std::vector<const Value*> fits;
  for (const Value& pilot : pilots) fits.push_back(&pilot.find("fits")->items()[m]);

  // The names of the first pilot's parameters; another pilot may lack one.
  std::vector<std::string> names;
  for (const Value& parameter : fits.front()->find("parameters")->items()) {
    const std::vector<Value>& p = parameter.items();
    names.push_back(p[0].as_string());
    plan.quantities.push_back({prefix + names.back(), p[1].as_string(), p[2].as_string()});
  }
  plan.quantities.push_back({prefix + "rmse", "N", "error of the fit"});

  // The errors that are usual, and the pilot in the middle.
  std::vector<double> errors;
  std::vector<std::vector<double>> parameters;
  for (const Value* fit : fits) {
    errors.push_back(read_any_number(*fit->find("error")));
    std::vector<double>& values = parameters.emplace_back(names.size(), 0);
    for (const Value& parameter : fit->find("parameters")->items())
      for (std::size_t p = 0; p < names.size(); ++p)
        if (parameter.items()[0].as_string() == names[p])
          values[p] = parameter.items()[3].as_number();
  }
  plan.usual_errors.push_back(middle_of(errors));
  const Value* start = fits[names.empty() ? 0 : central_pilot(parameters)]->find("model");
  plan.starts.push_back(is_warm
                            ? std::shared_ptr<const DamperModel>(
                                  parse_model(start->as_string(), model + " of the pilot").model)
                            : nullptr);
  plan.parameters.push_back(std::move(names));
}

/// The numbers of a damper, in the order of the plan's quantities.
std::vector<double> values_of(const FittedDamper& damper, const Plan& plan) {
  std::vector<double> values;
  const std::vector<LevelFigures>& levels = damper.sheet.levels;
  double largest = 0;
  for (const LevelFigures& level : levels)
    largest = std::max(largest, std::abs(level.drive.value_or(0)));

  // Forces, between the speeds that were measured or next to them.
  const auto figures_at = [&](const ForcePoint& point) -> std::optional<SpeedFigures> {
    for (const LevelFigures& level : levels) {
      if (!level.drive || level.speeds.empty() ||
          std::abs(*level.drive - point.drive) > kSameLevel * largest)
        continue;
      if (const auto found = at_speed(level, point.speed)) return found;
      for (const SpeedFigures* end : {&level.speeds.front(), &level.speeds.back()})
        if (std::abs(end->speed - point.speed) <= kSameSpeed * point.speed) return *end;
    }
    return std::nullopt;
  };
  for (const ForcePoint& point : plan.points) {
    const std::optional<SpeedFigures> figures = figures_at(point);
    values.push_back(figures ? figures->rebound.mid_force : kNone);
    values.push_back(figures ? figures->compression.mid_force : kNone);
  }
  values.push_back(levels.empty() ? kNone : levels.front().friction.value);
  values.push_back(levels.empty() ? kNone : levels.front().static_force.value);

  // Parameters, and the error of each model.
  for (std::size_t m = 0; m < damper.fits.size(); ++m) {
    for (const std::string& name : plan.parameters[m]) {
      const auto& fitted = damper.fits[m].parameters;
      const auto found = std::ranges::find(fitted, name, &FittedParameter::name);
      values.push_back(found == fitted.end() ? kNone : found->value);
    }
    values.push_back(damper.fits[m].training_rmse);
  }
  return values;
}

DamperRow read_row(const Value& value, std::size_t quantities) {
  DamperRow row;
  row.failure = failure_in(value);
  row.seconds = value.find("seconds")->as_number();
  if (!row.failure.empty()) {
    row.is_unread = value.find("is_unread")->as_bool();
    return row;
  }
  row.restarted = value.find("restarted")->as_bool();
  row.values.reserve(quantities);
  for (const Value& number : value.find("values")->items())
    row.values.push_back(read_any_number(number));
  if (row.values.size() != quantities) throw Error(value.where(), "has other numbers");
  return row;
}

/// The dampers of one command.
class ManyRun {
 public:
  ManyRun(const DamperFolders& folders, const ManyOptions& options, Store& store)
      : folders_(folders),
        options_(options),
        store_(store),
        names_(sha256(join(folders.names, "\n"))) {}

  /// The numbers of the dampers of a part are kept when this returns.
  PartReport make(const Part& part) {
    plan_ = make_plan();
    std::vector<std::size_t> dampers;
    for (std::size_t k = 0; k < folders_.names.size(); ++k)
      if (part.has(k)) dampers.push_back(k);
    std::atomic<std::size_t> done = 0;
    const FarmReport farm = farm_out(
        dampers, options_.fit.threads, store_, names_ + plan_.identity, [&](std::size_t damper) {
          options_.fit.monitor.check();
          make_row(damper);
          options_.fit.monitor.report(
              std::to_string(++done) + " of " + std::to_string(dampers.size()) + " dampers",
              static_cast<double>(done) / static_cast<double>(dampers.size()));
        });
    if (!ranks().is_alone()) kept_ = farm.found;
    return {.tasks = dampers.size(),
            .all = folders_.names.size(),
            .kept = kept_,
            .wall_seconds = farm.wall_seconds};
  }

  /// All rows as they were kept.
  ManyReport judged() {
    ManyReport report{.options = options_, .folders = folders_, .quantities = plan_.quantities};
    std::vector<std::vector<double>> columns(plan_.quantities.size());
    for (std::size_t k = 0; k < folders_.names.size(); ++k) {
      const std::optional<Value> kept = kept_row(store_, row_key(k), "");
      if (!kept) throw Error(folders_.names[k], "its row is missing from the store");
      DamperRow row = read_row(*kept, plan_.quantities.size());
      row.name = folders_.names[k];
      row.serial = folders_.serials[k];
      report.rows.push_back(std::move(row));
      for (std::size_t q = 0; q < columns.size(); ++q) columns[q].push_back(report.values_of(k, q));
    }
    report.population = judge_population(columns, folders_.serials, options_.false_alarms);
    report.kept = kept_;
    report.pilot_seconds = plan_.seconds;
    report.pilot_fits = plan_.fits;
    return report;
  }

 private:
  std::string pilot_key(std::size_t damper) const { return "pilot\n" + folders_.names[damper]; }
  std::string row_key(std::size_t damper) const {
    return "damper\n" + folders_.names[damper] + '\n' + plan_.identity;
  }

  /// The dampers of the pilot: the first ones, more of them until one gives a model.
  std::vector<Value> pilots() {
    const std::size_t wanted = std::max<std::size_t>(options_.pilot, 1);
    std::vector<Value> found;
    std::string first_failure;
    for (std::size_t first = 0; first < folders_.names.size() && found.empty(); first += wanted) {
      std::vector<std::size_t> dampers;
      for (std::size_t k = first; k < std::min(first + wanted, folders_.names.size()); ++k)
        dampers.push_back(k);

      // The next so many dampers, in this process or in others.
      farm_out(dampers, options_.fit.threads, store_, names_, [&](std::size_t damper) {
        options_.fit.monitor.report("pilot: " + folders_.names[damper], 0);
        make_pilot(damper);
      });

      // What came of them, in their order, whoever made it.
      for (const std::size_t damper : dampers) {
        std::optional<Value> row = kept_row(store_, pilot_key(damper), "");
        if (!row) throw Error(folders_.names[damper], "its pilot row is missing from the store");
        if (failure_in(*row).empty())
          found.push_back(std::move(*row));
        else if (first_failure.empty())
          first_failure = folders_.names[damper] + ": " + failure_in(*row);
      }
    }
    if (found.empty())
      throw Error(folders_.folder.string(), "no damper gives a model", first_failure);
    return found;
  }

  void make_pilot(std::size_t damper) {
    const std::string content = content_of(damper);
    if (!content.empty() && kept_row(store_, pilot_key(damper), content)) return;
    store_.save(pilot_key(damper), row_text(content, [&](Value& row) {
                  const Dataset dataset = load_damper(folders_, damper, options_.load);
                  bool restarted = false;
                  tell_pilot(fit_damper(dataset, options_, nullptr, restarted), row);
                }));
  }

  Plan make_plan() {
    const std::vector<Value> pilots = this->pilots();
    Plan plan;
    plan.fits = pilots.size();
    for (const Value& pilot : pilots) plan.seconds += pilot.find("seconds")->as_number();
    add_sheet_quantities(plan, pilots.front(), options_.speeds);
    for (std::size_t m = 0; m < options_.models.size(); ++m)
      add_model(plan, options_.models[m], m, options_.models.size() == 1, pilots,
                options_.pilot > 0);

    // All of the pilot but its times.
    std::string text;
    for (const Quantity& quantity : plan.quantities) text += quantity.name + '\n';
    for (const auto& start : plan.starts)
      text += start ? format_json(start->to_json(), false) + '\n' : "cold\n";
    for (const double error : plan.usual_errors) text += format_exact(error) + '\n';
    for (const ForcePoint& point : plan.points)
      text += format_exact(point.drive) + ' ' + format_exact(point.speed) + '\n';
    constexpr std::size_t kHexDigits = 16;
    plan.identity = sha256(text).substr(0, kHexDigits);
    return plan;
  }

  /// Empty where a file cannot be read: the row says so, and is made anew each time.
  std::string content_of(std::size_t damper) const {
    try {
      return folders_.content_of(damper);
    } catch (const std::exception&) {
      return {};
    }
  }

  void make_row(std::size_t damper) {
    const std::string content = content_of(damper);
    if (!content.empty() && kept_row(store_, row_key(damper), content)) {
      ++kept_;
      return;
    }
    store_.save(row_key(damper), row_text(content, [&](Value& row) {
                  const Dataset dataset = load_damper(folders_, damper, options_.load);
                  bool restarted = false;
                  const FittedDamper fitted = fit_damper(dataset, options_, &plan_, restarted);
                  Value values = Value::array();
                  for (const double value : values_of(fitted, plan_))
                    values.push_back(any_number(value));
                  row.add("restarted", restarted);
                  row.add("values", std::move(values));
                }));
  }

  const DamperFolders& folders_;
  const ManyOptions& options_;
  Store& store_;
  const std::string names_;  ///< a hash: every process has to see the same dampers
  Plan plan_;
  std::atomic<std::size_t> kept_ = 0;
};

}  // namespace

std::size_t ManyReport::fitted() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(rows, [](const DamperRow& row) { return row.failure.empty(); }));
}

NamedTexts describe_many(const ManyOptions& options, const std::string& program) {
  std::vector<std::string> speeds;
  for (const double speed : options.speeds) speeds.push_back(format_exact(speed));
  NamedTexts texts{
      {"models", join(options.models, ",")},
      {"speeds", join(speeds, ",")},
      {"pilot", std::to_string(options.pilot)},
      {"velocity cutoff", format_exact(options.load.velocity_cutoff_hz)},
      {"known recordings", options.load.recognise ? "looked for" : "not looked for"},
      {"dataset file",
       options.load.dataset_file.empty() ? "" : sha256_of_file(options.load.dataset_file)}};
  for (auto& [name, value] : describe_options(options.fit)) texts.emplace_back(name, value);
  texts.emplace_back("processor", "SIMD level " + std::string(name_of(simd_levels().back())));
  texts.emplace_back("program", program);
  return texts;
}

ManyReport identify_many(const DamperFolders& folders, const ManyOptions& options, Store& store) {
  const auto begin = std::chrono::steady_clock::now();
  ManyRun run(folders, options, store);
  run.make(Part());
  ManyReport report = run.judged();
  report.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return report;
}

PartReport identify_many_part(const DamperFolders& folders, const ManyOptions& options,
                              Store& store, const Part& part) {
  return ManyRun(folders, options, store).make(part);
}

}  // namespace dashpot
