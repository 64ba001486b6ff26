#pragma once
#include <string>
#include <vector>

#include "dashpot/machine/in_plant_report.h"

namespace dashpot {

struct SensorGrade;
class DamperUnknowns;
class PlantResiduals;
struct Covariance;
struct DataScale;
struct LeastSquaresReport;
struct PlantCases;

// What would let a fit inside a plant tell more, and how far a doubtful number may really lie.

/// A fit that has ended, for whoever asks what it could not tell.
struct EndedFit {
  const InPlantSetup& setup;
  const PlantCases& cases;
  const DamperUnknowns& law;
  const PlantResiduals& residuals;
  const LeastSquaresReport& solved;
  std::vector<double> plant_start;  ///< of the plant's unknowns
  const DataScale& scale;
};

/// Sensors that are not there, at this grade's noise, and recordings that were not made. What the
/// model lacks shows in a new sensor too: its noise counts as many times as that of the present
/// ones does. Numbers that nothing tells count as known to ten times their size.
PlantAdvice advise(const EndedFit& fit, const SensorGrade& grade, const InPlantOptions& options);

/// The profiles of these unknowns, named as in the report; an unknown whose parameter has several
/// coefficients has none. `deviations`: of each, SI.
std::vector<ParameterProfile> profiles_of(const EndedFit& fit, const Covariance& spread,
                                          const std::vector<std::string>& names,
                                          const InPlantOptions& options);

}  // namespace dashpot
