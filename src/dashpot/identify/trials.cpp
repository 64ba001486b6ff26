#include "dashpot/identify/trials.h"

#include <algorithm>
#include <set>
#include <string>

#include "dashpot/base/parallel.h"

namespace dashpot {
namespace {

constexpr std::size_t kConditionTrials = 4;  // conditions are dealt to so many trials
constexpr double kHeldBackEnd = 0.3;         // of records that have neither conditions nor levels

}  // namespace

Trials::Trials(const std::vector<Record>& training, const std::vector<BankRecord>& records) {
  std::vector<std::string> conditions;
  std::set<double> levels;
  std::vector<std::size_t> condition_of;
  for (const Record& record : training) {
    const auto at = std::find(conditions.begin(), conditions.end(), record.condition);
    condition_of.push_back(static_cast<std::size_t>(at - conditions.begin()));
    if (at == conditions.end()) conditions.push_back(record.condition);
    if (record.drive_level) levels.insert(*record.drive_level);
  }
  const std::size_t hands = std::min(conditions.size(), kConditionTrials);
  for (std::size_t hand = 0; hands > 1 && hand < hands; ++hand)
    hold_back(records, [&](std::size_t r) { return condition_of[r] % hands == hand; });
  for (const double level : levels)
    if (level != *levels.begin() && level != *levels.rbegin())
      hold_back(records, [&](std::size_t r) { return training[r].drive_level == level; });
  if (trials_.empty()) cut(records);
}

double Trials::best_price(std::span<const double> prices, int threads,
                          const std::function<double(const Trial&, double)>& squares_left) const {
  std::vector<double> squares(prices.size() * trials_.size());
  parallel_for(squares.size(), threads, [&](std::size_t k) {
    squares[k] = squares_left(trials_[k / prices.size()], prices[k % prices.size()]);
  });
  std::vector<double> sums(prices.size());
  for (std::size_t k = 0; k < squares.size(); ++k) sums[k % prices.size()] += squares[k];
  return prices[static_cast<std::size_t>(std::min_element(sums.begin(), sums.end()) - sums.begin())];
}

void Trials::hold_back(const std::vector<BankRecord>& records,
                       const std::function<bool(std::size_t)>& chosen) {
  Trial trial;
  for (std::size_t r = 0; r < records.size(); ++r)
    (chosen(r) ? trial.held_back : trial.training).push_back(&records[r]);
  if (!trial.training.empty()) trials_.push_back(std::move(trial));
}

void Trials::cut(const std::vector<BankRecord>& records) {
  cuts_.reserve(2 * records.size());
  trials_.emplace_back();
  for (const BankRecord& record : records) {
    const auto scored = static_cast<double>(record.inputs.size() - record.first);
    const std::size_t at = record.inputs.size() - static_cast<std::size_t>(kHeldBackEnd * scored);
    BankRecord& early = cuts_.emplace_back(record);
    early.inputs.resize(at);
    early.time.resize(at);
    early.force.resize(at);
    BankRecord& late = cuts_.emplace_back(record);
    late.first = std::min(at, record.inputs.size() - 1);
    trials_.back().training.push_back(&early);
    trials_.back().held_back.push_back(&late);
  }
}

}  // namespace dashpot
