#pragma once
#include <string_view>
#include <vector>

#include "dashpot/identify/fit/law_residuals.h"
#include "dashpot/identify/fit/law_solution.h"

namespace dashpot {

/// The fit of one law: its unknowns, the records and what was asked for. All must outlive it.
struct LawTask {
  const Law& law;
  const std::vector<Record>& training;
  DriveUnit drive_unit;
  const IdentifyOptions& options;
  std::string_view model;  ///< whose choices hold
  LawUnknowns unknowns;

  LawTask(const Law& fitted, const std::vector<Record>& records, DriveUnit unit,
          const IdentifyOptions& asked, std::string_view name)
      : law(fitted),
        training(records),
        drive_unit(unit),
        options(asked),
        model(name),
        unknowns(fitted, data_scale(records, unit), unit, asked.offset, asked.choices, name) {}

  LawResiduals residuals(const Thinning& thinning) const {
    return {unknowns, training, drive_unit, options.offset, thinning};
  }
  /// How much of each record trials see. A law without a memory needs no samples in a row, one with
  /// a memory gets the first part: all of small data, a fifth of large ones.
  Thinning trial_thinning() const;
};

/// The fit of all records from x on. Priors are weighed against the residuals' noise, which only
/// the fit itself shows: so it is repeated until the noise stays.
LawSolution solve_all(const LawTask& task, std::vector<double> x);

/// Takes rebound and compression apart where a parameter of the valve is chosen, or the options ask
/// for it and it pays on records held back: puts the fit of `apart`, the task of the law
/// with_side(), in the place of `best`, that of `alike`. Returns whether it did.
bool take_side_apart(const LawTask& alike, const LawTask& apart, LawSolution& best);

}  // namespace dashpot
