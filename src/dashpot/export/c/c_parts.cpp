#include <algorithm>

#include "dashpot/base/escape.h"
#include "dashpot/damper/nets/gated_network.h"
#include "dashpot/damper/nets/hysteresis_bank.h"
#include "dashpot/damper/nets/mlp.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_text.h"

namespace dashpot {
namespace {

std::vector<int> as_ints(const std::vector<std::size_t>& values) {
  return {values.begin(), values.end()};
}

std::string mlp_tables(const Mlp& mlp, const std::string& name) {
  std::vector<int> activations;
  for (std::size_t layer = 1; layer < mlp.layers.size(); ++layer)
    activations.push_back(static_cast<int>(mlp.activation(layer)));
  return c_table(name + "Layers", as_ints(mlp.layers)) +
         c_table(name + "Activations", activations) + c_table(name + "Parameters", mlp.parameters) +
         c_table(name + "Mean", mlp.input_mean) + c_table(name + "Scale", mlp.input_scale);
}

std::string mlp_entry(const Mlp& mlp, const std::string& name) {
  return "    {" + name + "Layers, " + std::to_string(mlp.layers.size()) + ", " + name +
         "Activations, " + name + "Parameters, " + name + "Mean, " + name + "Scale, " +
         c_number(mlp.output_mean) + ", " + c_number(mlp.output_scale) + "},\n";
}

std::string network_tables(const GatedNetwork& network, const std::string& name) {
  std::vector<double> mean, scale, low, high;
  for (const GatedNetwork::Signal& signal : network.signals) {
    mean.push_back(signal.mean);
    scale.push_back(signal.scale);
    low.push_back(signal.low);
    high.push_back(signal.high);
  }
  return c_table(name + "Mean", mean) + c_table(name + "Scale", scale) +
         c_table(name + "Low", low) + c_table(name + "High", high) +
         c_table(name + "Neurons", network.neurons) + c_table(name + "Gates", network.gates);
}

std::string network_entry(const GatedNetwork& network, const std::string& name) {
  return "    {" + std::to_string(network.signals.size()) + ", " +
         std::to_string(network.currents) + ", " + std::to_string(network.hidden()) + ", " + name +
         "Mean, " + name + "Scale, " + name + "Low, " + name + "High, " + name + "Neurons, " +
         name + "Gates, " + c_number(network.output_scale) + "},\n";
}

std::string array_of(const std::string& type, const std::string& name, const std::string& entries) {
  return "static const " + type + " " + name + "[] = {\n" + entries + "};\n\n";
}

}  // namespace

std::string c_table(const std::string& name, std::span<const double> values) {
  const double none[] = {0};
  return "static const double " + name + "[] = " + c_numbers(values.empty() ? none : values) +
         ";\n";
}

std::string c_table(const std::string& name, const std::vector<int>& values) {
  std::string list;
  for (const int value : values) list += (list.empty() ? "" : ", ") + std::to_string(value);
  return "static const int " + name + "[] = {" + (list.empty() ? "0" : list) + "};\n";
}

std::string c_mlps(std::span<const Mlp> members) {
  std::size_t widest = 1;
  std::string tables, entries;
  for (std::size_t m = 0; m < members.size(); ++m) {
    widest = std::max(widest, *std::ranges::max_element(members[m].layers));
    const std::string name = "kMlp" + std::to_string(m);
    tables += mlp_tables(members[m], name);
    entries += mlp_entry(members[m], name);
  }
  return "#define MLP_MOST_WIDTH " + std::to_string(widest) + "\n\n" + "#include \"mlp.h\"\n" +
         tables + array_of("Mlp", "kMlps", entries);
}

std::string c_gated_networks(const std::vector<const GatedNetwork*>& networks) {
  std::size_t signals = 1, gates = 1;
  std::string tables, entries;
  for (std::size_t m = 0; m < networks.size(); ++m) {
    signals = std::max(signals, networks[m]->signals.size());
    gates = std::max(gates, networks[m]->gate_count());
    const std::string name = "kNetwork" + std::to_string(m);
    tables += network_tables(*networks[m], name);
    entries += network_entry(*networks[m], name);
  }
  return "#define GATED_MOST_SIGNALS " + std::to_string(signals) + "\n#define GATED_MOST_GATES " +
         std::to_string(gates) + "\n\n" + "#include \"gated_network.h\"\n" + tables +
         array_of("GatedNetwork", "kNetworks", entries);
}

std::string c_banks(const std::vector<const HysteresisBank*>& banks) {
  std::string tables, entries;
  for (std::size_t m = 0; m < banks.size(); ++m) {
    const HysteresisBank& bank = *banks[m];
    const std::string name = "kBank" + std::to_string(m);
    tables += c_table(name + "Rates", bank.rates());
    entries += "    {" + name + "Rates, " + std::to_string(bank.path_rates.size()) + ", " +
               std::to_string(bank.velocity_rates.size()) + ", " +
               std::to_string(bank.current_rates.size()) + "},\n";
  }
  return "#include \"hysteresis_bank.h\"\n" + tables +
         array_of("HysteresisBank", "kBanks", entries);
}

std::string c_members(const std::string& part, const std::string& array, std::size_t count,
                      double offset) {
  return filled(
      R"(static void model_rest(const DamperInput* input, double* state) {
  int m, at = 0;
  for (m = 0; m < @count@; ++m) {
    @part@_rest(&@array@[m], input, &state[at]);
    at += @part@_size(&@array@[m]);
  }
}

static void model_advance(const DamperInput* from, const DamperInput* to, double dt,
                          double* state) {
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

)",
      {{"part", CText::own(part)},
       {"array", CText::own(array)},
       {"count", CText::own(std::to_string(count))},
       {"offset", CText::own(c_number(offset))}});
}

std::string c_stateless(const std::string& stem) {
  return filled(R"(static void @stem@_rest(const DamperInput* input, double* state) {
  (void)input;
  (void)state;
}

static void @stem@_advance(const DamperInput* from, const DamperInput* to, double dt,
                           double* state) {
  (void)from;
  (void)to;
  (void)dt;
  (void)state;
}

)",
                {{"stem", CText::own(stem)}});
}

}  // namespace dashpot
