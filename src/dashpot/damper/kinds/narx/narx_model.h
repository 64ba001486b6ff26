#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "dashpot/damper/kinds/narx/regressors.h"
#include "dashpot/damper/nets/mlp_evaluator.h"

namespace dashpot {

/// Networks that read delayed inputs and their own past forces (NARX): F(t) = f(u(t - lags), F(t -
/// lags)), the mean of a few, each fed back its own. It steps on the grid of its sample time;
/// between two instants of the grid the past is read by linear interpolation, so at steps of the
/// sample time the plain recursion comes out. A force further than kRange output scales from the
/// output's mean is no answer: the model stands still there and has diverged. A network whose
/// output layer is bounded (tanh) cannot get there.
class NarxModel final : public DamperModel {
 public:
  static constexpr double kRange = 10;

  /// Throws Error, beginning with `where` (the name when empty), when the parts do not fit
  /// together.
  NarxModel(std::string name, Regressors regressors, std::vector<Mlp> members, double offset = 0,
            const std::string& where = {});

  ModelKind kind() const override { return ModelKind::Narx; }
  std::string name() const override { return name_; }
  bool needs_displacement() const noexcept override { return needs_displacement_; }
  std::size_t parameter_count() const noexcept override;
  std::size_t state_size() const noexcept override;
  /// Forces are those that come of a second or more at rest.
  void rest(const DamperInput& input, std::span<double> state) const noexcept override;
  void advance(const DamperInput& from, const DamperInput& to, double dt,
               std::span<double> state) const noexcept override;
  double force(const DamperInput& input, std::span<const double> state) const noexcept override;
  bool has_diverged(std::span<const double> state) const noexcept override {
    return state[kDiverged] != 0;
  }
  double feedback_step() const noexcept override {
    return regressors_.feedback.empty() ? 0 : regressors_.sample_time;
  }
  /// Whether the weights leave it possible: no bounded layer holds every force within the range.
  bool can_diverge() const;
  void observe(double force, std::span<double> state) const noexcept override;
  std::unique_ptr<DamperModel> with_offset(double newton) const override;
  Value to_json() const override;

  const Regressors& regressors() const { return regressors_; }
  double offset() const { return offset_; }
  const std::vector<Mlp>& members() const { return members_; }

 private:
  /// The state: s since the last instant of the grid, whether it diverged, then values at that
  /// instant and before it, the newest first: of each input, of each member's force.
  enum Place : std::size_t { kPending, kDiverged, kHistory };
  struct Past {
    double DamperInput::* field;
    const std::vector<std::size_t>* lags;
    std::size_t first, size;  ///< in the state
  };

  double evaluate(std::size_t member, const DamperInput& input, double share,
                  std::span<const double> state) const noexcept;
  void tick(const DamperInput& input, std::span<double> state) const noexcept;
  bool is_now(const DamperInput& input, std::span<const double> state) const noexcept;
  std::size_t force_place(std::size_t member) const noexcept;
  /// The force within its member's range; the last one in place of NaN.
  double held(std::size_t member, double force, double last) const noexcept;

  std::string name_;
  Regressors regressors_;
  std::vector<Mlp> members_;
  double offset_;
  std::vector<MlpEvaluator<double>> evaluators_;
  std::vector<Past> inputs_;
  std::size_t forces_at_ = kHistory, force_size_ = 1;
  bool needs_displacement_ = false;
};

std::unique_ptr<NarxModel> narx_model_from_json(const Value& value);

}  // namespace dashpot
