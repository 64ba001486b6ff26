#include "dashpot/split.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/record/blocks.h"
#include "dashpot/record/what_varies.h"

namespace dashpot {
namespace {

bool has_role(const Dataset& dataset, Role role) {
  return std::any_of(dataset.records.begin(), dataset.records.end(),
                     [&](const Record& r) { return r.role == role; });
}

bool has_roles(const Dataset& dataset) {
  return has_role(dataset, Role::Training) && has_role(dataset, Role::LeftOut);
}

constexpr std::size_t kLeastOfBlock = 20;  ///< samples that a block is scored on

/// How many blocks of time each record can be divided into, up to those that are usual.
std::size_t most_blocks(const Dataset& dataset) {
  std::size_t most = LeaveOut().blocks;
  for (const Record& record : dataset.records)
    most = std::min(most, samples_per_block(record, 1) / kLeastOfBlock);
  return most;
}

bool varies_in_some(const Dataset& dataset) {
  const auto varying =
      std::ranges::count_if(dataset.records, [](const Record& r) { return !r.drive_level; });
  return varying > 0 && static_cast<std::size_t>(varying) < dataset.records.size();
}

/// What is dealt to groups: the conditions, or, where all records have one, the records.
std::size_t count_to_deal(const Dataset& dataset) {
  const std::size_t motions = conditions(dataset).size();
  return motions > 1 ? motions : dataset.records.size();
}

std::string ways_that_work(const Dataset& dataset) {
  std::vector<std::string> ways;
  if (conditions(dataset).size() > 1) ways.emplace_back("'condition'");
  if (levels(dataset).size() > 2 || varies_in_some(dataset)) ways.emplace_back("'current'");
  if (dataset.records.size() > 1) ways.emplace_back("'record'");
  if (count_to_deal(dataset) > LeaveOut().groups)
    ways.push_back("'" + format_leave_out({.by = LeaveOut::By::Groups}) + "'");
  if (const std::size_t blocks = most_blocks(dataset); blocks > 1)
    ways.push_back("'blocks=" + std::to_string(blocks) + "'");
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

constexpr std::string_view kVaries = "varies";  // among levels: records whose drive is none

/// The drives to leave out one after the other, as they are written: those asked for, else all
/// levels but the lowest and highest, and then the records whose drive varies, all at once.
std::vector<std::string> chosen_drives(const Dataset& dataset, const LeaveOut& how) {
  if (!how.values.empty()) return how.values;
  const std::vector<double> all = levels(dataset);
  std::vector<std::string> out;
  for (std::size_t k = 1; k + 1 < all.size(); ++k) out.push_back(format_exact(all[k]));
  if (varies_in_some(dataset)) out.emplace_back(kVaries);
  if (!out.empty()) return out;

  // Neither kind of division is possible.
  if (dataset.drive_unit == DriveUnit::None)
    impossible(dataset, "its one drive is constant and unknown");
  impossible(dataset, all.empty()
                          ? "the drive varies within all of its records, which have no level"
                          : std::to_string(all.size()) +
                                " constant drive level(s): no inner one to leave out");
}

/// How far a level that is asked for may lie from that of a record, A or V: 0.87 means 0.8712.
/// Where all levels are below 1, of the largest.
double printed_digits(const Dataset& dataset, double asked) {
  constexpr double kShare = 0.005;
  double largest = 0;
  for (const double level : levels(dataset)) largest = std::max(largest, std::abs(level));
  return kShare * std::max(std::min(1.0, largest), std::abs(asked));
}

std::vector<Fold> by_current(const Dataset& dataset, const LeaveOut& how) {
  std::vector<Fold> folds;
  for (const std::string& text : chosen_drives(dataset, how)) {
    if (text == kVaries) {
      folds.push_back(fold_by(dataset, std::string(kWithoutVaryingDrive),
                              [](const Record& r) { return !r.drive_level; }));
      continue;
    }
    const auto level = parse_number(text);
    if (!level) impossible(dataset, "'" + text + "' is not a drive level");
    const double within = printed_digits(dataset, *level);
    folds.push_back(
        fold_by(dataset, "without " + format_number(*level) + " " + to_string(dataset.drive_unit),
                [&](const Record& r) {
                  return r.drive_level && std::abs(*r.drive_level - *level) <= within;
                }));
  }
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

/// Leaves out one block of time of every record after the other.
std::vector<Fold> by_blocks(const Dataset& dataset, const LeaveOut& how) {
  for (const Record& record : dataset.records)
    if (samples_per_block(record, how.blocks) < kLeastOfBlock)
      impossible(dataset, record.name + " has " + std::to_string(samples_per_block(record, 1)) +
                              " samples to score, and " + std::to_string(how.blocks) +
                              " blocks need " + std::to_string(how.blocks * kLeastOfBlock));

  std::vector<Fold> folds(how.blocks);
  for (std::size_t block = 0; block < how.blocks; ++block) {
    folds[block].name =
        "without block " + std::to_string(block + 1) + " of " + std::to_string(how.blocks);
    for (const Record& record : dataset.records) {
      BlockLeftOut divided = leave_out_block(record, block, how.blocks);
      folds[block].left_out.push_back(std::move(divided.left_out));
      std::ranges::move(divided.training, std::back_inserter(folds[block].training));
    }
  }
  return folds;
}

/// Deals conditions or records in turn, so that neighbours, which are alike, are not left out at
/// once.
std::vector<Fold> by_groups(const Dataset& dataset, const LeaveOut& how) {
  const std::vector<std::string> motions = conditions(dataset);
  const std::size_t count = count_to_deal(dataset);
  if (count < how.groups)
    impossible(dataset, "it has " + std::to_string(count) +
                            (motions.size() > 1 ? " conditions" : " record(s)") + ", fewer than " +
                            std::to_string(how.groups) + " groups");

  std::vector<Fold> folds(how.groups);
  for (std::size_t group = 0; group < how.groups; ++group)
    folds[group].name =
        "without group " + std::to_string(group + 1) + " of " + std::to_string(how.groups);
  for (std::size_t r = 0; r < dataset.records.size(); ++r) {
    const Record& record = dataset.records[r];
    const std::size_t place =
        motions.size() > 1 ? static_cast<std::size_t>(std::ranges::find(motions, record.condition) -
                                                      motions.begin())
                           : r;
    for (std::size_t group = 0; group < how.groups; ++group)
      (place % how.groups == group ? folds[group].left_out : folds[group].training)
          .push_back(record);
  }
  return folds;
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

}  // namespace

LeaveOut default_leave_out(const Dataset& dataset) {
  if (dataset.leave_out) return *dataset.leave_out;
  LeaveOut out;
  if (conditions(dataset).size() > 1) {
    out.by = LeaveOut::By::Condition;
  } else if (levels(dataset).size() > 2) {
    out.by = LeaveOut::By::Current;
  } else {
    out.by = dataset.records.size() > 1 ? LeaveOut::By::Record : LeaveOut::By::Blocks;
  }
  // A fit for each of many tells hardly more of a model than a few fits, and takes the time in
  // which better models could be tried.
  if ((out.by == LeaveOut::By::Condition || out.by == LeaveOut::By::Record) &&
      count_to_deal(dataset) > out.groups)
    out.by = LeaveOut::By::Groups;
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
    case LeaveOut::By::Blocks:
      return by_blocks(dataset, leave_out);
    case LeaveOut::By::Groups:
      return by_groups(dataset, leave_out);
    case LeaveOut::By::Roles:
      return by_roles(dataset);
    case LeaveOut::By::Each:
      return by_each(dataset, leave_out);
    case LeaveOut::By::Condition:
      break;
  }
  return by_condition(dataset, leave_out);
}

}  // namespace dashpot
