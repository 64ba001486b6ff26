#pragma once
#include <array>

#include "dashpot/suspension/steps/road_car.h"
#include "dashpot/suspension/steps/step_method.h"

namespace dashpot {

/// A damper that is a law without a lag: its parameters stay as they are while its current does.
struct SteadyLaw {
  SoftLaw law;
  double current = NAN;
  std::array<double, kMaxParams> parameters{};
};

/// A plant whose dampers flow as y' = f(t, y), y = [q, q', states of each damper's model]. The
/// coils' currents are known functions of time as long as no command changes.
///
/// Loops that are followed stand in y by their r (LoopPath) in the place of z.
class PlantEquations {
 public:
  PlantEquations(const PlantForces& forces, const PlantState& start);
  PlantEquations(const PlantEquations&) = delete;
  PlantEquations& operator=(const PlantEquations&) = delete;
  ~PlantEquations() = default;
  /// Follows the loops of all dampers, with the error of these options.
  void follow_loops(const PlantState& start, const IntegratorOptions& options);
  std::vector<FollowedLoop>& loops() noexcept { return loops_; }
  const std::vector<FollowedLoop>& loops() const noexcept { return loops_; }

  std::size_t size() const noexcept { return size_; }
  std::size_t coordinates() const noexcept { return coordinates_; }
  /// y of a state, which must outlive the calls of rates(): their time counts from its instant.
  void read(const PlantState& state, double* y);
  /// The same of a state that differs from the one that was last written or read by its currents
  /// alone.
  void read_currents(const PlantState& state);
  /// f at `after` seconds from there. Allocates nothing.
  void rates(double after, const double* y, double* dy) noexcept;
  /// Instants of a step, s after there, whose road and currents are found at once: at most
  /// kInstants, in order of time.
  static constexpr std::size_t kInstants = 5;
  void look_ahead(std::span<const double> after) noexcept;
  /// rates() at one of them.
  void rates_at(std::size_t instant, const double* y, double* dy) noexcept;
  /// The equations as those of a RoadCar; null where they are others.
  const RoadCar* road_car() const noexcept { return is_road_car_ ? &road_car_ : nullptr; }
  /// Of a RoadCar: the road under its tyre and the parameters of its law at an instant.
  const FootMotion& foot(std::size_t instant) const noexcept { return feet_[instant]; }
  const double* law_parameters(std::size_t instant) const noexcept {
    return steady_[0] ? laws_[0].parameters.data() : ahead_[instant].data();
  }
  /// Its forces at the end of a step, as the last call of rates().
  void put_forces(const RoadCar::Forces& forces) noexcept {
    damper_forces_[0] = forces.damper;
    strut_forces_[0] = forces.strut;
  }
  /// Brings the state to `end`, s, where it is y; dy must come from the last call of rates(), at y.
  void write(const double* y, const double* dy, double end, PlantState& state);
  /// Forces and accelerations at the last call of rates(), which gave dy, into the state.
  void write_forces(const double* dy, PlantState& state) const;

 private:
  /// rates() of a plant with these sizes, where foot_of(tyre) is the road.
  template <class Sizes, class FootOf>
  void rates_of(Sizes sizes, double after, const double* y, double* dy, FootOf foot_of) noexcept;

  const PlantForces& forces_;
  std::size_t coordinates_, size_;
  const PlantState* state_ = nullptr;
  std::vector<double> currents_, damper_forces_, strut_forces_, speeds_;
  std::vector<char> steady_;     ///< whether a coil's current stays as it is
  std::vector<SteadyLaw> laws_;  ///< one per damper
  std::vector<FollowedLoop> loops_;
  std::vector<double> states_;   ///< of the dampers at the last call of rates(), loops by their z
  std::size_t ahead_count_ = 0;  ///< of the instants ahead
  std::array<double, kInstants> after_{};  ///< s after the state's
  std::array<double, kInstants> times_{};  ///< and their times, s
  std::vector<FootMotion> feet_;           ///< there, tyre by tyre
  bool is_road_car_ = false;
  RoadCar road_car_{};
  std::array<std::array<double, kMaxParams>, kInstants> ahead_{};  ///< its parameters there
};

}  // namespace dashpot
