#include "dashpot/damper/kinds/hybrid/hybrid_model.h"
#include "dashpot/damper/nets/gated_network_json.h"

namespace dashpot {

Value HybridModel::to_json() const {
  Value value = Value::object({{"law", law().to_json()},
                               {"path_rates", Value::array(source_.bank.path_rates)},
                               {"velocity_rates", Value::array(source_.bank.velocity_rates)},
                               {"current_rates", Value::array(source_.bank.current_rates)},
                               {"means", Value::array(mixing_.mean)},
                               {"mixing", Value::array(mixing_.rows)}});
  add_network(value, network_);
  value.add("offset", offset_);
  return value;
}

std::unique_ptr<HybridModel> hybrid_model_from_json(const Value& value) {
  ObjectReader reader(value, "a hybrid model");
  const std::unique_ptr<LawModel> law = law_model_from_json(reader.required("law"));
  HysteresisBank bank{reader.required("path_rates").as_numbers(),
                      reader.required("velocity_rates").as_numbers(),
                      reader.required("current_rates").as_numbers()};
  SignalMixing mixing{reader.required("means").as_numbers(),
                      reader.required("mixing").as_numbers()};
  GatedNetwork network = read_network(reader, 1 + bank.current_rates.size());
  const double offset = reader.number("offset");
  reader.finish();
  return std::make_unique<HybridModel>(HybridSource{*law, std::move(bank)}, std::move(mixing),
                                       std::move(network), offset, value.where());
}

}  // namespace dashpot
