#pragma once
#include <vector>

#include "dashpot/drive.h"
#include "dashpot/identify.h"
#include "studies/one_sensor/one_sensor_study.h"

// One fit of the one-sensor study, and how it is judged.
namespace dashpot {

/// What identify() gets: long recordings are thinned to what the kind of model needs.
struct StudiedFit {
  std::vector<Record> training;
  IdentifyOptions options;
};
StudiedFit studied_fit(const StudiedModel& model, const std::vector<Record>& training,
                       IdentifyOptions options);

/// The fit's model on the left-out records, at their full rate.
StudiedResult judge(const FitReport& fit, const Fold& fold, DriveUnit drive_unit);

}  // namespace dashpot
