#include "dashpot/base/escape.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/mean/mean_model.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_text.h"
#include "dashpot/export/c_subset/c_rewrite.h"

namespace dashpot {
namespace {

constexpr std::string_view kMean = R"(
static void model_rest(const DamperInput* input, double* state) {
@rest@}

static void model_advance(const DamperInput* from, const DamperInput* to, double dt,
                          double* state) {
@advance@}

static double model_force(const DamperInput* input, const double* state) {
  double force = @offset@;
@force@  return force;
}
)";

}  // namespace

CModel c_mean(const MeanModel& model) {
  // Each member under names of its own, then a line for it in each function of the mean.
  std::string members, rest, advance, force;
  std::size_t at = 0;
  for (std::size_t m = 0; m < model.members().size(); ++m) {
    const MeanModel::Member& member = model.members()[m];
    const auto* law = model_as<LawModel>(*member.model);
    const CModel code = law ? c_law(*law, "law_model") : c_model(*member.model);
    const std::string before = "m" + std::to_string(m + 1) + "_";
    const std::string stem = before + (law ? "law_model" : "model");
    const std::string state = "&state[" + std::to_string(at) + "]);\n";
    members += with_own_names(with_texts(code.code), before) + "\n";
    rest += "  " + stem + "_rest(input, " + state;
    advance += "  " + stem + "_advance(from, to, dt, " + state;
    force += "  force += " + c_number(member.weight) + " * " + stem + "_force(input, " + state;
    at += member.model->state_size();
  }
  return {members + filled(std::string(kMean), {{"rest", CText::own(rest)},
                                                {"advance", CText::own(advance)},
                                                {"force", CText::own(force)},
                                                {"offset", CText::own(c_number(model.offset()))}})};
}

}  // namespace dashpot
