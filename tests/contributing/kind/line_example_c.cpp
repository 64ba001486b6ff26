#include "contributing/kind/line_example_model.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_text.h"

namespace dashpot {

CModel c_line_example(const LineExampleModel& model) {
  return {c_stateless("model") +
          "static double model_force(const DamperInput* input, const double* state) {\n"
          "  (void)state;\n  return (" +
          c_number(model.damping()) + " * input->velocity) + " + c_number(model.offset()) +
          ";\n}\n\n"};
}

}  // namespace dashpot
