#pragma once
#include <string>
#include <vector>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/identify.h"

namespace dashpot::cli {

/// A parameter that was known and has been identified.
struct RecoveredParameter {
  std::string name, unit;
  double truth = 0, found = 0;
  double half_width = 0;  ///< of the interval that holds 95 % for all parameters at once
  bool weak = false;      ///< by the fit itself, these data do not determine it
  bool recovered() const;
};

/// Shares of the truth within which a parameter counts as recovered whatever its interval.
constexpr double kRecoveryTolerance = 0.02;

/// The fitted parameters of the true law against the truth; without fixed ones and the force zero,
/// which the records' offsets hide.
std::vector<RecoveredParameter> compare(const LawModel& truth, const FitReport& fit);

std::string recovery_table(const std::vector<RecoveredParameter>& parameters, int width);
Value to_json(const std::vector<RecoveredParameter>& parameters);

}  // namespace dashpot::cli
