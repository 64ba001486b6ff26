#include "dashpot/damper/neural/gated_network_json.h"
#include "dashpot/damper/neural/hysteresis_network.h"

namespace dashpot {
namespace {

Value to_json(const BankNetwork& member) {
  Value out = Value::object({{"path_rates", Value::array(member.bank.path_rates)},
                             {"velocity_rates", Value::array(member.bank.velocity_rates)},
                             {"current_rates", Value::array(member.bank.current_rates)}});
  add_network(out, member.network);
  return out;
}

BankNetwork read_member(const Value& value) {
  ObjectReader reader(value, "a member");
  BankNetwork member;
  member.bank.path_rates = reader.required("path_rates").as_numbers();
  member.bank.velocity_rates = reader.required("velocity_rates").as_numbers();
  member.bank.current_rates = reader.required("current_rates").as_numbers();
  member.network = read_network(reader, member.bank.current_rates.size());
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
