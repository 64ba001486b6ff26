#include "dashpot/damper/neural/state_space_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/base/error.h"

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
  require_positive(cell.velocity_scale, "the scale of the velocity", where);
  require_positive(cell.current_scale, "the scale of the current", where);
  require_positive(cell.model_step, "the model step", where);
  if (!(cell.velocity_low <= cell.velocity_high) || !(cell.current_low <= cell.current_high))
    throw Error(where, "a range does not go upwards");
  require_most(cell.hidden(), 0, StateSpaceCell::kMaxHidden, "neurons", where);
  if (cell.neurons.size() % cell.neuron_stride() != 0)
    throw Error(where, "the cell has " + std::to_string(cell.neurons.size()) + " weights of neurons",
                "each neuron needs " + std::to_string(cell.neuron_stride()));
  if (const std::size_t right = 2 * cell.motions() * cell.features(); cell.feedback.size() != right)
    throw Error(where, "has " + std::to_string(cell.feedback.size()) + " weights of feedback",
                "its states and neurons need " + std::to_string(right));
}

}  // namespace

StateSpaceModel::StateSpaceModel(std::string name, std::vector<StateSpaceNetwork> members, double offset,
                                 const std::string& where)
    : name_(std::move(name)), members_(std::move(members)), offset_(offset) {
  const std::string& place = where.empty() ? name_ : where;
  if (members_.empty()) throw Error(place, "has no members", "a cell and its network at least");
  for (const StateSpaceNetwork& member : members_) {
    require_sound(member.cell, place);
    member.network.require_sound(member.cell.signal_count(), place);
    state_size_ += member.cell.size();
  }
}

std::size_t StateSpaceModel::parameter_count() const noexcept {
  std::size_t count = 0;
  for (const StateSpaceNetwork& member : members_) count += member.parameter_count();
  return count;
}

void StateSpaceModel::rest(const DamperInput& input, std::span<double> state) const noexcept {
  for (const StateSpaceNetwork& member : members_) {
    member.cell.rest(input, state.first(member.cell.size()));
    state = state.subspan(member.cell.size());
  }
}

void StateSpaceModel::advance(const DamperInput& from, const DamperInput& to, double dt,
                              std::span<double> state) const noexcept {
  for (const StateSpaceNetwork& member : members_) {
    member.cell.advance(from, to, dt, state.first(member.cell.size()));
    state = state.subspan(member.cell.size());
  }
}

double StateSpaceModel::force(const DamperInput& input, std::span<const double> state) const noexcept {
  std::array<double, GatedNetwork::kMaxSignals> signals;
  double sum = 0;
  for (const StateSpaceNetwork& member : members_) {
    member.cell.read(input, state.first(member.cell.size()), signals.data());
    sum += member.network.evaluate(signals.data());
    state = state.subspan(member.cell.size());
  }
  return sum / static_cast<double>(members_.size()) + offset_;
}

double StateSpaceModel::flow(const DamperInput& input, std::span<const double> state,
                             std::span<double> rates) const noexcept {
  std::size_t place = 0;
  for (const StateSpaceNetwork& member : members_) {
    const std::size_t size = member.cell.size();
    member.cell.flow(input, state.subspan(place, size), rates.subspan(place, size));
    place += size;
  }
  return force(input, state);
}

double StateSpaceModel::spread(const DamperInput& input, std::span<const double> state) const noexcept {
  const double mean = force(input, state) - offset_;
  std::array<double, GatedNetwork::kMaxSignals> signals;
  double squares = 0;
  for (const StateSpaceNetwork& member : members_) {
    member.cell.read(input, state.first(member.cell.size()), signals.data());
    const double apart = member.network.evaluate(signals.data()) - mean;
    squares += apart * apart;
    state = state.subspan(member.cell.size());
  }
  return is_ensemble() ? std::sqrt(squares / static_cast<double>(members_.size() - 1)) : 0;
}

std::unique_ptr<DamperModel> StateSpaceModel::with_offset(double newton) const {
  return std::make_unique<StateSpaceModel>(name_, members_, offset_ + newton);
}

}  // namespace dashpot
