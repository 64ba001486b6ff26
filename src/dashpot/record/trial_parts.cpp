#include "dashpot/record/trial_parts.h"

#include <algorithm>
#include <iterator>

#include "dashpot/record/blocks.h"
#include "dashpot/record/what_varies.h"

namespace dashpot {
namespace {

/// Holds back one block of a record, unless it would be too short.
void hold_back_block(const Record& record, std::size_t block, std::size_t blocks, Fold& fold) {
  constexpr std::size_t kLeast = 10;  // samples of a block
  if (samples_per_block(record, blocks) < kLeast) return;
  BlockLeftOut divided = leave_out_block(record, block, blocks);
  fold.left_out.push_back(std::move(divided.left_out));
  std::ranges::move(divided.training, std::back_inserter(fold.training));
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

std::vector<Fold> hold_back(const std::vector<Record>& training, const LeaveOut& judged) {
  Dataset dataset;
  dataset.records = training;
  if (judged.by == LeaveOut::By::Condition && conditions(dataset).size() > 1)
    return split(dataset, {.by = LeaveOut::By::Condition});
  if (judged.by == LeaveOut::By::Current && levels(dataset).size() > 2)
    return split(dataset, {.by = LeaveOut::By::Current});

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
        hold_back_block(training[r], part, parts, fold);
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
