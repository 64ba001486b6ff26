// Layer: damper
#pragma once

// The damper model that everything else runs: identify() and load_model() make one, and evaluate(),
// simulate() and the exporters step it. A model is immutable and may be shared by threads; its
// state is a flat array of state_size() numbers that belongs to the caller. SI, extension positive,
// a force positive when it resists extension.

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dashpot/damper_input.h"
#include "dashpot/model_kind.h"
#include "dashpot/value.h"

namespace dashpot {

/// The quantities that were constant in a test, by name, in SI: {"gap", 1e-3} ...
using Conditions = std::vector<std::pair<std::string, double>>;

/// The range of the training data; outside it the model extrapolates.
struct Domain {
  double displacement_min = 0, displacement_max = 0;  ///< m
  double velocity_min = 0, velocity_max = 0;          ///< m/s
  double current_min = 0, current_max = 0;            ///< A or V; spikes at switching left out
};

/// The motions of a car's damper, for models whose data do not say theirs.
Domain usual_domain(double current_min, double current_max);

/// The caller's arrays for a series of forces.
struct Response {
  double* force;             ///< N, one per sample
  double* spread = nullptr;  ///< N, as DamperModel::spread; null: not asked for
};

class LawModel;

/// One damper model of any kind. Every state that its functions take has state_size() numbers.
class DamperModel {
 public:
  virtual ~DamperModel() = default;

  virtual ModelKind kind() const = 0;
  virtual std::string name() const = 0;  ///< as the registry knows it: "bingham"
  virtual bool needs_displacement() const noexcept = 0;
  virtual std::size_t parameter_count() const noexcept = 0;
  virtual std::size_t state_size() const noexcept = 0;

  /// State after a long rest at the input's displacement and current, velocity 0.
  virtual void rest(const DamperInput& input, std::span<double> state) const noexcept = 0;
  /// Brings the state from the instant of `from` to that of `to`, dt seconds later; inputs are
  /// linear in between. Allocates nothing.
  virtual void advance(const DamperInput& from, const DamperInput& to, double dt,
                       std::span<double> state) const noexcept = 0;
  /// Force at this instant, N, positive when it resists extension.
  virtual double force(const DamperInput& input, std::span<const double> state) const noexcept = 0;
  /// The force, N, and, of an ensemble, the spread at every sample of a series. The state is that
  /// of the first sample before and that of the last one after. Returns how many forces can be
  /// used: all, or those before the sample where the model diverged; the rest is then without
  /// meaning, as is the state.
  virtual std::size_t run(std::span<const DamperInput> inputs, Steps steps, std::span<double> state,
                          Response to) const noexcept;

  /// Whether its states follow z' = f(x, v, i, z), as flow() has it, so that an integrator may step
  /// them with the rest of a vehicle.
  virtual bool flows() const noexcept { return state_size() == 0; }
  /// For a model that flows: the force at this instant, N, and the rates of its states.
  virtual double flow(const DamperInput& input, std::span<const double> state,
                      std::span<double> /*rates*/) const noexcept {
    return force(input, state);
  }

  /// Whether this is the mean of several models, whose spread shows where they have learnt little.
  virtual bool is_ensemble() const noexcept { return false; }
  /// Standard deviation of their forces at this instant, N; 0 for a single model.
  virtual double spread(const DamperInput& /*input*/,
                        std::span<const double> /*state*/) const noexcept {
    return 0;
  }
  /// Whether the force left the range that the model can answer for: it stands still since, until
  /// the next rest. Only a model that feeds its force back can.
  virtual bool has_diverged(std::span<const double>) const noexcept { return false; }
  /// s between the forces that are fed back; 0: none is.
  virtual double feedback_step() const noexcept { return 0; }
  /// Puts a measured force, N, in the place of the one that the model has just fed back: so the
  /// next one is predicted one step ahead, not in free run.
  virtual void observe(double, std::span<double>) const noexcept {}

  /// The force law that this model is or has inside; null where it has none.
  virtual const LawModel* law_inside() const noexcept { return nullptr; }

  /// The same model with this offset, N, added to its force.
  virtual std::unique_ptr<DamperModel> with_offset(double newton) const = 0;
  /// The model of the damper that these conditions describe; null where they say nothing to this
  /// model, as to any model of one damper. Throws Error at conditions that cannot be.
  virtual std::shared_ptr<const DamperModel> specialised(const Conditions&) const {
    return nullptr;
  }
  /// In words, each quantity in which this damper lies outside those that its model was fitted on.
  virtual std::vector<std::string> extrapolations() const { return {}; }
  /// The kind's own part of a model file.
  virtual Value to_json() const = 0;
};

/// The model as the class of one kind, for what that kind alone has; null where it is another.
template <class Model>
const Model* model_as(const DamperModel& model) {
  return dynamic_cast<const Model*>(&model);
}

/// An interval of the force around a model's: force -half ... force +half, its width by what is
/// known at run time. Constant in each band of speed, linear in the drive between knots, constant
/// beyond them; and the wider the less an ensemble's members agree.
struct ForceBand {
  double level = 0.9;       ///< share of samples that it claims to cover
  std::size_t records = 0;  ///< left-out records, or parts of them, that its width comes from
  /// m/s, ascending: |v| where one band of speed ends and the next begins.
  std::vector<double> speeds;
  std::vector<double> drives;      ///< A or V, ascending: the knots, at least one
  std::vector<double> half_width;  ///< N, one row per band of speed, one column per knot

  double spread = 0;  ///< times the members' spread, N, is added in quadrature

  /// Half the width at this input, N. `members_spread`: DamperModel::spread of the model there.
  double half_width_at(const DamperInput& input, double members_spread = 0) const noexcept;
  /// The same shape, `factor` times as wide.
  ForceBand scaled(double factor) const;
};

/// The origin of a model: the command that made it, and its data.
struct Provenance {
  std::string created;  ///< ISO 8601, UTC
  std::string command;  ///< the command line that makes it again
  std::string dataset;
  std::string citation;
  struct File {
    std::string path, sha256;
  };
  std::vector<File> files;
  std::vector<std::string> training_records;
};

}  // namespace dashpot
