#pragma once
#include <optional>
#include <vector>

#include "dashpot/drive.h"
#include "dashpot/evaluate.h"
#include "dashpot/identify.h"
#include "dashpot/split.h"
#include "studies/one_sensor/one_sensor_models.h"

// One fit of the one-sensor study, and how it is judged.
namespace dashpot {

/// The input of identify(): long recordings are thinned to the samples that the kind of model
/// needs.
struct StudiedFit {
  std::vector<Record> training;
  IdentifyOptions options;
};
StudiedFit studied_fit(const StudiedModel& model, const std::vector<Record>& training,
                       IdentifyOptions options);

/// A model on the left-out records of one experiment, in free run, or of several together.
struct StudiedResult {
  ErrorSums sums;
  Metrics metrics;
  /// Of a model with feedback: errors one step ahead, fed the measured force.
  std::optional<ErrorSums> one_step;
  std::optional<double> diverged_at;  ///< s
  std::size_t parameters = 0;
  double seconds = 0;  ///< CPU time of the fit
  /// N, at every sample of each left-out record; only of models that figures show.
  std::vector<std::vector<double>> forces;
};

/// The fit's model, which must be there, on the left-out records at their full rate.
StudiedResult judge(const FitReport& fit, const Fold& fold, DriveUnit drive_unit);

}  // namespace dashpot
