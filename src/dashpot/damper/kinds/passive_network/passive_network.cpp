#include "dashpot/damper/kinds/passive_network/passive_network.h"

#include <algorithm>
#include <cmath>
#include <math.h>  // the C text says fabs, not std::fabs

#include "dashpot/damper/nets/tanh.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

// What the C text below asks for.

constexpr int PASSIVE_MOST_INPUTS = PassiveNetwork::kMaxInputs;
constexpr int PASSIVE_MOST_NEURONS = PassiveNetwork::kMaxNeurons;
constexpr int PASSIVE_MOST_SPRINGS = PassiveNetwork::kMaxSprings;
inline double tanh(double x) { return branchless_tanh(x); }

#include "dashpot/damper/c_text/passive_cell.h"

/// The network as the C text takes it.
PassiveCell cell_of(const PassiveNetwork& n) noexcept {
  const PassiveLayout at(n.sizes);
  const double* numbers = n.numbers.data();
  return {// Its build.
          .springs = static_cast<int>(n.sizes.springs),
          .memories = static_cast<int>(n.sizes.memories),
          .neurons = static_cast<int>(n.sizes.neurons),
          .viscous_neurons = static_cast<int>(n.sizes.viscous_neurons),
          .lags = n.lags ? 1 : 0,
          .inert = n.inert ? 1 : 0,

          // The scales of its signals, and the range of its data.
          .displacement_mean = n.displacement_mean,
          .displacement_gain = n.reads_displacement() ? 1 / n.displacement_scale : 0,
          .displacement_low = n.displacement_low,
          .displacement_high = n.displacement_high,
          .velocity_gain = 1 / n.velocity_scale,
          .velocity_low = n.velocity_low,
          .velocity_high = n.velocity_high,
          .drive_gain = 1 / n.drive_scale,
          .drive_low = n.drive_low,
          .drive_high = n.drive_high,
          .drive_fade = n.drive_fade,
          .force_scale = n.force_scale,

          // The numbers that training finds.
          .drive_rate = numbers[at.drive_rate],
          .saturation = numbers[at.saturation],
          .inertia = numbers[at.inertia],
          .inertia_rate = numbers[at.inertia_rate],
          .potential = numbers + at.potential,
          .stiffness = numbers + at.stiffness,
          .levers = numbers + at.levers,
          .memory_rates = numbers + at.memory_rates,
          .weights = numbers + at.weights,
          .gates = numbers + at.gates,
          .viscous_weights = numbers + at.viscous_weights,
          .viscous = numbers + at.viscous,
          .model_step = n.model_step};
}

}  // namespace

void PassiveNetwork::rest(const DamperInput& input, std::span<double> state) const noexcept {
  const PassiveCell cell = cell_of(*this);
  passive_rest(&cell, &input, state.data());
}

void PassiveNetwork::advance(const DamperInput& from, const DamperInput& to, double dt,
                             std::span<double> state) const noexcept {
  if (!(dt > 0)) return;
  const PassiveCell cell = cell_of(*this);
  passive_advance(&cell, &from, &to, dt, state.data());
}

void PassiveNetwork::flow(const DamperInput& input, std::span<const double> state,
                          std::span<double> rates) const noexcept {
  const PassiveCell c = cell_of(*this);
  const double velocity = input.velocity * c.velocity_gain;
  const double drive = passive_drive(&c, &input, state.data()), share = passive_share(&c, drive);
  double by_time[kMaxSprings], by_way[kMaxSprings], goals[kMaxInputs];
  passive_gates(&c, velocity, passive_displacement(&c, &input), drive, state.data(), by_time,
                by_way, goals);

  // The drive, the memories, the springs and the follower of the velocity, as they stand.
  if (lags) rates[0] = (input.current * c.drive_gain - state[0]) * c.drive_rate;
  std::size_t at = static_cast<std::size_t>(passive_memories_at(&c));
  for (std::size_t k = 0; k < sizes.memories; ++k, ++at)
    rates[at] = c.memory_rates[k] * (goals[k] - state[at]);
  for (std::size_t k = 0; k < sizes.springs; ++k, ++at) {
    const double speed = passive_lever(&c, static_cast<int>(k), share) * velocity;
    const double resistance = by_time[k] + std::abs(speed) * by_way[k];
    rates[at] = c.stiffness[k] * (speed - resistance * state[at]);
  }
  if (inert) rates[at] = c.inertia_rate * (velocity - state[at]);
}

double PassiveNetwork::force(const DamperInput& input,
                             std::span<const double> state) const noexcept {
  const PassiveCell cell = cell_of(*this);
  return passive_force(&cell, &input, state.data());
}

