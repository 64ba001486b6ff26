#include <cmath>

#include "dashpot/base/escape.h"
#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/error.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_text.h"
#include "dashpot/physics/plate_flow.h"

namespace dashpot {
namespace {

std::string yield_stress() {
  return "yield_stress_at(kYieldCurrents, kYieldStresses, FAMILY_YIELD_POINTS, input->current)";
}

bool reads_yield_stress(const FamilyModel& model) {
  if (model.family().baseline.target == FamilyTarget::Residual) return true;
  const auto* network = dynamic_cast<const FamilyNetwork*>(model.family().force.get());
  if (!network) return false;
  for (const std::string& input : network->inputs())
    if (input == kYieldStress) return true;
  return false;
}

std::string yield_curve(const FamilyMember& member) {
  return "#include \"yield_curve.h\"\n#define FAMILY_YIELD_POINTS " +
         std::to_string(member.yield.currents.size()) + "\n\n" +
         c_table("kYieldCurrents", member.yield.currents) +
         c_table("kYieldStresses", member.yield.stresses) + "\n";
}

/// The force by first principles, with the numbers of this member in it.
std::string baseline_function(const FamilyModel& model) {
  const FamilyMember& m = model.member();
  const FamilyBaseline& baseline = model.family().baseline;
  const std::string head = "static double family_baseline(const DamperInput* input) {\n";
  const std::string viscous = c_number(viscous_force(m, 1));
  const std::string spring = "(" + c_number(m.spring_stiffness) + " * input->displacement)";

  // Nothing, spring and viscous flow, or the plate flow.
  if (baseline.target == FamilyTarget::Total) return head + "  (void)input;\n  return 0.0;\n}\n\n";
  if (baseline.target == FamilyTarget::YieldForce)
    return head + "  return " + spring + " + (" + viscous + " * input->velocity);\n}\n\n";
  const PlateGap gap{m.pole_length, m.gap_area / m.gap, m.gap};
  const double per_stress = m.piston_area * plate_yield_pressure(&gap, 1);
  return "#include \"plate_flow.h\"\n" + head + "  const double flow = plate_bingham_pressure(" +
         viscous + " * fabs(input->velocity), " + c_number(per_stress) + " * " + yield_stress() +
         ");\n  return " + spring + " + (" + c_number(baseline.share) +
         " * tanh(input->velocity / " + c_number(baseline.onset) + ") * flow);\n}\n\n";
}

double member_number(const FamilyMember& member, const std::string& name) {
  for (const MemberField& field : member_fields())
    if (field.name == name) return member.*field.field;
  throw Error(name, "is no number of a member");
}

std::string network_code(const FamilyModel& model, const FamilyNetwork& network) {
  std::string code = c_mlps(network.mlps()) + c_stateless("model") +
                     "static double family_force(const DamperInput* input, const double* state) {\n"
                     "  double raw[MLP_MOST_WIDTH], sum = 0;\n  int k;\n  (void)state;\n";

  // Inputs beside the motion are numbers of this member.
  for (std::size_t k = 0; k < network.inputs().size(); ++k) {
    const std::string& name = network.inputs()[k];
    std::string value = "input->" + c_name(name);
    if (name == kYieldStress)
      value = yield_stress();
    else if (name != "displacement" && name != "velocity" && name != "current")
      value = c_number(member_number(model.member(), name));
    code += "  raw[" + std::to_string(k) + "] = " + value + ";\n";
  }

  const std::string count = std::to_string(network.mlps().size());
  return code + "  for (k = 0; k < " + count +
         "; ++k) {\n    sum += mlp_evaluate(&kMlps[k], raw);\n  }\n  return sum / " + count +
         ";\n}\n\n";
}

/// The gates' weights of one term, as a polynomial in the field's share alone: the rest is this
/// member's.
std::vector<double> by_power_of_field(const FamilyGates& gates, const FamilyMember& member) {
  const FamilyGates::Quantities q = gates.quantities(member, 0);
  std::vector<double> out;
  for (std::size_t j = 0; j < gates.term_count(); ++j) {
    std::array<double, 4> powers{};
    for (std::size_t k = 0; k < FamilyGates::kGates; ++k) {
      const auto& exponents = FamilyGates::exponents()[k];

      // The quantities but the field are numbers here.
      double weight = gates.weights[j * FamilyGates::kGates + k] / gates.term_scale[j];
      for (std::size_t n = 1; n < FamilyGates::kQuantities; ++n)
        weight *= std::pow(q[n], exponents[n]);
      powers[static_cast<std::size_t>(exponents[0])] += weight;
    }
    out.insert(out.end(), powers.begin(), powers.end());
  }
  return out;
}

constexpr const char* kGates = R"(static void model_rest(const DamperInput* input, double* state) {
  bank_rest(&kBanks[0], input, state);
}

static void model_advance(const DamperInput* from, const DamperInput* to, double dt, double* state) {
  bank_advance(&kBanks[0], from, to, dt, state);
}

static double family_force(const DamperInput* input, const double* state) {
  const double half_current = @half_current@;
  const double current = fmin(fabs(input->current), 1e6 * half_current);
  const double field = ((current / (current + half_current)) - @mean@) / @scale@;
  double terms[FAMILY_TERMS], sum = 0;
  int k;
  bank_read(&kBanks[0], input, state, terms);
@soft@  for (k = 0; k < FAMILY_TERMS; ++k) {
    const double* w = &kWeights[4 * k];
    sum += terms[k] * (w[0] + (field * (w[1] + (field * (w[2] + (field * w[3]))))));
  }
  return sum;
}

)";

std::string gates_code(const FamilyModel& model, const FamilyGates& gates) {
  std::string soft;
  for (std::size_t k = 0; k < gates.soft_speeds.size(); ++k)
    soft += "  terms[" + std::to_string(gates.bank.signal_count() + k) +
            "] = tanh(input->velocity / " + c_number(gates.soft_speeds[k]) + ");\n";
  soft += "  terms[FAMILY_TERMS - 1] = 1.0;\n";
  return c_banks({&gates.bank}) + "#define FAMILY_TERMS " + std::to_string(gates.term_count()) +
         "\n\n/* Per term: powers 0 to 3 of the field's share. */\n" +
         c_table("kWeights", by_power_of_field(gates, model.member())) + "\n" +
         filled(kGates, {{"half_current", CText::own(c_number(gates.half_current))},
                         {"mean", CText::own(c_number(gates.mean[0]))},
                         {"scale", CText::own(c_number(gates.scale[0]))},
                         {"soft", CText::own(soft)}});
}

}  // namespace

CModel c_family(const FamilyModel& model) {
  std::string code = reads_yield_stress(model) ? yield_curve(model.member()) : "";
  const FamilyForce* force = model.family().force.get();
  if (const auto* network = dynamic_cast<const FamilyNetwork*>(force))
    code += network_code(model, *network);
  else if (const auto* gated = dynamic_cast<const GatedFamily*>(force))
    code += gates_code(model, gated->gates());
  else
    throw Error(model.name(), "its learned part has no C code");
  return {code + baseline_function(model) +
          "static double model_force(const DamperInput* input, const double* state) {\n  return (" +
          c_number(model.strength()) +
          " * (family_baseline(input) + family_force(input, state))) + " +
          c_number(model.offset()) + ";\n}\n\n"};
}

}  // namespace dashpot
