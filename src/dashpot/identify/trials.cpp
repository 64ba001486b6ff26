#include "dashpot/identify/trials.h"

#include <algorithm>
#include <set>

namespace dashpot {
namespace {

constexpr std::size_t kConditionTrials = 4;
constexpr double kHeldBackEnd = 0.3;

template <class Chosen>
void hold_back(std::vector<Trial>& trials, const std::vector<Record>& training, Chosen chosen) {
  Trial trial;
  for (const ScoredPart& part : all_parts(training))
    (chosen(part.record) ? trial.held_back : trial.training).push_back(part);
  if (!trial.training.empty()) trials.push_back(std::move(trial));
}

Trial cut(const std::vector<Record>& training) {
  Trial trial;
  for (const ScoredPart& part : all_parts(training)) {
    const auto held_back =
        static_cast<std::size_t>(kHeldBackEnd * static_cast<double>(part.last - part.first));
    const std::size_t at = part.last - held_back;
    trial.training.push_back({part.record, part.first, at});
    trial.held_back.push_back({part.record, std::min(at, part.last - 1), part.last});
  }
  return trial;
}

}  // namespace

ScoredParts all_parts(const std::vector<Record>& records) {
  ScoredParts parts;
  for (std::size_t r = 0; r < records.size(); ++r)
    parts.push_back({r, records[r].warm_up, records[r].size()});
  return parts;
}

std::vector<Trial> trials_of(const std::vector<Record>& training) {
  std::vector<std::string> conditions;
  std::set<double> levels;
  std::vector<std::size_t> condition_of;
  for (const Record& record : training) {
    const auto at = std::find(conditions.begin(), conditions.end(), record.condition);
    condition_of.push_back(static_cast<std::size_t>(at - conditions.begin()));
    if (at == conditions.end()) conditions.push_back(record.condition);
    if (record.drive_level) levels.insert(*record.drive_level);
  }
  std::vector<Trial> trials;
  const std::size_t hands = std::min(conditions.size(), kConditionTrials);
  for (std::size_t hand = 0; hands > 1 && hand < hands; ++hand)
    hold_back(trials, training, [&](std::size_t r) { return condition_of[r] % hands == hand; });
  for (const double level : levels)
    if (level != *levels.begin() && level != *levels.rbegin())
      hold_back(trials, training, [&](std::size_t r) { return training[r].drive_level == level; });
  if (trials.empty()) trials.push_back(cut(training));
  return trials;
}

}  // namespace dashpot
