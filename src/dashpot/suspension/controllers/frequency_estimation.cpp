#include <algorithm>

#include "dashpot/suspension/controllers/damping_law.h"

namespace dashpot {
namespace {

struct Parameters {
  double window, low, middle, high;
};

/// Sums of d^2 and x^2 that forget: a window without a buffer.
class FrequencyEstimation final : public Controller {
 public:
  FrequencyEstimation(const Parameters& parameters, const ControlContext& context)
      : p_(parameters),
        limits_(context.limits),
        struts_(context.plant.struts.size()),
        keep_(std::exp(-context.limits.sample_time / parameters.window)) {}
  std::size_t state_size() const noexcept override { return 2 * struts_; }
  void reset(std::span<double> state) const noexcept override { std::fill(state.begin(), state.end(), 0); }
  void step(std::span<const StrutSignals> struts, std::span<const double>, std::span<double> state,
            std::span<DamperDemand> demands) const noexcept override {
    for (std::size_t k = 0; k < struts.size(); ++k) {
      double &speeds = state[2 * k], &ways = state[2 * k + 1];
      speeds = keep_ * speeds + struts[k].deflection_velocity * struts[k].deflection_velocity;
      ways = keep_ * ways + struts[k].deflection * struts[k].deflection;
      const double f = ways > 0 ? std::sqrt(speeds / ways) / (2 * std::numbers::pi) : 0;
      demands[k] = hard_when(f < p_.low || (f >= p_.middle && f < p_.high), limits_);
    }
  }

 private:
  Parameters p_;
  ControlLimits limits_;
  std::size_t struts_;
  double keep_;
};

ControllerPointer make(std::span<const double> values, const ControlContext& context) {
  return std::make_unique<FrequencyEstimation>(values_as<Parameters>(values), context);
}

}  // namespace

extern const ControlLaw kFrequencyEstimation;
const ControlLaw kFrequencyEstimation{
    .name = "feb",
    .title = "Frequency-estimation-based",
    .equation =
        "f = sqrt(sum d^2 / sum x^2) / 2 pi over a window;  c_max where f < low or middle <= f < high, else "
        "c_min",
    .source = "Lozoya-Santos, recalled",
    .remarks = "Deflection sensor only. The bands are examples.",
    .parameters = {{"window", "s", 0.5, 1e-3, 100, "over which the sums forget"},
                   {"low", "Hz", 2, 0, 1000, "hard below: comfort at the body's resonance"},
                   {"middle", "Hz", 9, 0, 1000, "hard from here ..."},
                   {"high", "Hz", 14, 0, 1000, "... to here: the wheel's resonance"}},
    .make = make};

}  // namespace dashpot
