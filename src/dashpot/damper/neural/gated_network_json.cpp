#include "dashpot/damper/neural/gated_network.h"

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

}  // namespace

void GatedNetwork::add_to(Value& object) const {
  Value own = Value::array();
  for (const Signal& signal : signals) own.push_back(to_json(signal));
  object.add("signals", std::move(own));
  object.add("neurons", Value::array(neurons));
  object.add("gates", Value::array(gates));
  object.add("output_scale", output_scale);
}

GatedNetwork GatedNetwork::read(ObjectReader& reader, std::size_t currents) {
  GatedNetwork network;
  for (const Value& item : reader.required("signals").items()) network.signals.push_back(read_signal(item));
  network.currents = currents;
  network.neurons = reader.required("neurons").as_numbers();
  network.gates = reader.required("gates").as_numbers();
  network.output_scale = reader.number("output_scale");
  return network;
}

}  // namespace dashpot
