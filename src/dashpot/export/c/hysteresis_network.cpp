#include "dashpot/damper/kinds/hysteresis_network/hysteresis_network.h"

#include <algorithm>

#include "dashpot/damper/kinds/fuzzy/fuzzy_model.h"
#include "dashpot/damper/kinds/hybrid/hybrid_model.h"
#include "dashpot/damper/kinds/state_space/state_space_model.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_text.h"

namespace dashpot {
namespace {

std::string number(std::size_t count) { return std::to_string(count); }

/// The functions of a mean of members, each a source of signals (`part`, in the array `array`) and
/// a network that reads them.
constexpr const char* kMembers =
    R"(static void model_rest(const DamperInput* input, double* state) {
  int m, at = 0;
  for (m = 0; m < @count@; ++m) {
    @part@_rest(&@array@[m], input, &state[at]);
    at += @part@_size(&@array@[m]);
  }
}

static void model_advance(const DamperInput* from, const DamperInput* to, double dt, double* state) {
  int m, at = 0;
  for (m = 0; m < @count@; ++m) {
    @part@_advance(&@array@[m], from, to, dt, &state[at]);
    at += @part@_size(&@array@[m]);
  }
}

static double model_force(const DamperInput* input, const double* state) {
  double signals[GATED_MOST_SIGNALS], sum = 0;
  int m, at = 0;
  for (m = 0; m < @count@; ++m) {
    @part@_read(&@array@[m], input, &state[at], signals);
    sum += gated_evaluate(&kNetworks[m], signals, 0);
    at += @part@_size(&@array@[m]);
  }
  return (sum / @count@) + @offset@;
}

)";

std::string member_functions(const std::string& part, const std::string& array, std::size_t count,
                             double offset) {
  return filled(
      kMembers,
      {{"part", part}, {"array", array}, {"count", number(count)}, {"offset", c_number(offset)}});
}

std::string cell_tables(const StateSpaceCell& cell, const std::string& name) {
  std::vector<double> rates = cell.path_rates;
  rates.insert(rates.end(), cell.lag_rates.begin(), cell.lag_rates.end());
  rates.insert(rates.end(), cell.current_rates.begin(), cell.current_rates.end());
  return c_table(name + "Rates", rates) + c_table(name + "Neurons", cell.neurons) +
         c_table(name + "Feedback", cell.feedback);
}

std::string cell_entry(const StateSpaceCell& cell, const std::string& name) {
  std::string entry = "    {" + number(cell.path_rates.size()) + ", " +
                      number(cell.lag_rates.size()) + ", " + number(cell.currents()) + ", " +
                      number(cell.hidden()) + ", " + name + "Rates, ";
  for (const double value :
       {cell.velocity_scale, cell.velocity_low, cell.velocity_high, cell.current_mean,
        cell.current_scale, cell.current_low, cell.current_high})
    entry += c_number(value) + ", ";
  return entry + name + "Neurons, " + name + "Feedback, " + c_number(cell.model_step) + "},\n";
}

std::string cells(const std::vector<StateSpaceNetwork>& members) {
  std::size_t motions = 1, currents = 1, inputs = 1, features = 1;
  std::string tables, entries;
  for (std::size_t m = 0; m < members.size(); ++m) {
    const StateSpaceCell& cell = members[m].cell;
    const std::string name = "kCell" + number(m);
    motions = std::max(motions, cell.motions());
    currents = std::max(currents, cell.currents());
    inputs = std::max(inputs, cell.neuron_stride());
    features = std::max(features, cell.features());
    tables += cell_tables(cell, name);
    entries += cell_entry(cell, name);
  }
  return "#define CELL_MOST_CURRENTS " + number(currents) + "\n#define CELL_MOST_INPUTS " +
         number(inputs) + "\n#define CELL_MOST_FEATURES " + number(features) + "\n\n" +
         "#include \"state_space_cell.h\"\n" + tables +
         "static const StateSpaceCell kCells[] = {\n" + entries + "};\n\n";
}

}  // namespace

CModel c_hysteresis_network(const HysteresisNetwork& model) {
  std::vector<const HysteresisBank*> banks;
  std::vector<const GatedNetwork*> networks;
  for (const BankNetwork& member : model.members()) {
    banks.push_back(&member.bank);
    networks.push_back(&member.network);
  }
  return {c_banks(banks) + c_gated_networks(networks) +
          member_functions("bank", "kBanks", banks.size(), model.offset())};
}

CModel c_state_space(const StateSpaceModel& model) {
  std::vector<const GatedNetwork*> networks;
  for (const StateSpaceNetwork& member : model.members()) networks.push_back(&member.network);
  return {cells(model.members()) + c_gated_networks(networks) +
          member_functions("cell", "kCells", networks.size(), model.offset())};
}

CModel c_hybrid(const HybridModel& model) {
  const HybridSource& source = model.source();
  const std::size_t motions = source.motions(), law_states = source.law.state_size();
  std::string code = c_law(source.law, "law_model").code + c_banks({&source.bank}) +
                     c_gated_networks({&model.network()}) +
                     c_table("kMixingMean", model.mixing().mean) +
                     c_table("kMixingRows", model.mixing().rows) + "\n" + "#include \"mixing.h\"\n";
  // In the order of HybridSource::read.
  std::string read;
  const auto signal = [&](const std::string& value) {
    read += "  raw[count] = " + value + ";\n  ++count;\n";
  };
  signal("input->velocity");
  if (source.law.law().needs_displacement) signal("input->displacement");
  for (std::size_t k = 0; k < source.law.law().states.size(); ++k)
    signal("state[" + number(k) + "]");
  signal("law");
  for (std::size_t k = 0; k < source.bank.size(); ++k) {
    if (k + source.bank.current_rates.size() == source.bank.size()) break;
    signal("of_bank[" + number(k + 1) + "]");
  }
  signal(source.law.lag_rate() > 0 ? "state[" + number(source.law.law().states.size()) + "]"
                                   : "input->current");
  for (std::size_t k = source.bank.size() - source.bank.current_rates.size();
       k < source.bank.size(); ++k)
    signal("of_bank[" + number(k + 1) + "]");
  return {code + filled(R"(static void model_rest(const DamperInput* input, double* state) {
  law_model_rest(input, state);
  bank_rest(&kBanks[0], input, &state[@law_states@]);
}

static void model_advance(const DamperInput* from, const DamperInput* to, double dt, double* state) {
  law_model_advance(from, to, dt, state);
  bank_advance(&kBanks[0], from, to, dt, &state[@law_states@]);
}

static double model_force(const DamperInput* input, const double* state) {
  const double law = law_model_force(input, state);
  double raw[GATED_MOST_SIGNALS], mixed[GATED_MOST_SIGNALS], of_bank[GATED_MOST_SIGNALS];
  int count = 0;
  bank_read(&kBanks[0], input, &state[@law_states@], of_bank);
@read@  mixing_apply(kMixingMean, kMixingRows, @motions@, raw, mixed);
  for (count = @motions@; count < @signals@; ++count) {
    mixed[count] = raw[count];
  }
  return law + gated_evaluate(&kNetworks[0], mixed, 1) + @offset@;
}

)",
                        {{"law_states", number(law_states)},
                         {"read", read},
                         {"motions", number(motions)},
                         {"signals", number(model.network().signals.size())},
                         {"offset", c_number(model.offset())}})};
}

}  // namespace dashpot
