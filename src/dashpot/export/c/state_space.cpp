#include <algorithm>

#include "dashpot/damper/kinds/state_space/state_space_model.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_text.h"

namespace dashpot {
namespace {

std::string cell_tables(const StateSpaceCell& cell, const std::string& name) {
  std::vector<double> rates = cell.path_rates;
  rates.insert(rates.end(), cell.lag_rates.begin(), cell.lag_rates.end());
  rates.insert(rates.end(), cell.current_rates.begin(), cell.current_rates.end());
  return c_table(name + "Rates", rates) + c_table(name + "Neurons", cell.neurons) +
         c_table(name + "Feedback", cell.feedback);
}

std::string cell_entry(const StateSpaceCell& cell, const std::string& name) {
  std::string entry = "    {" + std::to_string(cell.path_rates.size()) + ", " +
                      std::to_string(cell.lag_rates.size()) + ", " +
                      std::to_string(cell.currents()) + ", " + std::to_string(cell.hidden()) +
                      ", " + name + "Rates, ";
  for (const double value :
       {cell.velocity_scale, cell.velocity_low, cell.velocity_high, cell.current_mean,
        cell.current_scale, cell.current_low, cell.current_high})
    entry += c_number(value) + ", ";
  return entry + name + "Neurons, " + name + "Feedback, " + c_number(cell.model_step) + "},\n";
}

std::string cells(const std::vector<StateSpaceNetwork>& members) {
  std::size_t currents = 1, inputs = 1, features = 1;

  // A table and a row per member; the text keeps room for the largest.
  std::string tables, entries;
  for (std::size_t m = 0; m < members.size(); ++m) {
    const StateSpaceCell& cell = members[m].cell;
    const std::string name = "kCell" + std::to_string(m);
    currents = std::max(currents, cell.currents());
    inputs = std::max(inputs, cell.neuron_stride());
    features = std::max(features, cell.features());
    tables += cell_tables(cell, name);
    entries += cell_entry(cell, name);
  }

  return "#define CELL_MOST_CURRENTS " + std::to_string(currents) + "\n#define CELL_MOST_INPUTS " +
         std::to_string(inputs) + "\n#define CELL_MOST_FEATURES " + std::to_string(features) +
         "\n\n" + "#include \"state_space_cell.h\"\n" + tables +
         "static const StateSpaceCell kCells[] = {\n" + entries + "};\n\n";
}

}  // namespace

CModel c_state_space(const StateSpaceModel& model) {
  std::vector<const GatedNetwork*> networks;
  for (const StateSpaceNetwork& member : model.members()) networks.push_back(&member.network);
  return {cells(model.members()) + c_gated_networks(networks) +
          c_members("cell", "kCells", networks.size(), model.offset())};
}

}  // namespace dashpot
