#pragma once
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dashpot/damper_model.h"
#include "dashpot/identify.h"
#include "dashpot/identify/fit/law_unknowns.h"
#include "dashpot/identify/fit/uncertainty.h"
#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/sensor_unknowns.h"
#include "dashpot/model_file.h"

namespace dashpot {

/// A number this near to a bound of its range, as a share of itself, stands there.
inline constexpr double kAtBound = 1e-4;

/// What can be told from these sensors and this excitation, before the fit: the sensitivity of all
/// sensors to each unknown about the start.
struct Knowable {
  std::vector<std::string> unknowns;
  /// Of the sensitivities, each unknown's scaled to length 1: descending. Close to 0: some cannot
  /// be told apart.
  std::vector<double> singular_values;
  std::vector<std::string> without_effect;           ///< unknowns that no sensor shows
  std::vector<std::vector<std::string>> confounded;  ///< that can be traded against each other
};

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

/// A kind of damper, as it was found.
struct FoundDamper {
  std::string name;                          ///< of the kind; the only one has none
  std::vector<std::size_t> struts;           ///< in which they stand
  std::shared_ptr<const DamperModel> model;  ///< without an offset: in equilibrium at rest
  Domain domain;                             ///< of these dampers' motion, as modelled
};

struct InPlantReport {
  FitReport::Status status = FitReport::Status::Failed;
  std::string message;
  std::vector<FoundDamper> kinds;  ///< of dampers; empty: nothing could be fitted
  std::vector<FittedParameter> plant, damper, nuisances;
  /// The plant's numbers as the sensors tell them whatever the dampers' forces are (any_force.h),
  /// where the law is shown not to be theirs; else empty.
  std::vector<FittedParameter> plant_beside_any_force;
  Knowable knowable;
  PlantAdvice advice;
  /// Of sensors and inputs that state none; what the fit cannot tell has no deviation.
  std::vector<FoundNoise> noise;
  std::vector<SensorFigures> sensors;  ///< without the road: one sample ahead, not in free run
  std::vector<InPlantTrace> traces;
  std::vector<std::string> warnings;
  bool road_measured = true;
  /// Without the road: what the law leaves of a damper's force, as the sensors tell it: rms, N.
  double force_error = std::numeric_limits<double>::quiet_NaN();
  /// Without the road: what the damper shows and the law does not, "spring", "spring and a
  /// dashpot".
  std::string lacks;
  std::string along;  ///< the law along which a model learnt that is no law
  int iterations = 0;
  double seconds = 0;     ///< CPU time
  std::size_t steps = 1;  ///< of the integrator per sample
  PlantMethod method = PlantMethod::RungeKutta;
  /// What half the step changes, rms, as a share of the rms error; the worst sensor.
  double step_error = 0;

  bool has_models() const { return !kinds.empty(); }
};

/// Whether a number has an interval: where a model is held that is no law, it has none.
bool has_interval(const FittedParameter& parameter);

/// The unknowns of a fit inside a plant, whatever its objective: the plant's numbers, the law's,
/// then nuisances.
class InPlantUnknowns {
 public:
  virtual ~InPlantUnknowns() = default;
  virtual std::size_t plant_unknowns() const = 0;
  virtual bool is_of_law(std::size_t k) const = 0;
  /// Null where k is not of a sensor; else described() has it in s.
  virtual const SensorUnknown* of_sensor(std::size_t k) const = 0;
  virtual std::string name(std::size_t k) const = 0;
  /// Of plant unknowns and nuisances: name, unit, meaning, value, whether it stands at a bound.
  virtual FittedParameter described(std::size_t k, std::span<const double> x) const = 0;
  /// Likewise, how much one unit of the unknown is in SI.
  virtual double size_at(std::size_t k, std::span<const double> x) const = 0;
  virtual std::vector<LawUnknowns::Coefficient> law_coefficients(
      std::span<const double> x) const = 0;
};

/// The name of unknown k, one of the law's, which are those from `first` on, of `size` in all.
std::string name_in_law(const InPlantUnknowns& unknowns, std::size_t first, std::size_t k,
                        std::size_t size);

/// What can be told, of normal matrices (n x n) of each part of the residuals.
Knowable knowable_of(const InPlantUnknowns& unknowns,
                     const std::vector<std::vector<double>>& part_matrices, std::size_t n);

/// How far the truth may lie below and above sum weights[k] x[first + k], 95 %.
using Reach =
    std::function<std::pair<double, double>(std::size_t first, std::span<const double> weights)>;

/// The parameters at x with their 95 % intervals, into the report: as `reach` has them, or those of
/// normal errors of this spread.
void add_parameters(const InPlantUnknowns& unknowns, std::span<const double> x,
                    const Covariance& spread, InPlantReport& report, const Reach& reach = {});
/// Bounds that were met, and what cannot be told.
void add_warnings(const InPlantUnknowns& unknowns, const Covariance& spread, InPlantReport& report);

/// The delays that `beside` asks for and `stated` does not, as a warning.
std::string delays_found(const InPlantSetup& stated, const InPlantSetup& beside,
                         const InPlantReport& report);

/// The filters that `beside` looks for and `stated` does not, and the delays that are left, as a
/// warning.
std::string filters_found(const InPlantSetup& stated, const InPlantSetup& beside,
                          const InPlantReport& report);

/// The kinds of dampers that were taken for unlike, as a warning.
std::string unlike_found(const InPlantSetup& unlike);

/// A current that never changes tells nothing of what the law does at others: asking for that is an
/// error; a law that could tell it is kept to this one, and a warning says so, for each kind of
/// damper. `setup`: with held drives (damper_drive.h).
void require_drive(const Law& law, const InPlantSetup& setup, const InPlantOptions& options,
                   std::vector<std::string>& warnings);

}  // namespace dashpot
