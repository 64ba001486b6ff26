#include "dashpot/damper/kinds/hysteresis_network/hysteresis_network_model.h"
#include "dashpot/damper/nets/gated_network_json.h"

namespace dashpot {
namespace {

HysteresisNetwork read_hysteresis_network(const Value& value) {
  ObjectReader reader(value, "a member");
  HysteresisNetwork member;
  member.bank.path_rates = reader.required("path_rates").as_numbers();
  member.bank.velocity_rates = reader.required("velocity_rates").as_numbers();
  member.bank.current_rates = reader.required("current_rates").as_numbers();
  member.network = read_network(reader, member.bank.current_rates.size());
  reader.finish();
  return member;
}

}  // namespace

Value HysteresisNetwork::to_json() const {
  Value out = Value::object({{"path_rates", Value::array(bank.path_rates)},
                             {"velocity_rates", Value::array(bank.velocity_rates)},
                             {"current_rates", Value::array(bank.current_rates)}});
  add_network(out, network);
  return out;
}

std::unique_ptr<HysteresisNetworkModel> hysteresis_network_model_from_json(const Value& value) {
  return stateful_ensemble_from_json<HysteresisNetworkModel>(value, "a hysteresis network",
                                                             read_hysteresis_network);
}

}  // namespace dashpot
