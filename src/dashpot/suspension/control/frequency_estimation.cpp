#include "dashpot/suspension/control/damping_law.h"

namespace dashpot {

#include "dashpot/suspension/control/c_text/control_feb.h"

extern const ControlLaw kFrequencyEstimation;

namespace {

struct EstimationParameters {
  double window, low, middle, high;
};

ControllerPointer make(std::span<const double> values, const ControlContext& context) {
  const auto p = values_as<EstimationParameters>(values);
  const Feb feb{exp(-context.limits.sample_time / p.window), p.low, p.middle, p.high};
  return std::make_unique<StrutLaw<kFrequencyEstimation, Feb, feb_demand, 2>>(feb, context);
}

}  // namespace

const ControlLaw kFrequencyEstimation{
    .name = "feb",
    .title = "Frequency-estimation-based",
    .equation =
        "f = sqrt(sum d^2 / sum x^2) / 2 pi over a window;  c_max where f < low or middle <= f < "
        "high, else c_min",
    .source = "Lozoya-Santos, recalled",
    .remarks = "Deflection sensor only. The bands are examples.",
    .parameters = {{"window", "s", 0.5, 1e-3, 100, "over which the sums forget"},
                   {"low", "Hz", 2, 0, 1000, "hard below: comfort at the body's resonance"},
                   {"middle", "Hz", 9, 0, 1000, "hard from here ..."},
                   {"high", "Hz", 14, 0, 1000, "... to here: the wheel's resonance"}},
    .make = make};

}  // namespace dashpot
