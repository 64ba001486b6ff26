#include "dashpot/damper/kinds/state_space/state_space_cell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "dashpot/base/random.h"
#include "dashpot/damper/lag.h"
#include "dashpot/damper/nets/kernel.h"
#include "dashpot/damper/nets/tanh.h"

namespace dashpot {
namespace {

constexpr double kBend = 3;  // rates change by a factor of e^3 at most

double* add_scaled(const double* from, std::size_t count, double factor, double* to) noexcept {
  for (std::size_t k = 0; k < count; ++k) to[k] += factor * from[k];
  return to + count;
}

}  // namespace

/// All that a step makes of inputs and states, and what its derivatives need.
struct StateSpaceCell::Point {
  std::array<double, kMaxInputs> inputs;        ///< x, y, v, u, 1
  std::array<double, kMaxFeatures> phi;         ///< 1, x, u, neurons
  std::array<double, kMaxMotions> speed, bend;  ///< w; tanh(G phi / bend)
  /// Derivatives of a state's new value by its old one, by w, by ln r.
  std::array<double, kMaxMotions> by_state, by_speed, by_rate;
};

StateSpaceCell::Slopes::Slopes(const StateSpaceCell& cell, std::size_t more_unknowns)
    : columns(cell.parameter_count() + more_unknowns),
      step(padded<double>(columns)),
      motions(cell.motions() * step),
      scratch(motions.size()),
      currents(cell.currents()),
      kernel(jacobian_kernel(simd_levels().back())) {}

std::vector<double> StateSpaceCell::parameters() const {
  std::vector<double> all;
  for (const std::vector<double>* rates : {&path_rates, &lag_rates, &current_rates})
    for (const double rate : *rates) all.push_back(std::log(rate));
  all.insert(all.end(), neurons.begin(), neurons.end());
  all.insert(all.end(), feedback.begin(), feedback.end());
  return all;
}

void StateSpaceCell::set_parameters(const double* parameters) {
  for (std::vector<double>* rates : {&path_rates, &lag_rates, &current_rates})
    for (double& rate : *rates) rate = std::exp(*parameters++);
  for (double& weight : neurons) weight = *parameters++;
  for (double& weight : feedback) weight = *parameters++;
}

void StateSpaceCell::initialise(std::size_t hidden_neurons, std::uint64_t seed) {
  Random random(seed);
  const double reach = 1 / std::sqrt(static_cast<double>(neuron_stride()));
  neurons.resize(hidden_neurons * neuron_stride());
  for (double& weight : neurons) weight = random.normal() * reach;
  feedback.assign(2 * motions() * features(), 0.0);
}

void StateSpaceCell::look(double velocity, const double* currents_now, const double* state,
                          Point& at) const noexcept {
  const std::size_t paths = path_rates.size();
  double* input = std::copy_n(state, motions(), at.inputs.begin());
  *input++ = std::clamp(velocity, velocity_low, velocity_high);
  double* const held = input;
  for (std::size_t m = 0; m < currents(); ++m)
    *input++ = std::clamp(currents_now[m], current_low, current_high);
  *input = 1;

  double* feature = at.phi.data();
  *feature++ = 1;
  feature = std::copy_n(state, paths, feature);
  feature = std::copy_n(held, currents(), feature);
  double* const tanhs = feature;
  for (const double *w = neurons.data(), *end = w + neurons.size(); w != end; w += neuron_stride())
    *feature++ = std::inner_product(w, w + neuron_stride(), at.inputs.begin(), 0.0);
  branchless_tanh(tanhs, hidden());

  const double* weights = feedback.data();
  const auto next = [&] {
    const double sum = std::inner_product(weights, weights + features(), at.phi.begin(), 0.0);
    weights += features();
    return sum;
  };
  for (std::size_t k = 0; k < motions(); ++k) at.speed[k] = velocity + next();
  for (std::size_t k = 0; k < motions(); ++k) at.bend[k] = next() / kBend;
  branchless_tanh(at.bend.data(), motions());
}

void StateSpaceCell::step(double h, Point& at, double* state) const noexcept {
  const std::size_t paths = path_rates.size();
  for (std::size_t k = 0; k < motions(); ++k) {
    const double w = at.speed[k], x = state[k];
    const double turn =
        h * (k < paths ? path_rates[k] : lag_rates[k - paths]) * std::exp(kBend * at.bend[k]);
    const double reach = k < paths ? turn * std::abs(w) : turn;
    const double goal = k < paths ? (w < 0 ? -1 : 1) : w;
    const double kept = std::exp(-reach);
    state[k] = goal * (1 - kept) + x * kept;
    at.by_state[k] = kept;
    at.by_speed[k] = k < paths ? turn * kept * (1 - goal * x) : 1 - kept;
    at.by_rate[k] = reach * kept * (goal - x);
  }
}

void StateSpaceCell::step_slopes(const Point& at, const double* current_slopes,
                                 Slopes& slopes) const noexcept {
  const std::size_t n = motions(), paths = path_rates.size(), width = features(),
                    stride = neuron_stride();
  const std::size_t neurons_at = 1 + paths + currents();
  // What each state depends on through one step: features, and by them the states and inputs
  // before.
  std::array<double, kMaxMotions> by_bend;
  std::array<std::array<double, kMaxFeatures>, kMaxMotions> by_phi;
  std::array<std::array<double, kMaxInputs>, kMaxMotions> by_input;
  for (std::size_t k = 0; k < n; ++k) {
    by_bend[k] = at.by_rate[k] * (1 - at.bend[k] * at.bend[k]);
    const double *b = &feedback[k * width], *g = &feedback[(n + k) * width];
    double *phi = by_phi[k].data(), *input = by_input[k].data();
    std::fill_n(input, stride, 0.0);
    for (std::size_t f = 0; f < width; ++f) phi[f] = at.by_speed[k] * b[f] + by_bend[k] * g[f];
    for (std::size_t j = 0; j < hidden(); ++j) {
      const double t = at.phi[neurons_at + j];
      phi[neurons_at + j] *= 1 - t * t;
      add_scaled(&neurons[j * stride], stride, phi[neurons_at + j], input);
    }
    for (std::size_t l = 0; l < paths; ++l) input[l] += phi[1 + l];
    for (std::size_t m = 0; m < currents(); ++m) input[n + 1 + m] += phi[1 + paths + m];
    input[k] += at.by_state[k];
  }

  // The slopes of the states before, carried on; then what the step's own parameters add.
  slopes.motions.swap(slopes.scratch);
  slopes.kernel.carry(n, slopes.step, by_input[0].data(), kMaxInputs, slopes.scratch.data(),
                      slopes.motions.data());
  for (std::size_t k = 0; k < n; ++k) {
    double* row = slopes.motion(k);
    row[k] += at.by_rate[k];
    for (std::size_t m = 0; m < currents(); ++m)
      row[n + m] += by_input[k][n + 1 + m] * current_slopes[m];
    row += size();
    for (std::size_t j = 0; j < hidden(); ++j)
      row = add_scaled(at.inputs.data(), stride, by_phi[k][neurons_at + j], row);
    add_scaled(at.phi.data(), width, at.by_speed[k], row + k * width);
    add_scaled(at.phi.data(), width, by_bend[k], row + (n + k) * width);
  }
}

void StateSpaceCell::advance(const DamperInput& from, const DamperInput& to, double dt,
                             std::span<double> state, Slopes* slopes) const noexcept {
  if (!(dt > 0)) return;
  const double most = static_cast<double>(kMaxSteps);
  const double steps = std::clamp(std::ceil(dt / model_step * (1 - 1e-9)), 1.0, most),
               h = dt / steps;
  const auto between = [&](double a, double b, double share) { return a + (b - a) * share; };

  // Currents and velocity are linear over dt; the cell sees their means over each of its steps.
  const std::span<double> lagged = state.subspan(motions(), currents());
  std::array<double, kMaxCurrents> middle, middle_slopes{};
  Point at;
  for (double s = 0; s < steps; ++s) {
    const double begin =
        (between(from.current, to.current, s / steps) - current_mean) / current_scale;
    const double end =
        (between(from.current, to.current, (s + 1) / steps) - current_mean) / current_scale;
    for (std::size_t m = 0; m < currents(); ++m) {
      double* slope = slopes ? &slopes->currents[m] : nullptr;
      middle[m] = lagged[m] / 2;
      if (slope) middle_slopes[m] = *slope / 2;
      advance_lag(begin, end, current_rates[m] * h, lagged[m], slope);
      middle[m] += lagged[m] / 2;
      if (slope) middle_slopes[m] += *slope / 2;
    }

    // Then the states of the motion, at the velocity of the middle.
    const double velocity = between(from.velocity, to.velocity, (s + 0.5) / steps) / velocity_scale;
    look(velocity, middle.data(), state.data(), at);
    step(h, at, state.data());
    if (slopes) step_slopes(at, middle_slopes.data(), *slopes);
  }
}

void StateSpaceCell::flow(const DamperInput& input, std::span<const double> state,
                          std::span<double> rates) const noexcept {
  const std::size_t paths = path_rates.size(), n = motions();
  Point at;
  look(input.velocity / velocity_scale, &state[n], state.data(), at);
  for (std::size_t k = 0; k < n; ++k) {
    const double rate =
        (k < paths ? path_rates[k] : lag_rates[k - paths]) * std::exp(kBend * at.bend[k]);
    rates[k] = rate * (at.speed[k] - (k < paths ? std::abs(at.speed[k]) : 1) * state[k]);
  }
  for (std::size_t m = 0; m < currents(); ++m)
    rates[n + m] =
        current_rates[m] * ((input.current - current_mean) / current_scale - state[n + m]);
}

void StateSpaceCell::rest(const DamperInput& input, std::span<double> state,
                          Slopes* slopes) const noexcept {
  constexpr int kSteps = 32;
  constexpr double kGrowth = 1.5;  // to some 10^6 model steps in all
  std::fill_n(state.begin(), motions(), 0.0);
  std::fill_n(state.begin() + static_cast<std::ptrdiff_t>(motions()), currents(),
              (input.current - current_mean) / current_scale);

  // Standing still, let the states settle in ever longer steps.
  const std::array<double, kMaxCurrents> no_slopes{};
  Point at;
  double h = model_step;
  for (int k = 0; k < kSteps; ++k, h *= kGrowth) {
    look(0, &state[motions()], state.data(), at);
    step(h, at, state.data());
    if (slopes) step_slopes(at, no_slopes.data(), *slopes);
  }
}

void StateSpaceCell::read(const DamperInput& input, std::span<const double> state,
                          double* signals) const noexcept {
  *signals++ = input.velocity;
  for (std::size_t k = 0; k < path_rates.size(); ++k) *signals++ = state[k];
  for (std::size_t k = path_rates.size(); k < motions(); ++k)
    *signals++ = input.velocity / velocity_scale - state[k];
  for (std::size_t k = motions(); k < size(); ++k) *signals++ = state[k];
}

}  // namespace dashpot
