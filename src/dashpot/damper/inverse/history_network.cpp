#include "dashpot/damper/inverse/history_network.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "dashpot/base/text.h"
#include "dashpot/damper/nets/mlp_json.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr std::array<std::string_view, 4> kSignalNames{"displacement", "velocity", "force",
                                                       "current"};
constexpr auto kCurrent = static_cast<std::size_t>(Tap::Signal::Current);

bool is_range(double low, double high) {
  return std::isfinite(low) && std::isfinite(high) && low < high;
}

InverseNetwork usable(InverseNetwork network) {
  require_usable(network, network.name);
  return network;
}

}  // namespace

std::string_view name_of(Tap::Signal signal) {
  return kSignalNames[static_cast<std::size_t>(signal)];
}

Tap::Signal tap_signal_named(std::string_view name, const std::string& where) {
  const auto found = std::ranges::find(kSignalNames, name);
  if (found == kSignalNames.end())
    throw Error(where, "unknown signal '" + std::string(name) + "'",
                suggest(name, {kSignalNames.begin(), kSignalNames.end()}));
  return static_cast<Tap::Signal>(found - kSignalNames.begin());
}

bool InverseNetwork::feeds_back() const {
  return std::ranges::any_of(taps,
                             [](const Tap& tap) { return tap.signal == Tap::Signal::Current; });
}

std::size_t InverseNetwork::stride(double sample_time) const {
  constexpr double kSlack = 0.05;
  const double samples = std::round(spacing / sample_time);
  if (!(samples >= 1 && std::abs(samples * sample_time - spacing) <= kSlack * spacing))
    throw Error(name, "looks back in steps of " + format_number(1000 * spacing) + " ms",
                "take a sample time of which they are a whole multiple, not " +
                    format_number(1000 * sample_time) + " ms");
  return static_cast<std::size_t>(samples);
}

void require_usable(const InverseNetwork& network, const std::string& where) {
  const auto& [name, taps, spacing, current_min, current_max, rate_max, mlp] = network;
  for (const Tap& tap : taps) {
    const int least = tap.signal == Tap::Signal::Current ? 1 : 0;
    if (tap.delay < least || tap.delay > InverseNetwork::kMostDelay)
      throw Error(where,
                  "a delay of " + std::to_string(tap.delay) + " steps of the " +
                      std::string(name_of(tap.signal)),
                  std::to_string(least) + " to " + std::to_string(InverseNetwork::kMostDelay));
  }

  if (!(spacing >= 1e-5 && spacing <= 1))
    throw Error(where, "its step is not between 1e-5 and 1 s");
  if (!is_range(current_min, current_max)) throw Error(where, "its currents are no range");
  if (!(rate_max >= 0 && std::isfinite(rate_max))) throw Error(where, "its rate limit is below 0");
  require_shape(mlp, taps.size(), where);
}

HistoryNetwork::HistoryNetwork(InverseNetwork network, const InverseLimits& limits)
    : InverseModel(limits),
      network_(usable(std::move(network))),
      evaluator_(network_.mlp),
      low_(std::max(limits.current_min, network_.current_min)),
      high_(std::min(limits.current_max, network_.current_max)),
      most_change_(network_.rate_max > 0 ? network_.rate_max * limits.sample_time
                                         : std::numeric_limits<double>::infinity()) {
  if (!(low_ < high_))
    throw Error(network_.name, "was taught currents of " + format_number(network_.current_min) +
                                   " ... " + format_number(network_.current_max) +
                                   ", none of which the driver gives");

  // Where each tap lies in the state, which keeps one row of signals per sample, newest first.
  const std::size_t stride = network_.stride(limits.sample_time);
  for (const Tap& tap : network_.taps) {
    const std::size_t row = static_cast<std::size_t>(tap.delay) * stride;
    places_.push_back(row * kSignals + static_cast<std::size_t>(tap.signal));
    rows_ = std::max(rows_, row + 1);
  }
}

void HistoryNetwork::rest(const DamperInput& input, std::span<double> state) const noexcept {
  const std::array row{input.displacement, 0.0, 0.0, std::clamp(input.current, low_, high_)};
  for (std::size_t k = 0; k < rows_; ++k) std::ranges::copy(row, state.begin() + k * kSignals);
}

double HistoryNetwork::wanted_current(const InverseInput& input,
                                      std::span<double> state) const noexcept {
  std::copy_backward(state.begin(), state.end() - kSignals, state.end());

  const double last = state[kSignals + kCurrent];
  const std::array row{input.displacement, input.velocity, input.wanted, last};
  std::ranges::copy(row, state.begin());

  std::array<double, Mlp::kMaxWidth> inputs;
  for (std::size_t k = 0; k < places_.size(); ++k) inputs[k] = state[places_[k]];

  // Within the currents that it was taught, and no further from the last one than the rate allows.
  double current = evaluator_.evaluate(inputs.data());
  current = current > low_ ? std::min(current, high_) : low_;  // NaN becomes the least
  return state[kCurrent] = std::clamp(current, last - most_change_, last + most_change_);
}

}  // namespace dashpot
