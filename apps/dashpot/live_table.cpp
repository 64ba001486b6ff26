#include "live_table.h"

#include <algorithm>

#include <fmt/core.h>

#include "dashpot/base/text.h"
#include "dashpot/report/search_report.h"
#include "dashpot/report/words.h"
#include "dashpot/report/wrap.h"

namespace dashpot::cli {

void LiveTable::add(const Trial& trial, const SearchReport& search) {
  if (console_.quiet) return;
  const std::lock_guard lock(guard_);
  if (search_.rungs.empty()) {
    search_.options = search.options;
    search_.rungs = search.rungs;
  }
  fresh_.push_back(trial);
}

void LiveTable::draw() {
  constexpr std::chrono::milliseconds kRedraw(200);
  const std::lock_guard lock(guard_);
  const auto now = std::chrono::steady_clock::now();
  if (fresh_.empty() || (console_.live_width() > 0 && now - drawn_at_ < kRedraw)) return;
  take();
  if (console_.live_width() == 0) return;
  drawn_at_ = now;
  const std::string text = table();
  console_.talk_over(drawn_lines_, text);
  drawn_lines_ = static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

void LiveTable::finish() {
  const std::lock_guard lock(guard_);
  take();
  if (drawn_lines_ > 0) console_.talk_over(drawn_lines_, "");
  drawn_lines_ = 0;
}

/// Sorts in what came; a log gets a line of each that was not there from before.
void LiveTable::take() {
  for (Trial& trial : fresh_) {
    if (trial.rung != rung_) {
      rung_ = trial.rung;
      ended_ = 0;
      trials_.clear();
    }
    ++ended_;
    if (console_.live_width() == 0 && trial.kept < trial.folds.size()) console_.talk(line(trial));
    trials_.push_back(std::move(trial));
  }
  fresh_.clear();
  sort_trials(trials_);
}

std::string LiveTable::table() const {
  constexpr std::size_t kRows = 8;  // fits a small terminal
  const std::string round = search_.rungs.size() > 1
                                ? fmt::format(" in round {} of {}", rung_ + 1, search_.rungs.size())
                                : "";
  const DocumentTable best = trial_table(trials_, search_, kRows);
  const std::string text = fmt::format("{} of {} ended{}, the best so far:\n", ended_,
                                       counted(search_.rungs[rung_].trials, "trial"), round) +
                           text_table(best.columns, best.rows, console_.live_width());
  // A line that wraps would be two when it is drawn over.
  std::string cut;
  for (const std::string& row : split(text, '\n'))
    if (!row.empty())
      cut += first_columns(row, static_cast<std::size_t>(console_.live_width() - 1)) + '\n';
  return cut;
}

std::string LiveTable::line(const Trial& trial) const {
  const std::string outcome = !trial.failure.empty() ? "failed: " + trial.failure
                              : trial.diverged
                                  ? counted(trial.diverged, "record") + " diverged"
                                  : fmt::format("ESR {} %, {}", percent_text(trial.left_out.esr),
                                                counted(trial.parameters, "parameter"));
  const Rung& rung = search_.rungs[rung_];
  return fmt::format("{:>3} of {}{}  {}: {}\n", ended_, rung.trials,
                     rung.share < 1 ? fmt::format(" with 1/{:.0f}", 1 / rung.share) : "",
                     searched_settings(trial, search_), outcome);
}

}  // namespace dashpot::cli
