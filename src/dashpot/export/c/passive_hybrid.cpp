#include "dashpot/base/escape.h"
#include "dashpot/damper/kinds/passive_hybrid/passive_hybrid_model.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_text.h"

namespace dashpot {
namespace {

/// The law's state stands first.
constexpr std::string_view kSideBySide = R"(
static void model_rest(const DamperInput* input, double* state) {
  law_model_rest(input, state);
  network_model_rest(input, &state[@law_states@]);
}

static void model_advance(const DamperInput* from, const DamperInput* to, double dt,
                          double* state) {
  law_model_advance(from, to, dt, state);
  network_model_advance(from, to, dt, &state[@law_states@]);
}

static double model_force(const DamperInput* input, const double* state) {
  const double law = law_model_force(input, state);
  const double network = network_model_force(input, &state[@law_states@]);
  return (@law_share@ * law) + (@network_share@ * network) + @offset@;
}
)";

}  // namespace

CModel c_passive_hybrid(const PassiveHybridModel& model) {
  return {c_law(model.law(), "law_model").code +
          c_passive_network(model.network(), "network_model").code +
          filled(std::string(kSideBySide),
                 {{"law_states", CText::own(std::to_string(model.law().state_size()))},
                  {"law_share", CText::own(c_number(model.law_share()))},
                  {"network_share", CText::own(c_number(model.network_share()))},
                  {"offset", CText::own(c_number(model.offset()))}})};
}

}  // namespace dashpot
