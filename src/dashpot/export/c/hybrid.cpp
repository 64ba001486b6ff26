#include "dashpot/base/escape.h"
#include "dashpot/damper/kinds/hybrid/hybrid_model.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_text.h"

namespace dashpot {

namespace {

/// Puts the signals of HybridSource::read() into raw[], in its order.
std::string read_signals(const HybridSource& source) {
  std::string code;
  const auto signal = [&](const std::string& value) {
    code += "  raw[count] = " + value + ";\n  ++count;\n";
  };
  const auto of_bank = [&](std::size_t first, std::size_t end) {
    for (std::size_t k = first; k < end; ++k) signal("of_bank[" + std::to_string(k + 1) + "]");
  };
  const Law& law = source.law.law();
  const std::size_t lags = source.bank.size() - source.bank.current_rates.size();

  // The motion, and what the law makes of it.
  signal("input->velocity");
  if (law.needs_displacement) signal("input->displacement");
  for (std::size_t k = 0; k < law.states.size(); ++k) signal("state[" + std::to_string(k) + "]");
  signal("law");
  of_bank(0, lags);

  // The currents: in the coil, then behind the bank's lags.
  signal(source.law.lag_rate() > 0 ? "state[" + std::to_string(law.states.size()) + "]"
                                   : "input->current");
  of_bank(lags, source.bank.size());
  return code;
}

}  // namespace

CModel c_hybrid(const HybridModel& model) {
  const HybridSource& source = model.source();
  const std::string code =
      c_law(source.law, "law_model").code + c_banks({&source.bank}) +
      c_gated_networks({&model.network()}) + c_table("kMixingMean", model.mixing().mean) +
      c_table("kMixingRows", model.mixing().rows) + "\n#include \"mixing.h\"\n";
  return {code + filled(R"(static void model_rest(const DamperInput* input, double* state) {
  law_model_rest(input, state);
  bank_rest(&kBanks[0], input, &state[@law_states@]);
}

static void model_advance(const DamperInput* from, const DamperInput* to, double dt, double* state) {
  law_model_advance(from, to, dt, state);
  bank_advance(&kBanks[0], from, to, dt, &state[@law_states@]);
}

static double model_force(const DamperInput* input, const double* state) {
  const double law = law_model_force(input, state);
  double raw[GATED_MOST_SIGNALS], mixed[GATED_MOST_SIGNALS], of_bank[GATED_MOST_SIGNALS];
  int count = 0;
  bank_read(&kBanks[0], input, &state[@law_states@], of_bank);
@read@  mixing_apply(kMixingMean, kMixingRows, @motions@, raw, mixed);
  for (count = @motions@; count < @signals@; ++count) {
    mixed[count] = raw[count];
  }
  return law + gated_evaluate(&kNetworks[0], mixed, 1) + @offset@;
}

)",
                        {{"law_states", CText::own(std::to_string(source.law.state_size()))},
                         {"read", CText::own(read_signals(source))},
                         {"motions", CText::own(std::to_string(source.motions()))},
                         {"signals", CText::own(std::to_string(model.network().signals.size()))},
                         {"offset", CText::own(c_number(model.offset()))}})};
}

}  // namespace dashpot
