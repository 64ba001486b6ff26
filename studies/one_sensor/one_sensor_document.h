#pragma once
#include <string>

#include "dashpot/report/document.h"
#include "studies/one_sensor/one_sensor_study.h"

namespace dashpot {

/// The study as a page: the paper's tables and figures by their numbers, its figures beside ours,
/// and in words what agrees. What it says is computed from the study.
Document one_sensor_document(const OneSensorStudy& study);

/// Every figure of the study's tables by name, for programs.
Value one_sensor_json(const OneSensorStudy& study);

}  // namespace dashpot