double PassiveNetwork::stored_energy(const DamperInput& input,
                                     std::span<const double> state) const noexcept {
  const PassiveCell c = cell_of(*this);
  const double* springs = &state[static_cast<std::size_t>(passive_springs_at(&c))];

  // The springs and the inertia, by the velocity's scale; the potential, by the displacement's.
  double moving = 0;
  for (std::size_t k = 0; k < sizes.springs; ++k)
    moving += springs[k] * springs[k] / (2 * c.stiffness[k]);
  if (inert && c.inertia_rate > 0) {
    const double follower = springs[sizes.springs];
    moving += c.inertia / c.inertia_rate * follower * follower / 2;
  }
  double energy = moving * velocity_scale;
  if (reads_displacement()) {
    const double x = passive_displacement(&c, &input);
    const double within = held(x, c.displacement_low, c.displacement_high), beyond = x - within;
    const double* p = c.potential;
    const double more = p[1] * std::exp(p[2] * within), less = p[3] * std::exp(-p[4] * within);
    // Of a exp(b x) the integral is a expm1(b x) / b, a x for b = 0.
    const auto integral = [](double size, double slope, double way) {
      return slope > 0 ? size * std::expm1(slope * way) / slope : size * way;
    };
    energy += displacement_scale *
              (p[0] * x * x / 2 + integral(p[1], p[2], within) + integral(p[3], p[4], -within) +
               beyond * ((more - less) + beyond * (p[2] * more + p[4] * less) / 2));
  }
  return force_scale * energy;
}

PassiveDrain PassiveNetwork::drain(const DamperInput& input,
                                   std::span<const double> state) const noexcept {
  const PassiveCell c = cell_of(*this);
  const double velocity = input.velocity * c.velocity_gain;
  const double displacement = passive_displacement(&c, &input);
  const double drive = passive_drive(&c, &input, state.data()), share = passive_share(&c, drive);
  double by_time[kMaxSprings], by_way[kMaxSprings], goals[kMaxInputs];
  passive_gates(&c, velocity, displacement, drive, state.data(), by_time, by_way, goals);

  // Each spring's resistance drains r s^2; of a mass what slips.
  PassiveDrain drain;
  const double* springs = &state[static_cast<std::size_t>(passive_springs_at(&c))];
  for (std::size_t k = 0; k < sizes.springs; ++k) {
    const double speed = passive_lever(&c, static_cast<int>(k), share) * velocity;
    drain.creep += by_time[k] * springs[k] * springs[k];
    drain.friction += std::abs(speed) * by_way[k] * springs[k] * springs[k];
  }
  drain.viscous =
      passive_viscosity(&c, velocity, displacement, drive, state.data()) * velocity * velocity;
  if (inert) {
    const double slip = velocity - springs[sizes.springs];
    drain.inertia = c.inertia * slip * slip;
  }

  const double watt = force_scale * velocity_scale;
  return {drain.creep * watt, drain.friction * watt, drain.viscous * watt, drain.inertia * watt};
}

void PassiveNetwork::require_sound(const std::string& where) const {
  const auto require_most = [&](std::size_t count, std::size_t least, std::size_t most,
                                const char* what) {
    if (count < least || count > most)
      throw Error(where, "has " + std::to_string(count) + " " + what,
                  std::to_string(least) + " to " + std::to_string(most));
  };
  require_most(sizes.springs, 1, kMaxSprings, "springs");
  require_most(sizes.memories, 0, kMaxMemories, "memories");
  require_most(sizes.neurons, 1, kMaxNeurons, "neurons");
  require_most(sizes.viscous_neurons, 1, kMaxNeurons, "neurons of the viscous term");

  // Scales are divided by, ranges go upwards.
  for (const double scale : {velocity_scale, drive_scale, force_scale, model_step})
    if (!(scale > 0) || !std::isfinite(scale))
      throw Error(where, "has a scale that is not positive");
  if (!(displacement_scale >= 0) || !std::isfinite(displacement_scale) ||
      !std::isfinite(displacement_mean))
    throw Error(where, "has a displacement scale that is negative or not finite");
  if (!(drive_fade >= 0) || !std::isfinite(drive_fade))
    throw Error(where, "has a fade of the drive that is negative or not finite");
  if (!(displacement_low <= displacement_high) || !(velocity_low <= velocity_high) ||
      !(drive_low <= drive_high))
    throw Error(where, "has a range that does not go upwards");

  // The numbers, of which those that passivity rests on are never negative.
  const PassiveLayout at(sizes);
  require_most(numbers.size(), at.count, at.count, "numbers");
  for (std::size_t k = 0; k < at.count; ++k)
    if (!std::isfinite(numbers[k]) || (k >= at.first_positive() && numbers[k] < 0))
      throw Error(where,
                  "number " + std::to_string(k + 1) + " of the passive network is " +
                      std::to_string(numbers[k]),
                  "a finite one, from " + std::to_string(at.first_positive() + 1) +
                      " on never negative: the network would generate energy");
  for (std::size_t k = 0; k < sizes.springs; ++k)
    if (!(numbers[at.stiffness + k] > 0)) throw Error(where, "a spring has no stiffness");
  if (!(numbers[at.saturation] > 0)) throw Error(where, "the drive's saturation is not positive");
  if (lags && !(numbers[at.drive_rate] > 0)) throw Error(where, "the drive's lag has no rate");
}

}  // namespace dashpot
