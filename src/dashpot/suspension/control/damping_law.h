#pragma once
#include <array>
#include <span>
#include <type_traits>

#include "dashpot/suspension/control/control_text.h"

namespace dashpot {

// clang-format off: what the texts of the laws are made of, which are taken in where the laws stand
#include "dashpot/suspension/control/c_text/demand.h"
#include "dashpot/suspension/control/c_text/hard_when.h"
#include "dashpot/suspension/control/c_text/dissipating_force.h"
#include "dashpot/suspension/control/c_text/frequency_range.h"
// clang-format on

struct NoParameters {};

/// A law that looks at each strut for itself. Demand: its C text, (p, limits, s, memory), without p
/// where it has none and without memory where it keeps nothing.
template <const ControlLaw& kLaw, class Parameters, auto Demand, std::size_t kMemory = 0>
class StrutLaw final : public Controller {
 public:
  StrutLaw(const Parameters& parameters, const ControlContext& context)
      : parameters_(parameters), limits_(context.limits), struts_(context.plant.struts.size()) {}
  std::size_t state_size() const noexcept override { return kMemory * struts_; }
  void reset(std::span<double> state) const noexcept override {
    for (double& value : state) value = 0;
  }
  void step(std::span<const StrutSignals> struts, std::span<const double>, std::span<double> state,
            std::span<DamperDemand> demands) const noexcept override {
    for (std::size_t k = 0; k < struts.size(); ++k)
      if constexpr (kMemory > 0)
        demands[k] = Demand(&parameters_, &limits_, &struts[k], &state[kMemory * k]);
      else if constexpr (std::is_empty_v<Parameters>)
        demands[k] = Demand(&limits_, &struts[k]);
      else
        demands[k] = Demand(&parameters_, &limits_, &struts[k]);
  }
  ControlDescription description() const override {
    std::vector<double> values(std::is_empty_v<Parameters> ? 0
                                                           : sizeof(Parameters) / sizeof(double));
    if (!values.empty()) std::memcpy(values.data(), &parameters_, sizeof parameters_);
    return {.law = std::string(kLaw.name), .parameters = std::move(values), .memory = kMemory};
  }

 private:
  Parameters parameters_;
  ControlLimits limits_;
  std::size_t struts_;
};

template <const ControlLaw& kLaw, class Parameters, auto Demand>
ControllerPointer make_strut_law(std::span<const double> values, const ControlContext& context) {
  return std::make_unique<StrutLaw<kLaw, Parameters, Demand>>(values_as<Parameters>(values),
                                                              context);
}

/// The same for laws without parameters.
template <const ControlLaw& kLaw, auto Demand>
ControllerPointer make_plain(std::span<const double>, const ControlContext& context) {
  return std::make_unique<StrutLaw<kLaw, NoParameters, Demand>>(NoParameters{}, context);
}

/// N/m, of the spring along the first strut, which is the same for all of a kind of plant; 0
/// without one.
double strut_stiffness(const Plant& plant);

constexpr ParameterRow kCrossover{
    "crossover", "Hz", 1.9,
    0.01,        100,  "between low and high frequencies: 1.5 to 2 times the body's resonance"};

}  // namespace dashpot
