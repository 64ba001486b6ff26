#include "dashpot/damper/neural/hysteresis_network.h"

#include <array>
#include <cmath>

#include "dashpot/base/error.h"

namespace dashpot {
namespace {

void require_sound(const BankNetwork& member, const std::string& where) {
  const HysteresisBank& bank = member.bank;
  bank.require_sound(where);
  if (const std::size_t lags = bank.current_rates.size(); lags < 1 || lags > GatedNetwork::kMaxCurrents)
    throw Error(where, "has " + std::to_string(lags) + " current rates",
                "1 to " + std::to_string(GatedNetwork::kMaxCurrents));
  if (bank.signal_count() > GatedNetwork::kMaxSignals)
    throw Error(where, "has " + std::to_string(bank.size()) + " rates",
                "at most " + std::to_string(GatedNetwork::kMaxSignals - 1));
  member.network.require_sound(bank.signal_count(), where);
}

}  // namespace

HysteresisNetwork::HysteresisNetwork(std::string name, std::vector<BankNetwork> members, double offset,
                                     const std::string& where)
    : name_(std::move(name)), members_(std::move(members)), offset_(offset) {
  const std::string& place = where.empty() ? name_ : where;
  if (members_.empty()) throw Error(place, "has no members", "a bank of states and its network at least");
  for (const BankNetwork& member : members_) {
    require_sound(member, place);
    state_size_ += member.bank.size();
  }
}

std::size_t HysteresisNetwork::parameter_count() const noexcept {
  std::size_t count = 0;
  for (const BankNetwork& member : members_) count += member.parameter_count();
  return count;
}

void HysteresisNetwork::rest(const DamperInput& input, std::span<double> state) const noexcept {
  for (const BankNetwork& member : members_) {
    member.bank.rest(input, state.first(member.bank.size()));
    state = state.subspan(member.bank.size());
  }
}

void HysteresisNetwork::advance(const DamperInput& from, const DamperInput& to, double dt,
                                std::span<double> state) const noexcept {
  for (const BankNetwork& member : members_) {
    member.bank.advance(from, to, dt, state.first(member.bank.size()));
    state = state.subspan(member.bank.size());
  }
}

double HysteresisNetwork::force(const DamperInput& input, std::span<const double> state) const noexcept {
  std::array<double, GatedNetwork::kMaxSignals> signals;
  double sum = 0;
  for (const BankNetwork& member : members_) {
    member.bank.read(input, state.first(member.bank.size()), signals.data());
    sum += member.network.evaluate(signals.data());
    state = state.subspan(member.bank.size());
  }
  return sum / static_cast<double>(members_.size()) + offset_;
}

double HysteresisNetwork::flow(const DamperInput& input, std::span<const double> state,
                               std::span<double> rates) const noexcept {
  std::size_t place = 0;
  for (const BankNetwork& member : members_) {
    const std::size_t size = member.bank.size();
    member.bank.flow(input, state.subspan(place, size), rates.subspan(place, size));
    place += size;
  }
  return force(input, state);
}

double HysteresisNetwork::spread(const DamperInput& input, std::span<const double> state) const noexcept {
  const double mean = force(input, state) - offset_;
  std::array<double, GatedNetwork::kMaxSignals> signals;
  double squares = 0;
  for (const BankNetwork& member : members_) {
    member.bank.read(input, state.first(member.bank.size()), signals.data());
    const double apart = member.network.evaluate(signals.data()) - mean;
    squares += apart * apart;
    state = state.subspan(member.bank.size());
  }
  return is_ensemble() ? std::sqrt(squares / static_cast<double>(members_.size() - 1)) : 0;
}

std::unique_ptr<DamperModel> HysteresisNetwork::with_offset(double newton) const {
  return std::make_unique<HysteresisNetwork>(name_, members_, offset_ + newton);
}

}  // namespace dashpot
