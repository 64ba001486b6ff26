#include "dashpot/damper/kinds/hybrid/hybrid_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/damper/kinds/hybrid/presets.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

void require_count(std::size_t count, std::size_t right, const std::string& what,
                   const std::string& where) {
  if (count != right)
    throw Error(where, "has " + std::to_string(count) + " " + what,
                "its law and bank need " + std::to_string(right));
}

}  // namespace

void HybridSource::rest(const DamperInput& input, std::span<double> state) const noexcept {
  law.rest(input, state.first(law.state_size()));
  bank.rest(input, state.subspan(law.state_size()));
}

void HybridSource::advance(const DamperInput& from, const DamperInput& to, double dt,
                           std::span<double> state) const noexcept {
  law.advance(from, to, dt, state.first(law.state_size()));
  bank.advance(from, to, dt, state.subspan(law.state_size()));
}

void HybridSource::read(const DamperInput& input, std::span<const double> state,
                        double* signals) const noexcept {
  std::array<double, SignalMixing::kMost> of_bank;
  bank.read(input, state.subspan(law.state_size()), of_bank.data());
  const double* const own = &of_bank[1];  // behind the velocity
  const double* const lags = own + bank.size() - bank.current_rates.size();
  *signals++ = input.velocity;
  if (law.law().needs_displacement) *signals++ = input.displacement;
  signals = std::copy_n(state.begin(), law.law().states.size(), signals);
  *signals++ = law.force(input, state);
  signals = std::copy(own, lags, signals);
  *signals++ = law.coil_current(input, state);
  std::copy(lags, own + bank.size(), signals);
}

void SignalMixing::apply(const double* raw, double* mixed) const noexcept {
  std::array<double, SignalMixing::kMost> centred;
  for (std::size_t k = 0; k < mean.size(); ++k) centred[k] = raw[k] - mean[k];
  apply_to_change(centred.data(), mixed);
}

void SignalMixing::apply_to_change(const double* change, double* mixed) const noexcept {
  const double* weight = rows.data();
  for (std::size_t k = 0; k < mean.size(); ++k) {
    double sum = 0;
    for (std::size_t j = 0; j <= k; ++j) sum += *weight++ * change[j];
    mixed[k] = sum;
  }
}

HybridModel::HybridModel(HybridSource source, SignalMixing mixing, GatedNetwork network,
                         double offset, const std::string& where)
    : source_(std::move(source)),
      mixing_(std::move(mixing)),
      network_(std::move(network)),
      offset_(offset) {
  const std::string place = where.empty() ? name() : where;
  const std::size_t motions = source_.motions(), currents = source_.currents();
  source_.bank.require_sound(place);
  if (currents > GatedNetwork::kMaxCurrents || motions + currents > GatedNetwork::kMaxSignals)
    throw Error(place, "has more states in its bank than a network reads");
  require_count(mixing_.mean.size(), motions, "means of signals", place);
  require_count(mixing_.rows.size(), motions * (motions + 1) / 2, "weights of signals", place);
  network_.require_sound(motions + currents, place);
}

std::string HybridModel::name() const { return hybrid_name(law().law().name); }

std::size_t HybridModel::parameter_count() const noexcept {
  return law().parameter_count() + network_.parameter_count();
}

void HybridModel::rest(const DamperInput& input, std::span<double> state) const noexcept {
  source_.rest(input, state);
}

void HybridModel::advance(const DamperInput& from, const DamperInput& to, double dt,
                          std::span<double> state) const noexcept {
  source_.advance(from, to, dt, state);
}

double HybridModel::force(const DamperInput& input, std::span<const double> state) const noexcept {
  std::array<double, SignalMixing::kMost> raw, mixed;
  source_.read(input, state, raw.data());
  mixing_.apply(raw.data(), mixed.data());
  std::copy(&raw[source_.motions()], &raw[network_.signals.size()], &mixed[source_.motions()]);
  return raw[source_.force_place()] + network_.evaluate_held(mixed.data()) + offset_;
}

double HybridModel::flow(const DamperInput& input, std::span<const double> state,
                         std::span<double> rates) const noexcept {
  const std::size_t of_law = law().state_size();
  law().flow(input, state.first(of_law), rates.first(of_law));
  source_.bank.flow(input, state.subspan(of_law), rates.subspan(of_law));
  return force(input, state);
}

std::unique_ptr<DamperModel> HybridModel::with_offset(double newton) const {
  return std::make_unique<HybridModel>(source_, mixing_, network_, offset_ + newton);
}

}  // namespace dashpot
