#pragma once
#include <optional>
#include <span>
#include <vector>

#include "dashpot/damper/nets/normal_equations.h"

namespace dashpot {

/// Watches training on the left-out samples and keeps the parameters that met them best. Without
/// left-out samples it does nothing and never stops.
class EarlyStopping {
 public:
  /// `mlp` gives layers and scales and must outlive it.
  EarlyStopping(const Mlp& mlp, const Stopping& stopping, double offset_decay = 0);

  /// Judges the parameters of an epoch or step; true when it is time to stop.
  bool judge(std::span<const double> parameters);
  /// Puts the best parameters into `mlp` and their error into the report; false when nothing was
  /// judged.
  bool finish(Mlp& mlp, TrainReport& report) const;

 private:
  const Mlp& mlp_;
  int patience_, since_best_ = 0;
  SampleBlocks blocks_;
  std::optional<BlockErrors> errors_;
  std::vector<double> best_;
  double rmse_ = 0;
};

}  // namespace dashpot
