#include "dashpot/identify/rank/divisions.h"

#include "dashpot/record/trial_parts.h"

namespace dashpot {

Divisions divide(const Dataset& dataset, const LeaveOut& leave_out) {
  Divisions divisions;
  divisions.folds = split(dataset, leave_out);

  // Several folds serve each other, and so do the ends of records; what else is the only one is
  // divided again.
  const std::vector<Record>& first = divisions.folds.front().training;
  if (divisions.folds.size() == 1 && leave_out.by != LeaveOut::By::Fraction)
    divisions.held_back = hold_back(first, leave_out);

  divisions.is_one = leave_out.by == LeaveOut::By::Fraction || leave_out.by == LeaveOut::By::Roles;
  divisions.training = divisions.is_one ? first : dataset.records;
  return divisions;
}

std::vector<const std::vector<Record>*> fits_of(const Divisions& divisions) {
  std::vector<const std::vector<Record>*> fits{&divisions.training};
  if (!divisions.is_one)
    for (const Fold& fold : divisions.folds) fits.push_back(&fold.training);
  for (const Fold& fold : divisions.held_back) fits.push_back(&fold.training);
  return fits;
}

}  // namespace dashpot
