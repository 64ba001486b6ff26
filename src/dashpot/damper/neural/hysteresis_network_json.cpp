#include "dashpot/damper/neural/hysteresis_network.h"

namespace dashpot {
namespace {

Value to_json(const GatedNetwork::Signal& signal) {
  return Value::object(
      {{"mean", signal.mean}, {"scale", signal.scale}, {"low", signal.low}, {"high", signal.high}});
}

GatedNetwork::Signal read_signal(const Value& value) {
  ObjectReader reader(value, "a signal");
  const GatedNetwork::Signal signal{reader.number("mean"), reader.number("scale"), reader.number("low"),
                                    reader.number("high")};
  reader.finish();
  return signal;
}

Value to_json(const BankNetwork& member) {
  Value signals = Value::array();
  for (const GatedNetwork::Signal& signal : member.network.signals) signals.push_back(to_json(signal));
  return Value::object({{"path_rates", Value::array(member.bank.path_rates)},
                        {"velocity_rates", Value::array(member.bank.velocity_rates)},
                        {"current_rates", Value::array(member.bank.current_rates)},
                        {"signals", std::move(signals)},
                        {"neurons", Value::array(member.network.neurons)},
                        {"gates", Value::array(member.network.gates)},
                        {"output_scale", member.network.output_scale}});
}

BankNetwork read_member(const Value& value) {
  ObjectReader reader(value, "a member");
  BankNetwork member;
  member.bank.path_rates = reader.required("path_rates").as_numbers();
  member.bank.velocity_rates = reader.required("velocity_rates").as_numbers();
  member.bank.current_rates = reader.required("current_rates").as_numbers();
  for (const Value& item : reader.required("signals").items())
    member.network.signals.push_back(read_signal(item));
  member.network.currents = member.bank.current_rates.size();
  member.network.neurons = reader.required("neurons").as_numbers();
  member.network.gates = reader.required("gates").as_numbers();
  member.network.output_scale = reader.number("output_scale");
  reader.finish();
  return member;
}

}  // namespace

Value HysteresisNetwork::to_json() const {
  Value members = Value::array();
  for (const BankNetwork& member : members_) members.push_back(dashpot::to_json(member));
  return Value::object({{"name", name_}, {"members", std::move(members)}, {"offset", offset_}});
}

std::unique_ptr<HysteresisNetwork> hysteresis_network_from_json(const Value& value) {
  ObjectReader reader(value, "a state network");
  std::string name = reader.string("name");
  std::vector<BankNetwork> members;
  for (const Value& item : reader.required("members").items()) members.push_back(read_member(item));
  const double offset = reader.number("offset");
  reader.finish();
  return std::make_unique<HysteresisNetwork>(std::move(name), std::move(members), offset, value.where());
}

}  // namespace dashpot
