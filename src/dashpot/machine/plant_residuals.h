#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dashpot/identify.h"
#include "dashpot/identify/fit/uncertainty.h"
#include "dashpot/machine/damper_unknowns.h"
#include "dashpot/machine/in_plant_report.h"
#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/input_noise.h"
#include "dashpot/machine/plant_cases.h"
#include "dashpot/machine/plant_recording.h"
#include "dashpot/machine/sensor_unknowns.h"
#include "dashpot/numerics/least_squares.h"

namespace dashpot {

/// What the sensors of a plant would show less what they did show, over their scale, as a function
/// of all unknowns: the plant's, the law's, per recording the state at its beginning, the sensors'
/// delays and cut-offs. The law is that of every damper in the plant, with numbers of its own in
/// each kind. Models may stand in the law's place, held as they are: then the dampers have no
/// unknowns, and their states begin at rest. All that it is made from must outlive it.
class PlantResiduals : public InPlantUnknowns {
 public:
  using Shown = std::vector<std::vector<double>>;  ///< per sensor

  /// plant: where the plant's unknowns start, SI; scale: of the damper's motion.
  PlantResiduals(const InPlantSetup& setup, const PlantCases& cases, const DamperUnknowns& law,
                 const std::vector<double>& plant, const DataScale& scale);
  /// held: of each kind of damper one.
  PlantResiduals(const InPlantSetup& setup, const PlantCases& cases,
                 std::vector<std::shared_ptr<const DamperModel>> held,
                 const std::vector<double>& plant, const DataScale& scale);

  /// Whether unknown k acts on this recording: a state at a beginning does so on its own alone.
  bool acts_on(std::size_t k, std::size_t recording) const;

  /// The start: the plant's numbers and, per recording, coordinates and their velocities at its
  /// beginning (SI; empty: at rest), the law's start or, with `random`, one beside it.
  std::vector<double> start(const std::vector<double>& plant,
                            const std::vector<double>& states = {}, Random* random = nullptr) const;
  /// The unknowns with those of the law that stand at a bound back inside.
  std::vector<double> off_bounds(std::vector<double> x) const;
  /// What start() takes as `states`, of these unknowns.
  std::vector<double> states_of(std::span<const double> x) const;
  /// At most so many samples of each recording (0: all that may be fitted).
  LeastSquaresProblem problem(std::size_t samples = 0, int threads = 0) const;
  /// Takes the rms that is left at each sensor as its scale where no noise was stated; returns the
  /// largest relative change, 0 where there is only one sensor.
  double reweigh(std::span<const double> x);
  /// From now on a state of the damper at a beginning is 0 where its whole size hardly moves the
  /// sensors at the end of this search: a sharp hysteresis has forgotten it at once. For a force
  /// that goes straight alone.
  void leave_out_forgotten(const LeastSquaresReport& at);
  Covariance covariance_at(const LeastSquaresReport& solved) const;
  /// From now on all residuals (not those of a shorter time) are what is shown at each frequency at
  /// which the inputs are known, per recording of these, which must outlive this; nullptr: samples
  /// again.
  void look_at_lines(const std::vector<RecordingNoise>* noise) { noise_ = noise; }
  /// The setup with all that x says: the plant's numbers and what is found of sensors.
  InPlantSetup setup_at(std::span<const double> x) const;

  std::size_t plant_unknowns() const override { return setup_->unknown.size(); }
  /// Behind the states at the beginnings: delays and cut-offs of sensors.
  std::size_t first_of_sensors() const { return first_of_sensors_; }
  bool is_of_law(std::size_t k) const override;
  const SensorUnknown* of_sensor(std::size_t k) const override;
  std::string name(std::size_t k) const override;
  double size_at(std::size_t k, std::span<const double>) const override { return size_[k]; }
  FittedParameter described(std::size_t k, std::span<const double> x) const override;
  std::vector<LawUnknowns::Coefficient> law_coefficients(std::span<const double> x) const override;
  /// The law of each kind of damper.
  std::vector<LawModel> laws(std::span<const double> x) const;

  /// What sensors at other places would show in a recording, without offset and delay: per place
  /// the samples that are fitted, without their mean. Empty where it diverges.
  Shown other_sensors(std::span<const double> x, std::size_t recording,
                      const std::vector<PlantSensorPlace>& places) const;
  std::size_t first_state() const { return first_state_; }
  double scale_of(std::size_t sensor) const { return scale_[sensor]; }

  /// What half the step changes at the sensors, rms over rms error; the worst sensor.
  double step_error(std::span<const double> x, const std::vector<PlantRecording>& recordings,
                    int threads) const;
  /// Whether the plant diverges in a recording, with the time that is held back.
  bool diverges(std::span<const double> x) const;
  /// Figures and samples of every sensor over whole recordings, in free run.
  void describe(std::span<const double> x, std::vector<SensorFigures>& figures,
                std::vector<InPlantTrace>& traces, int threads) const;

