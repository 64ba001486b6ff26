#include "dashpot/damper/kinds/state_space/state_space_model.h"
#include "dashpot/damper/nets/gated_network_json.h"

namespace dashpot {
namespace {

Value cell_to_json(const StateSpaceCell& cell) {
  return Value::object({{"path_rates", Value::array(cell.path_rates)},
                        {"lag_rates", Value::array(cell.lag_rates)},
                        {"current_rates", Value::array(cell.current_rates)},
                        {"velocity_scale", cell.velocity_scale},
                        {"velocity_range", range_value(cell.velocity_low, cell.velocity_high)},
                        {"current_mean", cell.current_mean},
                        {"current_scale", cell.current_scale},
                        {"current_range", range_value(cell.current_low, cell.current_high)},
                        {"neurons", Value::array(cell.neurons)},
                        {"feedback", Value::array(cell.feedback)},
                        {"model_step", cell.model_step}});
}

StateSpaceCell read_cell(const Value& value) {
  ObjectReader reader(value, "a cell");
  StateSpaceCell cell;
  cell.path_rates = reader.required("path_rates").as_numbers();
  cell.lag_rates = reader.required("lag_rates").as_numbers();
  cell.current_rates = reader.required("current_rates").as_numbers();
  cell.velocity_scale = reader.number("velocity_scale");
  read_range(reader, "velocity_range", cell.velocity_low, cell.velocity_high);
  cell.current_mean = reader.number("current_mean");
  cell.current_scale = reader.number("current_scale");
  read_range(reader, "current_range", cell.current_low, cell.current_high);

  // The weights, and the longest step.
  cell.neurons = reader.required("neurons").as_numbers();
  cell.feedback = reader.required("feedback").as_numbers();
  cell.model_step = reader.number("model_step");
  reader.finish();
  return cell;
}

StateSpaceNetwork read_state_space_network(const Value& value) {
  ObjectReader reader(value, "a member");
  StateSpaceNetwork member;
  member.cell = read_cell(reader.required("cell"));
  member.network = read_network(reader, member.cell.currents());
  reader.finish();
  return member;
}

}  // namespace

Value StateSpaceNetwork::to_json() const {
  Value out = Value::object({{"cell", cell_to_json(cell)}});
  add_network(out, network);
  return out;
}

std::unique_ptr<StateSpaceModel> state_space_model_from_json(const Value& value) {
  return stateful_ensemble_from_json<StateSpaceModel>(value, "a state-space model",
                                                      read_state_space_network);
}

}  // namespace dashpot
