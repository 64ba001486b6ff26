#include <algorithm>
#include <cmath>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/damper/kinds/family/physics_family.h"
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

/// The stem of the functions of the family's states: "family" where a coil's lag stands around
/// them.
std::string stem_of(const FamilyModel& model) {
  return model.member().lag_rate > 0 ? "family" : "model";
}

std::string network_code(const FamilyModel& model, const FamilyNetwork& network) {
  std::string code = c_mlps(network.mlps()) + c_stateless(stem_of(model)) +
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

constexpr const char* kGates = R"(static void @stem@_rest(const DamperInput* input, double* state) {
  bank_rest(&kBanks[0], input, state);
}

static void @stem@_advance(const DamperInput* from, const DamperInput* to, double dt, double* state) {
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
                         {"stem", CText::own(stem_of(model))},
                         {"soft", CText::own(soft)}});
}

/// What of a member stands behind the state, where it can be set.
constexpr const char* kMemberNumbers = R"(typedef struct FamilyNumbers {
@fields@} FamilyNumbers;

static const FamilyNumbers kFamily = {@values@};

)";
constexpr const char* kNumbersBehind =
    R"(static inline const FamilyNumbers* family_behind(const double* state) {
  return (const FamilyNumbers*)(const void*)(state + @size@);
}

static void model_defaults(double* state) {
  FamilyNumbers* numbers = (FamilyNumbers*)(void*)(state + @size@);
  *numbers = kFamily;
}

)";

constexpr const char* kPhysics = R"(static const PhysicsReference kReference = {@reference@};

static void @stem@_rest(const DamperInput* input, double* state) {
  (void)input;
  state[0] = 0;
  state[1] = 0;
  state[2] = 0;
}

static void @stem@_advance(const DamperInput* from, const DamperInput* to, double dt, double* state) {
  const FamilyNumbers* m = @numbers@;
  const PhysicsMember member = {m->piston_area, m->gap_area, m->gap, m->pole_length, m->viscosity};
  const double yield_stress = @yield@;
  const PhysicsElement element =
      physics_element(&kReference, kNumbers, kDeviation, &member, yield_stress, to->current);
  physics_advance(&element, from->velocity, to->velocity, dt, state);
}

static double family_force(const DamperInput* input, const double* state) {
  (void)input;
  return state[0] + state[1] + (@force@ * @offset@);
}

)";

/// The functions of the coil's lag around those of the family; its current stands behind the
/// family's states.
constexpr const char* kCoilLag =
    R"(static void model_rest(const DamperInput* input, double* state) {
  family_rest(input, state);
  state[@coil@] = input->current;
}

static void model_advance(const DamperInput* from, const DamperInput* to, double dt, double* state) {
  DamperInput before = *from, after = *to;
  before.current = state[@coil@];
  if (dt > 0) {
    state[@coil@] = lag_after(state[@coil@], from->current, to->current, @rate@ * dt);
  }
  after.current = state[@coil@];
  family_advance(&before, &after, dt, state);
}

)";

/// The yield stress at an input's current, with what stands behind the state.
std::string yield_of(const FamilyModel& model, const std::string& input) {
  const double last = model.member().yield.stresses.back();
  return "yield_stress_at(kYieldCurrents, kYieldStresses, FAMILY_YIELD_POINTS, " + input +
         "->current)" +
         (last > 0 ? " * (m->yield_stress / " + c_number(last) + ")" : std::string());
}

std::string physics_code(const FamilyModel& model, const PhysicsFamily& force, bool settable) {
  const FamilyPhysics& physics = force.physics();
  const PhysicsReference& r = physics.reference;

  // The member's numbers, in the order of c_parameters: behind the state, or for good.
  std::string fields, values;
  for (const CParameter& parameter : c_parameters(model)) {
    fields += "  double " + parameter.name + "; /* " + parameter.unit + " */\n";
    values += (values.empty() ? "" : ", ") + c_number(parameter.value);
  }
  std::string code =
      "#include \"physics_family.h\"\n" + c_table("kNumbers", physics.numbers) +
      c_table("kDeviation", physics.deviation) + "\n" +
      filled(kMemberNumbers, {{"fields", CText::own(fields)}, {"values", CText::own(values)}});
  if (settable)
    code += filled(kNumbersBehind, {{"size", CText::own(std::to_string(model.state_size()))}});

  const std::string reference = c_number(r.piston_area) + ", " + c_number(r.gap_area) + ", " +
                                c_number(r.gap) + ", " + c_number(r.pole_length) + ", " +
                                c_number(r.viscosity) + ", " + c_number(r.yield_stress) + ", " +
                                c_number(r.current) + ", " + c_number(r.force) + ", " +
                                c_number(r.speed) + ", " + c_number(r.stroke);
  return code +
         filled(kPhysics, {{"reference", CText::own(reference)},
                           {"stem", CText::own(stem_of(model))},
                           {"numbers", CText::own(settable ? "family_behind(state)" : "&kFamily")},
                           {"yield", CText::own(yield_of(model, "to"))},
                           {"force", CText::own(c_number(r.force))},
                           {"offset", CText::own(c_number(physics.deviation[3]))}});
}