 private:
  PlantResiduals(const InPlantSetup& setup, const PlantCases& cases, const DamperUnknowns* law,
                 std::vector<std::shared_ptr<const DamperModel>> held,
                 const std::vector<double>& plant, const DataScale& scale);
  /// Dampers, of each kind one, and in each strut the one of its kind.
  struct Dampers {
    std::vector<std::shared_ptr<const DamperModel>> kinds;
    std::vector<const DamperModel*> in_struts;
  };
  /// Those at x: the laws, or the model that is held. In one recording: a current that never
  /// changes leaves constant parameters, which are quicker.
  Dampers dampers(std::span<const double> x) const;
  Dampers dampers_in(const PlantCase& one, std::span<const double> x) const;
  Dampers laws_in(const PlantCase& one, std::vector<LawModel> laws) const;
  Dampers placed(std::vector<std::shared_ptr<const DamperModel>> kinds) const;
  DrivenPlant equations(std::span<const double> x) const;
  std::vector<double> state_at_first(std::span<const double> x, std::size_t place,
                                     const DrivenPlant& plant, PlacedDampers dampers) const;
  bool run(std::span<const double> x, const DrivenPlant& plant, PlacedDampers dampers,
           const PlantCase& one, std::size_t place, std::size_t samples,
           std::span<const PlantSensorPlace> sensors, Shown& shown) const;
  bool move(std::span<const double> x, const DrivenPlant& plant, PlacedDampers dampers,
            const PlantCase& one, std::size_t place, std::size_t samples,
            std::span<const PlantSensorPlace> sensors, Shown& shown,
            const RunBeside& beside = {}) const;
  void put_sensors(std::span<const double> x, std::vector<PlantSensor>& sensors) const;
  void sense(std::span<const double> x, double sample_time, std::size_t samples,
             Shown& shown) const;
  std::size_t end_of(const PlantCase& one, std::size_t samples) const;
  bool evaluate(std::span<const double> x, std::size_t samples, std::span<double> r,
                int threads) const;
  /// How a recording is run at x, for those that differ hardly from it.
  struct KnownRun {
    RunTangent tangent;
    Shown shown;  ///< before its sensors
  };
  bool evaluate_one(std::span<const double> x, std::size_t place, std::size_t samples,
                    std::span<double> r, KnownRun* keep = nullptr) const;
  bool compare(std::span<const double> x, std::size_t place, std::size_t samples, Shown shown,
               std::span<double> r) const;
  bool jacobian(std::span<const double> x, std::size_t samples, std::span<double> r,
                std::span<double* const> columns, int threads) const;
  std::optional<DamperUnknowns::Group> moved_as_one(std::size_t k, std::size_t place) const;
  double difference_step(std::span<const double> x, std::size_t k, bool other_way) const;
  bool difference(std::span<const double> x, std::size_t place, std::size_t samples,
                  std::span<const double> r, const KnownRun& at, std::size_t k, bool other_way,
                  std::span<double> column) const;
  bool difference_of_group(std::span<const double> x, std::size_t place, std::size_t samples,
                           std::span<const double> r, const KnownRun& at,
                           const DamperUnknowns::Group& group, bool other_way,
                           std::span<const std::span<double>> columns) const;
  std::size_t residuals_of(std::size_t place, std::size_t samples) const;
  std::size_t part_of(std::size_t place, std::size_t samples) const;
  bool keeps_states_near() const;
  bool is_of_damper(std::size_t state) const;
  std::size_t states() const { return state_size_.size(); }

  const InPlantSetup* setup_;
  const PlantCases* cases_;
  const DamperUnknowns* law_;                             ///< null: `held_` are the dampers
  std::vector<std::shared_ptr<const DamperModel>> held_;  ///< of each kind; empty: the law is
  std::span<const StateInfo> law_states_;
  std::vector<PlantInputPlace> inputs_;
  std::vector<PlantSensorPlace> sensors_;
  std::vector<double> scale_;  ///< per sensor
  std::size_t coordinates_ = 0;
  std::vector<double> state_size_;  ///< of q, q', each damper's states of the law; empty: rest
  std::vector<SensorUnknown> of_sensors_;
  std::size_t first_state_ = 0, first_of_sensors_ = 0;  ///< places among the unknowns
  std::vector<double> size_, lower_, upper_;
  std::vector<std::size_t> forgotten_;  ///< unknowns that are left out
  const std::vector<RecordingNoise>* noise_ = nullptr;
};

}  // namespace dashpot
