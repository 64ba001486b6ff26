#include "dashpot/damper/kinds/network/network_model.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_text.h"

namespace dashpot {

CModel c_network(const NetworkModel& model) {
  std::string code = c_mlps(model.members()) + c_stateless("model") +
                     "static double model_force(const DamperInput* input, const double* state) {\n"
                     "  double raw[MLP_MOST_WIDTH], sum = 0;\n  int k;\n  (void)state;\n";
  for (std::size_t k = 0; k < model.inputs().size(); ++k)
    code += "  raw[" + std::to_string(k) + "] = input->" + model.inputs()[k] + ";\n";
  const std::string count = std::to_string(model.members().size());
  return {code + "  for (k = 0; k < " + count +
          "; ++k) {\n    sum += mlp_evaluate(&kMlps[k], raw);\n  }\n  return (sum / " + count +
          ") + " + c_number(model.offset()) + ";\n}\n\n"};
}

}  // namespace dashpot
