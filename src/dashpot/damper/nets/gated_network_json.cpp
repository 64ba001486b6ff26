#include "dashpot/damper/nets/gated_network_json.h"

namespace dashpot {
namespace {

Value to_json(const GatedNetwork::Signal& signal) {
  return Value::object(
      {{"mean", signal.mean}, {"scale", signal.scale}, {"low", signal.low}, {"high", signal.high}});
}

GatedNetwork::Signal read_signal(const Value& value) {
  ObjectReader reader(value, "a signal");
  const GatedNetwork::Signal signal{reader.number("mean"), reader.number("scale"),
                                    reader.number("low"), reader.number("high")};
  reader.finish();
  return signal;
}

}  // namespace

void add_network(Value& member, const GatedNetwork& network) {
  Value signals = Value::array();
  for (const GatedNetwork::Signal& signal : network.signals) signals.push_back(to_json(signal));
  member.add("signals", std::move(signals));
  member.add("neurons", Value::array(network.neurons));
  member.add("gates", Value::array(network.gates));
  member.add("output_scale", network.output_scale);
}

GatedNetwork read_network(ObjectReader& member, std::size_t currents) {
  GatedNetwork network;
  for (const Value& item : member.required("signals").items())
    network.signals.push_back(read_signal(item));
  network.currents = currents;
  network.neurons = member.required("neurons").as_numbers();
  network.gates = member.required("gates").as_numbers();
  network.output_scale = member.number("output_scale");
  return network;
}

}  // namespace dashpot
