#pragma once
#include <memory>
#include <span>
#include <string>

#include "dashpot/damper_model.h"

namespace dashpot {

/// The state of damper and controller at the instant of a command.
struct InverseInput {
  double wanted = 0;        ///< N, the force wanted at this motion
  double displacement = 0;  ///< m, extension positive
  double velocity = 0;      ///< m/s
  double current = 0;       ///< A in the coil now, measured or from a Driver
  double measured = 0;      ///< N, the force now; only schemes with feedback look at it
};

/// Range of the current, and the clocks of controller and coil.
struct InverseLimits {
  double current_min = 0, current_max = 1;  ///< A (or V)
  double sample_time = 1e-3;                ///< s between two commands
  /// 1/s, the coil's first-order lag; 0: it is there at once. The command goes beyond the current
  /// that is meant, so that the coil is there one sample later, as far as the limits allow. It aims
  /// at a current, not at the force one sample ahead: where the motion turns the force jumps, but
  /// the current that gives it does not.
  double lag_rate = 0;
};

/// From a wanted force to the current that gives it: of equal rank to DamperModel. The description
/// is immutable and may be shared by threads; the state is a flat array of the caller's,
/// state_size() numbers, set by rest(). One command() per sample_time.
class InverseModel {
 public:
  /// Throws Error when the limits are no range or the sample time is not above 0.
  explicit InverseModel(const InverseLimits& limits, bool has_feedback = false);
  virtual ~InverseModel() = default;

  virtual std::string name() const = 0;  ///< as the registry of schemes knows it: "numeric"
  virtual std::size_t state_size() const noexcept { return 0; }
  /// State after a long rest at the input's displacement and current.
  virtual void rest(const DamperInput&, std::span<double>) const noexcept {}

  /// Current to command now, A, always within the limits. Where the input is not finite, it is the
  /// present current; the measured force counts only where has_feedback(). Allocates nothing and
  /// throws nothing.
  double command(const InverseInput& input, std::span<double> state) const noexcept;

  const InverseLimits& limits() const { return limits_; }
  /// How far beyond the wanted change the command goes; 1 for a coil without lag.
  double lead() const { return lead_; }
  /// Whether it looks at the measured force.
  bool has_feedback() const { return has_feedback_; }

 protected:
  friend struct InverseText;
  /// Current that should flow; may leave the limits or be NaN. The input is finite, but for a
  /// measured force without has_feedback().
  virtual double wanted_current(const InverseInput& input,
                                std::span<double> state) const noexcept = 0;

 private:
  InverseLimits limits_;
  double lead_;
  bool has_feedback_;
};

}  // namespace dashpot
