#include <algorithm>
#include <array>

#include "dashpot/damper/kinds/narx/narx_model.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_text.h"

namespace dashpot {
namespace {

constexpr std::array<std::string_view, 3> kInputs{"displacement", "velocity", "current"};

int place_of(const std::string& input) {
  return static_cast<int>(std::ranges::find(kInputs, input) - kInputs.begin());
}

std::vector<int> lags_of(const std::vector<std::size_t>& lags) {
  return {lags.begin(), lags.end()};
}

}  // namespace

CModel c_narx(const NarxModel& model) {
  const Regressors& regressors = model.regressors();
  std::string code = c_mlps(model.members()) + "#include \"narx.h\"\n";
  std::string entries;
  std::size_t first = 2;  // behind the time that is pending and whether it diverged
  for (std::size_t k = 0; k < regressors.inputs.size(); ++k) {
    const Regressors::Input& input = regressors.inputs[k];
    const std::string name = "kLags" + std::to_string(k);
    code += c_table(name, lags_of(input.lags));
    entries += "    {" + std::to_string(place_of(input.name)) + ", " + std::to_string(first) +
               ", " + std::to_string(input.depth() + 1) + ", " + name + ", " +
               std::to_string(input.lags.size()) + "},\n";
    first += input.depth() + 1;
  }
  code += c_table("kFeedback", lags_of(regressors.feedback)) +
          "static const NarxInput kInputs[] = {\n" + entries +
          "};\n\nstatic const Narx kNarx = {kInputs, " + std::to_string(regressors.inputs.size()) +
          ", kFeedback, " + std::to_string(regressors.feedback.size()) + ", kMlps, " +
          std::to_string(model.members().size()) + ", " + std::to_string(first) + ", " +
          std::to_string(regressors.feedback_depth() + 1) + ", " +
          c_number(regressors.sample_time) + ", " + c_number(model.offset()) + "};\n\n";
  return {
      code +
      R"(static void model_rest(const DamperInput* input, double* state) { narx_rest(&kNarx, input, state); }

static void model_advance(const DamperInput* from, const DamperInput* to, double dt, double* state) {
  narx_advance(&kNarx, from, to, dt, state);
}

static double model_force(const DamperInput* input, const double* state) {
  return narx_force(&kNarx, input, state);
}

)"};
}

}  // namespace dashpot
