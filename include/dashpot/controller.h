// Layer: suspension
#pragma once

// Control laws of suspensions: from the signals of a plant's struts, once per sample, to a demand
// on each damper. A program names a law in one text, make_controller() makes it for a plant and its
// dampers' limits, and simulate() steps it. SI; controllers are immutable, and every state is a
// flat array of the caller's.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/parameter_table.h"
#include "dashpot/plant.h"

namespace dashpot {

/// Signals of one strut at a sample, as sensors and filters give them to a controller. z up,
/// extension positive.
struct StrutSignals {
  double body_velocity = 0, body_acceleration = 0;  ///< m/s, m/s^2, of its upper end
  double wheel_velocity = 0;                        ///< m/s, of its lower end
  double deflection = 0, deflection_velocity = 0;   ///< m, m/s
  double force = 0;                                 ///< N, of the damper
  double current = 0;                               ///< A, in the coil
};

/// A controller's demand on one damper.
struct DamperDemand {
  enum class Kind { Damping, Force, Current };
  Kind kind = Kind::Damping;
  /// N*s/m within the limits; N, positive when it resists extension; or A (V), as `kind` says.
  double value = 0;
};

/// The limits of the dampers behind a controller.
struct ControlLimits {
  double damping_min = 300, damping_max = 3900;  ///< N*s/m
  double current_min = 0, current_max = 1;       ///< A (or V)
  double sample_time = 1e-3;                     ///< s
};

/// A controller as numbers: what the C text of its law, control_<law>.h, asks for.
struct ControlDescription {
  std::string law;                 ///< "selector" for the two of `choices`; empty: it has no text
  std::vector<double> parameters;  ///< of its struct, in their order; of a selector the crossover
  std::vector<double> gain = {};   ///< of a regulator: a row over the plant's state per strut
  std::size_t memory = 0;          ///< numbers that it keeps per strut
  std::vector<ControlDescription> choices = {};  ///< at low and at high frequencies of the body
};

/// A discrete control law for all dampers of a plant. Immutable; the state is the caller's.
class Controller {
 public:
  virtual ~Controller() = default;
  /// The length of its state.
  virtual std::size_t state_size() const noexcept { return 0; }
  /// Writes the state before the first sample.
  virtual void reset(std::span<double>) const noexcept {}
  /// One sample: a demand per strut. plant_state is [q, q'], q counted from where the plant would
  /// rest on the ground as it is; empty where nothing gives it. Allocates nothing.
  virtual void step(std::span<const StrutSignals> struts, std::span<const double> plant_state,
                    std::span<double> state, std::span<DamperDemand> demands) const noexcept = 0;
  /// The same law as numbers, for its C text; empty where it has none.
  virtual ControlDescription description() const { return {}; }
};
using ControllerPointer = std::unique_ptr<const Controller>;

/// The limits and the plant that a law is made for, both the caller's.
struct ControlContext {
  const ControlLimits& limits;
  const Plant& plant;
};

/// A control law, known by name.
struct ControlLaw {
  std::string_view name, title, equation, source, remarks;
  std::vector<ParameterRow> parameters;
  bool needs_plant_state = false;
  /// Throws Error where the plant does not suit it.
  ControllerPointer (*make)(std::span<const double> values,
                            const ControlContext& context) = nullptr;
};
/// All laws in alphabetical order; they live as long as the program.
std::span<const ControlLaw* const> control_laws();
/// Throws Error "unknown controller 'skyhok'; did you mean ...".
const ControlLaw& find_control_law(std::string_view name, const std::string& where = {});

/// From a text like "skyhook" or "mix1,crossover=1.9Hz"; "selector(skyhook/add),crossover=1.9Hz"
/// takes the first law at low frequencies and the second at high ones. Throws Error(where, ...) on
/// an unknown law or parameter, on a value outside its bounds, on limits that make no sense.
ControllerPointer make_controller(const std::string& text, const ControlContext& context,
                                  const std::string& where = "controller");
/// Whether the controller of that text feeds the plant's state back.
bool needs_plant_state(const std::string& text);

/// The sensors between the plant and its controller. Ideal by default: the laws see the true
/// signals.
struct SensorOptions {
  bool in_car = false;  ///< a body accelerometer and a deflection sensor per strut; the rest is
                        ///< made from these
  double acceleration_noise = 0.05;       ///< m/s^2, standard deviation
  double acceleration_resolution = 0.01;  ///< m/s^2
  double deflection_noise = 5e-5;         ///< m, standard deviation
  double deflection_resolution = 2e-5;    ///< m
  double delay = 0;                       ///< s, of both, in whole samples
  double integration_corner = 0.15;  ///< Hz: slower motions are left out of the body's velocity
  double derivative_corner = 80;     ///< Hz: of the deflection's derivative
  std::uint64_t seed = 1;
};

}  // namespace dashpot
