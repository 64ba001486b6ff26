#include "dashpot/damper/kinds/fuzzy/fuzzy_model.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_text.h"

namespace dashpot {
namespace {

std::string sugeno_code(const Sugeno& sugeno) {
  std::vector<double> mean, scale, low, high;
  for (const Sugeno::Input& input : sugeno.inputs) {
    mean.push_back(input.mean);
    scale.push_back(input.scale);
    low.push_back(input.low);
    high.push_back(input.high);
  }

  // The sets, a row each, and the rules: each the number of its sets, then these.
  std::string memberships;
  for (const Membership& m : sugeno.memberships)
    memberships += "    {" + std::to_string(static_cast<std::size_t>(m.shape)) + ", " +
                   std::to_string(m.input) + ", " + c_number(m.centre) + ", " + c_number(m.width) +
                   ", " + c_number(m.slope) + "},\n";
  std::vector<int> rules;
  for (const std::vector<std::size_t>& rule : sugeno.rules) {
    rules.push_back(static_cast<int>(rule.size()));
    rules.insert(rules.end(), rule.begin(), rule.end());
  }

  return "#define SUGENO_MOST_INPUTS " + std::to_string(sugeno.inputs.size()) +
         "\n#define SUGENO_MOST_MEMBERSHIPS " + std::to_string(sugeno.memberships.size()) +
         "\n#define SUGENO_MOST_RULES " + std::to_string(sugeno.rules.size()) + "\n\n" +
         "#include \"sugeno.h\"\n" + c_table("kMean", mean) + c_table("kScale", scale) +
         c_table("kLow", low) + c_table("kHigh", high) + c_table("kRules", rules) +
         c_table("kConsequents", sugeno.consequents) +
         "static const Membership kMemberships[] = {\n" + memberships +
         "};\n\nstatic const Sugeno kSugeno = {" + std::to_string(sugeno.inputs.size()) +
         ", kMean, kScale, kLow, kHigh, kMemberships, " +
         std::to_string(sugeno.memberships.size()) + ", kRules, " +
         std::to_string(sugeno.rules.size()) + ", kConsequents, " + c_number(sugeno.output_mean) +
         ", " + c_number(sugeno.output_scale) + "};\n\n";
}

/// A lagged number of the state, the past velocity or the coil's current, and how fast it follows.
struct Lag {
  std::string place, input, seconds, start;
};

std::vector<Lag> lags_of(const FuzzyInputs& inputs) {
  std::vector<Lag> lags;
  if (inputs.has("velocity_change"))
    lags.push_back({"0", "velocity", c_number(inputs.lags().velocity), "0"});
  if (inputs.has("current") && inputs.lags().coil > 0)
    lags.push_back(
        {std::to_string(lags.size()), "current", c_number(inputs.lags().coil), "input->current"});
  return lags;
}

std::string state_functions(const std::vector<Lag>& lags) {
  if (lags.empty()) return c_stateless("model");
  std::string rest = "static void model_rest(const DamperInput* input, double* state) {\n";
  std::string advance =
      "static void model_advance(const DamperInput* from, const DamperInput* to, double dt, "
      "double* state) "
      "{\n";

  // A line per lag in both functions.
  bool uses_input = false;
  for (const Lag& lag : lags) {
    rest += "  state[" + lag.place + "] = " + lag.start + ";\n";
    uses_input = uses_input || lag.start != "0";
    advance += "  state[" + lag.place + "] = lag_after(state[" + lag.place + "], from->" +
               lag.input + ", to->" + lag.input + ", dt / " + lag.seconds + ");\n";
  }
  return "#include \"lag.h\"\n" + rest + (uses_input ? "" : "  (void)input;\n") + "}\n\n" +
         advance + "}\n\n";
}

std::string force_function(const FuzzyModel& model, const std::vector<Lag>& lags) {
  std::string code =
      "static double model_force(const DamperInput* input, const double* state) {\n"
      "  double raw[SUGENO_MOST_INPUTS];\n";
  const std::vector<std::string>& names = model.inputs().names();
  for (std::size_t k = 0; k < names.size(); ++k) {
    std::string value = "input->" + c_name(names[k]);
    if (names[k] == "velocity_change") value = "input->velocity - state[0]";
    if (names[k] == "current" && !lags.empty() && lags.back().input == "current")
      value = "state[" + lags.back().place + "]";
    code += "  raw[" + std::to_string(k) + "] = " + value + ";\n";
  }
  return code + (lags.empty() ? "  (void)state;\n" : "") +
         "  return sugeno_evaluate(&kSugeno, raw) + " + c_number(model.offset()) + ";\n}\n\n";
}

}  // namespace

CModel c_fuzzy(const FuzzyModel& model) {
  const std::vector<Lag> lags = lags_of(model.inputs());
  return {sugeno_code(model.sugeno()) + state_functions(lags) + force_function(model, lags)};
}

}  // namespace dashpot
