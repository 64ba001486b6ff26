#pragma once
#include <string>
#include <vector>

#include "dashpot/machine/in_plant_setup.h"

namespace dashpot {

struct SensorGrade;
class LawUnknowns;
class PlantResiduals;
struct Covariance;
struct DataScale;
struct LeastSquaresReport;
struct PlantCases;

// What would let a fit inside a plant tell more, and how far a doubtful number may really lie.

/// The misfit along one number, all others fitted anew at each of its values.
struct ParameterProfile {
  std::string name, unit;
  std::vector<double> value;   ///< SI, ascending, the best among them
  std::vector<double> misfit;  ///< over that of the best; 3.84 bounds the 95 % interval
  double low = 0, high = 0;    ///< of that interval; infinite where it is open as far as was looked
};

/// What one more sensor, or one more recording, would do to the 95 % intervals of plant and damper.
struct PlantAddition {
  std::string what;      ///< "velocity of body", "a recording at twice the amplitude"
  double intervals = 1;  ///< geometric mean of their widths over those of now
  std::string most;      ///< the number whose interval shrinks most; empty: none does
  double of_most = 1;    ///< its width over that of now
};

struct PlantAdvice {
  std::string grade;                   ///< of the sensors that were tried
  std::string worst;                   ///< the number that is known worst, by its size
  std::vector<PlantAddition> sensors;  ///< the best first
  std::vector<PlantAddition> rides;    ///< beside one more recording like the first; likewise
  std::vector<ParameterProfile> profiles;
};

/// A fit that has ended, for whoever asks what it could not tell.
struct EndedFit {
  const InPlantSetup& setup;
  const PlantCases& cases;
  const LawUnknowns& law;
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
