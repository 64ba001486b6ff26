#include "dashpot/damper/kinds/state_space/state_space_model.h"

#include <cmath>

namespace dashpot {
namespace {

bool is_positive(double value) { return value > 0 && std::isfinite(value); }

void require_positive(double value, const std::string& what, const std::string& where) {
  if (!is_positive(value)) throw Error(where, what + " is not a positive number");
}

void require_most(std::size_t count, std::size_t least, std::size_t most, const std::string& what,
                  const std::string& where) {
  if (count < least || count > most)
    throw Error(where, "has " + std::to_string(count) + " " + what,
                std::to_string(least) + " to " + std::to_string(most));
}

void require_sound(const StateSpaceCell& cell, const std::string& where) {
  require_most(cell.motions(), 1, StateSpaceCell::kMaxMotions, "rates of paths and lags", where);
  require_most(cell.currents(), 1, StateSpaceCell::kMaxCurrents, "current rates", where);
  for (const std::vector<double>* rates : {&cell.path_rates, &cell.lag_rates, &cell.current_rates})
    for (const double rate : *rates) require_positive(rate, "a rate", where);

  // Scales are divided by, and ranges have a low and a high end.
  require_positive(cell.velocity_scale, "the scale of the velocity", where);
  require_positive(cell.current_scale, "the scale of the current", where);
  require_positive(cell.model_step, "the model step", where);
  if (!(cell.velocity_low <= cell.velocity_high) || !(cell.current_low <= cell.current_high))
    throw Error(where, "a range does not go upwards");

  // The weights must be as many as states and neurons need.
  require_most(cell.hidden(), 0, StateSpaceCell::kMaxHidden, "neurons", where);
  if (cell.neurons.size() % cell.neuron_stride() != 0)
    throw Error(where,
                "the cell has " + std::to_string(cell.neurons.size()) + " weights of neurons",
                "each neuron needs " + std::to_string(cell.neuron_stride()));
  if (const std::size_t right = 2 * cell.motions() * cell.features(); cell.feedback.size() != right)
    throw Error(where, "has " + std::to_string(cell.feedback.size()) + " weights of feedback",
                "its states and neurons need " + std::to_string(right));
}

}  // namespace

void StateSpaceNetwork::require_sound(const std::string& where) const {
  dashpot::require_sound(cell, where);
  network.require_sound(cell.signal_count(), where);
}

}  // namespace dashpot