std::string lag_code(const FamilyModel& model, bool settable) {
  return "#include \"lag.h\"\n" +
         filled(kCoilLag, {{"coil", CText::own(std::to_string(model.state_size() - 1))},
                           {"rate", CText::own(settable ? "family_behind(state)->lag_rate"
                                                        : c_number(model.member().lag_rate))}});
}

}  // namespace

std::vector<CParameter> c_parameters(const FamilyModel& model) {
  constexpr double kBeyond = 0.5;  // of the family's range, to either side
  const auto* force = dynamic_cast<const PhysicsFamily*>(model.family().force.get());
  if (!force || model.family().baseline.target != FamilyTarget::Total) return {};
  const FamilyMember& member = model.member();
  std::vector<CParameter> parameters;
  for (const Family::Range& range : model.family().domain)
    for (const MemberField& field : member_fields()) {
      if (field.field != range.field) continue;
      const double value = member.*field.field, span = range.max - range.min;
      const bool is_gap = field.field == &FamilyMember::gap;
      parameters.push_back(
          {std::string(field.name), std::string(field.unit),
           "of this damper; the family was fitted on " + format_number(range.min) + " to " +
               format_number(range.max) + (is_gap ? "; gap_area does not follow: set it, too" : ""),
           value, std::min(value, std::max(0.5 * range.min, range.min - kBeyond * span)),
           std::max(value, range.max + kBeyond * std::max(span, 0.2 * range.max))});
    }

  // The field, the build, and the coil.
  const double last = member.yield.stresses.back();
  if (last > 0)
    parameters.push_back({std::string(kYieldStress), "Pa",
                          "at " + format_number(member.yield.currents.back()) +
                              " A: the whole curve over the current goes with it",
                          last, 0, 5 * last});
  parameters.push_back({"build", "1", "standard deviations from the mean build of this drawing",
                        member.build, std::min(-4., member.build), std::max(4., member.build)});
  if (member.lag_rate > 0)
    parameters.push_back(
        {"lag_rate", "1/s", "of the coil: its current follows the command at this rate",
         member.lag_rate, std::min(1e-3, member.lag_rate), std::max(1e6, member.lag_rate)});
  return parameters;
}

std::string c_family_plate_flow(const FamilyModel& model) {
  constexpr const char* kPlateFlow =
      R"(static double family_plate_flow(const DamperInput* input, const double* state) {
  const FamilyNumbers* m = family_behind(state);
  const PlateGap gap = {m->pole_length, m->gap_area / m->gap, m->gap};
  const double yield_stress = @yield@;
  const double newtonian = plate_newtonian_pressure(&gap, m->viscosity, m->piston_area * fabs(input->velocity));
  return plate_side(input->velocity) * m->piston_area * plate_bingham_pressure(newtonian, plate_yield_pressure(&gap, yield_stress));
}
)";
  return filled(kPlateFlow, {{"yield", CText::own(yield_of(model, "input"))}});
}

CModel c_family(const FamilyModel& model, bool settable) {
  const FamilyForce* force = model.family().force.get();
  const auto* physics = dynamic_cast<const PhysicsFamily*>(force);
  std::string code = reads_yield_stress(model) || physics ? yield_curve(model.member()) : "";
  if (const auto* network = dynamic_cast<const FamilyNetwork*>(force))
    code += network_code(model, *network);
  else if (const auto* gated = dynamic_cast<const GatedFamily*>(force))
    code += gates_code(model, gated->gates());
  else if (physics)
    code += physics_code(model, *physics, settable);
  else
    throw Error(model.name(), "its learned part has no C code");
  const bool lags = model.member().lag_rate > 0;
  if (lags) code += lag_code(model, settable);

  // The force of this build; a coil that lags has its current in the state.
  const std::string strength = settable ? "(1 + (" + c_number(model.family().build_spread) +
                                              " * family_behind(state)->build))"
                                        : c_number(model.strength());
  const std::string begin =
      "static double model_force(const DamperInput* input, const double* state) {\n";
  const std::string sum = "  return (" + strength +
                          " * (family_baseline(@in@) + family_force(@in@, state))) + " +
                          c_number(model.offset()) + ";\n}\n\n";
  return {code + baseline_function(model) + begin +
          (lags ? "  DamperInput coil = *input;\n  coil.current = state[" +
                      std::to_string(model.state_size() - 1) + "];\n"
                : "") +
          filled(sum, {{"in", CText(CText::own(lags ? "&coil" : "input"))}})};
}

}  // namespace dashpot
