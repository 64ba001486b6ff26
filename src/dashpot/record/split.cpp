#include "dashpot/split.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/record/trial_parts.h"

namespace dashpot {
namespace {

template <class T>
void add_new(std::vector<T>& values, const T& value) {
  if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
}

std::vector<std::string> conditions(const Dataset& dataset) {
  std::vector<std::string> all;
  for (const Record& record : dataset.records) add_new(all, record.condition);
  return all;
}

/// The constant drive levels of the records, ascending, each once.
std::vector<double> levels(const Dataset& dataset) {
  std::vector<double> all;
  for (const Record& record : dataset.records)
    if (record.drive_level) add_new(all, *record.drive_level);
  std::sort(all.begin(), all.end());
  return all;
}

bool has_role(const Dataset& dataset, Role role) {
  return std::any_of(dataset.records.begin(), dataset.records.end(),
                     [&](const Record& r) { return r.role == role; });
}

bool has_roles(const Dataset& dataset) {
  return has_role(dataset, Role::Training) && has_role(dataset, Role::LeftOut);
}

std::string ways_that_work(const Dataset& dataset) {
  std::vector<std::string> ways;
  if (conditions(dataset).size() > 1) ways.emplace_back("'condition'");
  if (levels(dataset).size() > 2) ways.emplace_back("'current'");
  if (dataset.records.size() > 1) ways.emplace_back("'record'");
  ways.emplace_back("'fraction=0.3'");
  if (has_roles(dataset)) ways.emplace_back("'roles'");
  return "leave out by " + join(ways, ", ");
}

[[noreturn]] void impossible(const Dataset& dataset, const std::string& what) {
  throw Error(dataset.name, "cannot be divided so: " + what, ways_that_work(dataset));
}

/// One fold that leaves out the records for which `left_out` is true. The words behind the first of
/// its name are what the message names when there is no such record.
template <class Chosen>
Fold fold_by(const Dataset& dataset, const std::string& name, const Chosen& left_out) {
  Fold fold;
  fold.name = name;
  for (const Record& record : dataset.records)
    (left_out(record) ? fold.left_out : fold.training).push_back(record);
  if (fold.left_out.empty())
    impossible(dataset, "no record is '" + name.substr(name.find(' ') + 1) + "'");
  if (fold.training.empty()) impossible(dataset, "nothing is left to train on " + name);
  return fold;
}

std::vector<Fold> by_condition(const Dataset& dataset, const LeaveOut& how) {
  const std::vector<std::string> all = conditions(dataset);
  if (all.size() < 2)
    impossible(dataset, "all records have one condition, '" + (all.empty() ? "" : all[0]) + "'");
  std::vector<Fold> folds;
  for (const std::string& condition : how.values.empty() ? all : how.values)
    folds.push_back(fold_by(dataset, "without " + condition,
                            [&](const Record& r) { return r.condition == condition; }));
  return folds;
}

/// The levels to leave out one after the other: those asked for, else all but the lowest and
/// highest.
std::vector<double> chosen_levels(const Dataset& dataset, const LeaveOut& how) {
  if (how.values.empty()) {
    const std::vector<double> all = levels(dataset);
    if (all.size() < 3)
      impossible(dataset, std::to_string(all.size()) +
                              " constant drive level(s): no inner one to leave out");
    return {all.begin() + 1, all.end() - 1};
  }

  std::vector<double> out;
  for (const std::string& text : how.values) {
    const auto value = parse_number(text);
    if (!value) impossible(dataset, "'" + text + "' is not a drive level");
    out.push_back(*value);
  }
  return out;
}

/// Two levels are the same within their printed digits: 0.87 means 0.8712.
bool same_level(double level, double asked) {
  return std::abs(level - asked) <= 0.005 * std::max(1.0, std::abs(asked));
}

std::vector<Fold> by_current(const Dataset& dataset, const LeaveOut& how) {
  std::vector<Fold> folds;
  for (const double level : chosen_levels(dataset, how))
    folds.push_back(fold_by(
        dataset, "without " + format_number(level) + " " + to_string(dataset.drive_unit),
        [&](const Record& r) { return r.drive_level && same_level(*r.drive_level, level); }));
  return folds;
}

std::vector<Fold> by_record(const Dataset& dataset, const LeaveOut& how) {
  if (dataset.records.size() < 2) impossible(dataset, "it has one record");
  std::vector<std::string> names = how.values;
  if (names.empty())
    for (const Record& record : dataset.records) names.push_back(record.name);
  std::vector<Fold> folds;
  for (const std::string& name : names)
    folds.push_back(
        fold_by(dataset, "without " + name, [&](const Record& r) { return r.name == name; }));
  return folds;
}

/// "gap 0.001, pole_length 0.006": the values of these conditions of a record. Throws Error when it
/// lacks one.
std::string values_of(const Record& record, const std::vector<std::string>& names) {
  std::vector<std::string> parts;
  for (const std::string& name : names) {
    const auto found =
        std::ranges::find(record.conditions, name, &std::pair<std::string, double>::first);
    if (found == record.conditions.end()) {
      std::vector<std::string> known;
      for (const auto& condition : record.conditions) known.push_back(condition.first);
      throw Error(record.name, "has no condition '" + name + "'",
                  known.empty() ? "its dataset file states none" : suggest(name, known));
    }
    parts.push_back(name + " " + format_number(found->second));
  }
  return join(parts, ", ");
}

std::vector<Fold> by_each(const Dataset& dataset, const LeaveOut& how) {
  std::vector<std::string> all;
  for (const Record& record : dataset.records) add_new(all, values_of(record, how.values));
  if (all.size() < 2) impossible(dataset, "all records have " + all.front());
  std::vector<Fold> folds;
  for (const std::string& values : all)
    folds.push_back(fold_by(dataset, "without " + values,
                            [&](const Record& r) { return values_of(r, how.values) == values; }));
  return folds;
}

/// Leaves out the end of every record. The left-out record runs from its start, so that the model
/// reaches its state, and is scored at its end.
std::vector<Fold> by_fraction(const Dataset& dataset, const LeaveOut& how) {
  Fold fold;
  fold.name = "without the last " + format_number(100 * how.fraction, 3) + " % of each record";
  for (const Record& record : dataset.records) {
    const auto at = static_cast<std::size_t>(
        std::lround((1 - how.fraction) * static_cast<double>(record.size())));
    if (at < record.warm_up + 2 || at + 2 > record.size())
      impossible(dataset,
                 record.name + " is too short for a fraction of " + format_number(how.fraction));
    fold.training.push_back(record.slice(0, at));
    fold.left_out.push_back(record);
    fold.left_out.back().warm_up = at;
  }
  return {fold};
}

std::vector<Fold> by_roles(const Dataset& dataset) {
  if (!has_roles(dataset)) impossible(dataset, "its dataset file gives no roles");
  Fold fold;
  fold.name = "as the dataset file states";
  for (const Record& record : dataset.records) {
    if (record.role == Role::Training) fold.training.push_back(record);
    if (record.role == Role::LeftOut) fold.left_out.push_back(record);
  }
  return {fold};
}

/// Divides the scored samples of a record into equal stretches and leaves one out: it is run from
/// the record's start and scored on that stretch. What lies before and after it serves the fit, as
/// two records.
void hold_back_part(const Record& record, std::size_t part, std::size_t parts, Fold& fold) {
  const std::size_t scored = record.size() - std::min(record.warm_up, record.size());
  const std::size_t from = record.warm_up + scored * part / parts;
  const std::size_t to = record.warm_up + scored * (part + 1) / parts;
  constexpr std::size_t kLeast = 10;  // samples of a stretch
  if (to < from + kLeast) return;
  fold.left_out.push_back(record.slice(0, to));
  fold.left_out.back().warm_up = from;

  if (part > 0) fold.training.push_back(record.slice(0, from));
  if (part + 1 == parts) return;
  Record after = record.slice(to, record.size());
  after.warm_up = std::min(record.warm_up, after.size() / 4);
  fold.training.push_back(std::move(after));
}

/// Holds back the end of each part. The model still runs from the start of the record.
TrialParts without_ends(const ScoredParts& parts, double share) {
  TrialParts trial;
  for (const ScoredPart& part : parts) {
    const auto held_back =
        static_cast<std::size_t>(share * static_cast<double>(part.last - part.first));
    const std::size_t at = part.last - held_back;
    trial.training.push_back({part.record, part.first, at});
    trial.held_back.push_back({part.record, std::min(at, part.last - 1), part.last});
  }
  return trial;
}

}  // namespace

LeaveOut default_leave_out(const Dataset& dataset) {
  if (dataset.leave_out) return *dataset.leave_out;
  LeaveOut out;
  if (conditions(dataset).size() > 1) {
    out.by = LeaveOut::By::Condition;
  } else if (levels(dataset).size() > 2) {
    out.by = LeaveOut::By::Current;
  } else {
    out.by = dataset.records.size() > 1 ? LeaveOut::By::Record : LeaveOut::By::Fraction;
  }
  return out;
}

std::vector<Fold> split(const Dataset& dataset, const LeaveOut& leave_out) {
  if (dataset.records.empty()) throw Error(dataset.name, "has no records to divide");
  switch (leave_out.by) {
    case LeaveOut::By::Current:
      return by_current(dataset, leave_out);
    case LeaveOut::By::Record:
      return by_record(dataset, leave_out);
    case LeaveOut::By::Fraction:
      return by_fraction(dataset, leave_out);
    case LeaveOut::By::Roles:
      return by_roles(dataset);
    case LeaveOut::By::Each:
      return by_each(dataset, leave_out);
    case LeaveOut::By::Condition:
      break;
  }
  return by_condition(dataset, leave_out);
}

std::vector<Fold> hold_back(const std::vector<Record>& training, const LeaveOut& judged) {
  Dataset dataset;
  dataset.records = training;
  if (judged.by == LeaveOut::By::Condition && conditions(dataset).size() > 1)
    return by_condition(dataset, {});
  if (judged.by == LeaveOut::By::Current && levels(dataset).size() > 2)
    return by_current(dataset, {});

  // With few parts, fits on what is left know much less than the one that they stand for.
  constexpr std::size_t kParts = 6, kLeastRecords = 3;
  const bool whole = judged.by != LeaveOut::By::Fraction && training.size() >= kLeastRecords;
  const std::size_t parts = whole ? std::min(kParts, training.size()) : kParts;

  std::vector<Fold> folds;
  for (std::size_t part = 0; part < parts; ++part) {
    Fold fold;
    fold.name = "without part " + std::to_string(part + 1) + " of " + std::to_string(parts);
    for (std::size_t r = 0; r < training.size(); ++r) {
      if (whole)
        (r % parts == part ? fold.left_out : fold.training).push_back(training[r]);
      else
        hold_back_part(training[r], part, parts, fold);
    }
    if (!fold.training.empty() && !fold.left_out.empty()) folds.push_back(std::move(fold));
  }
  return folds;
}

ScoredParts all_parts(const std::vector<Record>& records) {
  ScoredParts parts;
  for (std::size_t r = 0; r < records.size(); ++r)
    parts.push_back({r, records[r].warm_up, records[r].size()});
  return parts;
}

std::vector<TrialParts> trial_parts(const std::vector<Record>& training) {
  constexpr std::size_t kMostGroups = 4;
  constexpr double kEnd = 0.3;
  Dataset dataset;
  dataset.records = training;
  const ScoredParts parts = all_parts(training);
  std::vector<TrialParts> trials;

  const auto hold_back = [&](const auto& chosen) {
    TrialParts trial;
    for (const ScoredPart& part : parts)
      (chosen(training[part.record]) ? trial.held_back : trial.training).push_back(part);
    if (!trial.training.empty()) trials.push_back(std::move(trial));
  };

  // Conditions, dealt in turn to a few groups of which each is held back once.
  const std::vector<std::string> all = conditions(dataset);
  const std::size_t groups = std::min(all.size(), kMostGroups);
  for (std::size_t group = 0; groups > 1 && group < groups; ++group)
    hold_back([&](const Record& record) {
      const auto condition = std::find(all.begin(), all.end(), record.condition) - all.begin();
      return static_cast<std::size_t>(condition) % groups == group;
    });

  // Each inner level of the drive.
  const std::vector<double> steps = levels(dataset);
  for (std::size_t k = 1; k + 1 < steps.size(); ++k)
    hold_back([&](const Record& record) { return record.drive_level == steps[k]; });

  if (trials.empty()) trials.push_back(without_ends(parts, kEnd));
  return trials;
}

std::vector<Fold> trial_folds(const std::vector<Record>& training) {
  const auto records_of = [&](const ScoredParts& parts) {
    std::vector<Record> records;
    for (const ScoredPart& part : parts) {
      records.push_back(training[part.record].slice(0, part.last));
      records.back().warm_up = part.first;
    }
    return records;
  };
  std::vector<Fold> folds;
  for (const TrialParts& trial : trial_parts(training))
    folds.push_back({"a trial", records_of(trial.training), records_of(trial.held_back)});
  return folds;
}

}  // namespace dashpot
