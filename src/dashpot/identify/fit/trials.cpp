#include "dashpot/identify/fit/trials.h"

#include <algorithm>

#include "dashpot/base/parallel.h"
#include "dashpot/identify/fit/free_run_records.h"
#include "dashpot/record/trial_parts.h"

namespace dashpot {

Trials::Trials(const std::vector<Record>& training, DriveUnit drive_unit) {
  for (const Fold& fold : trial_folds(training)) {
    FreeRunTrial trial;
    trial.training = keep(free_run_records(fold.training, drive_unit));
    trial.held_back = keep(free_run_records(fold.left_out, drive_unit));
    trials_.push_back(std::move(trial));
  }
}

std::vector<const FreeRunRecord*> Trials::keep(std::vector<FreeRunRecord> records) {
  std::vector<const FreeRunRecord*> pointers;
  for (const FreeRunRecord& record : kept_.emplace_back(std::move(records)))
    pointers.push_back(&record);
  return pointers;
}

double Trials::best_decay(
    std::span<const double> decays, int threads,
    const std::function<double(const FreeRunTrial&, double)>& squares_left) const {
  std::vector<double> squares(decays.size() * trials_.size());
  parallel_for(squares.size(), threads, [&](std::size_t k) {
    squares[k] = squares_left(trials_[k / decays.size()], decays[k % decays.size()]);
  });
  std::vector<double> sums(decays.size());
  for (std::size_t k = 0; k < squares.size(); ++k) sums[k % decays.size()] += squares[k];
  return decays[static_cast<std::size_t>(std::min_element(sums.begin(), sums.end()) -
                                         sums.begin())];
}

}  // namespace dashpot
