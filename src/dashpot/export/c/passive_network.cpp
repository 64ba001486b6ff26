#include <algorithm>
#include <array>

#include "dashpot/base/escape.h"
#include "dashpot/damper/kinds/passive_network/passive_network_model.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_text.h"

namespace dashpot {
namespace {

/// A table per part of a member's numbers, and the row of the array that points to them.
struct Member {
  std::string tables, row;
};

Member member_text(const PassiveNetwork& n, const std::string& name) {
  const PassiveLayout at(n.sizes);
  Member text;
  const auto table = [&](const char* part, std::size_t first, std::size_t end) {
    text.tables += c_table(name + part, std::span(n.numbers).subspan(first, end - first));
    return name + part + ", ";
  };
  const auto number = [](double value) { return c_number(value) + ", "; };
  const auto count = [](std::size_t value) { return std::to_string(value) + ", "; };

  // In the order of the struct's fields.
  text.row = "    {" + count(n.sizes.springs) + count(n.sizes.memories) + count(n.sizes.neurons) +
             count(n.sizes.viscous_neurons) + count(n.lags ? 1 : 0) + count(n.inert ? 1 : 0);
  for (const double value :
       {n.displacement_mean, n.reads_displacement() ? 1 / n.displacement_scale : 0,
        n.displacement_low, n.displacement_high, 1 / n.velocity_scale, n.velocity_low,
        n.velocity_high, 1 / n.drive_scale, n.drive_low, n.drive_high, n.drive_fade, n.force_scale,
        n.numbers[at.drive_rate], n.numbers[at.saturation], n.numbers[at.inertia],
        n.numbers[at.inertia_rate]})
    text.row += number(value);
  text.row += table("Potential", at.potential, at.drive_rate);
  text.row += table("Stiffness", at.stiffness, at.memory_rates);
  text.row += table("Levers", at.levers, at.stiffness);
  text.row += table("MemoryRates", at.memory_rates, at.saturation);
  text.row += table("Weights", at.weights, at.gates);
  text.row += table("Gates", at.gates, at.viscous_weights);
  text.row += table("ViscousWeights", at.viscous_weights, at.viscous);
  text.row += table("Viscous", at.viscous, at.levers);
  text.row += c_number(n.model_step) + "},\n";
  return text;
}

constexpr std::string_view kFunctions = R"(
static void @stem@_rest(const DamperInput* input, double* state) {
  int m, at = 0;
  for (m = 0; m < @count@; ++m) {
    passive_rest(&kPassiveCells[m], input, &state[at]);
    at += passive_size(&kPassiveCells[m]);
  }
}

static void @stem@_advance(const DamperInput* from, const DamperInput* to, double dt,
                          double* state) {
  int m, at = 0;
  for (m = 0; m < @count@; ++m) {
    passive_advance(&kPassiveCells[m], from, to, dt, &state[at]);
    at += passive_size(&kPassiveCells[m]);
  }
}

static double @stem@_force(const DamperInput* input, const double* state) {
  double sum = 0;
  int m, at = 0;
  for (m = 0; m < @count@; ++m) {
    sum += passive_force(&kPassiveCells[m], input, &state[at]);
    at += passive_size(&kPassiveCells[m]);
  }
  return (sum / @count@) + @offset@;
}
)";

}  // namespace

CModel c_passive_network(const PassiveNetworkModel& model, const std::string& stem) {
  std::size_t inputs = 1, neurons = 1, springs = 1;
  std::string tables, rows;
  for (std::size_t m = 0; m < model.members().size(); ++m) {
    const PassiveSizes& sizes = model.members()[m].sizes;
    inputs = std::max(inputs, sizes.inputs());
    neurons = std::max({neurons, sizes.neurons, sizes.viscous_neurons});
    springs = std::max(springs, sizes.springs);
    const Member text = member_text(model.members()[m], "kPassive" + std::to_string(m));
    tables += text.tables;
    rows += text.row;
  }

  const auto define = [](const char* name, std::size_t value) {
    return "#define " + std::string(name) + " " + std::to_string(value) + "\n";
  };
  return {define("PASSIVE_MOST_INPUTS", inputs) + define("PASSIVE_MOST_NEURONS", neurons) +
          define("PASSIVE_MOST_SPRINGS", springs) + "\n#include \"passive_cell.h\"\n" + tables +
          "static const PassiveCell kPassiveCells[] = {\n" + rows + "};\n" +
          filled(std::string(kFunctions),
                 {{"stem", CText::own(stem)},
                  {"count", CText::own(std::to_string(model.members().size()))},
                  {"offset", CText::own(c_number(model.offset()))}})};
}

}  // namespace dashpot
