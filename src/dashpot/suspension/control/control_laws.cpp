#include <algorithm>
#include <array>

#include "dashpot/base/find_row.h"
#include "dashpot/base/settings.h"
#include "dashpot/base/text.h"
#include "dashpot/controller.h"
#include "dashpot/error.h"
#include "dashpot/suspension/control/damping_law.h"

namespace dashpot {

#include "dashpot/suspension/control/c_text/selected_demand.h"

extern const ControlLaw kAdd, kClippedLqr, kClippedOptimal, kConstant, kFrequencyEstimation, kFuzzy,
    kGroundhook, kHybrid, kMix1, kPdd, kShAdd, kSkyhook, kSkyhookLinear, kSkyhookModified,
    kSlidingMode;

namespace {

constexpr std::array kControlLaws{&kAdd,
                                  &kClippedLqr,
                                  &kClippedOptimal,
                                  &kConstant,
                                  &kFrequencyEstimation,
                                  &kFuzzy,
                                  &kGroundhook,
                                  &kHybrid,
                                  &kMix1,
                                  &kPdd,
                                  &kShAdd,
                                  &kSkyhook,
                                  &kSkyhookLinear,
                                  &kSkyhookModified,
                                  &kSlidingMode};

constexpr std::string_view kSelector = "selector(";

/// One law at low frequencies of the body, another at high ones, strut by strut.
class Selector final : public Controller {
 public:
  Selector(ControllerPointer low, ControllerPointer high, double crossover)
      : low_(std::move(low)), high_(std::move(high)), crossover_(crossover) {}
  std::size_t state_size() const noexcept override {
    return low_->state_size() + high_->state_size();
  }
  void reset(std::span<double> state) const noexcept override {
    low_->reset(state.first(low_->state_size()));
    high_->reset(state.subspan(low_->state_size()));
  }
  void step(std::span<const StrutSignals> struts, std::span<const double> plant_state,
            std::span<double> state, std::span<DamperDemand> demands) const noexcept override {
    std::array<DamperDemand, kMostStruts> high{};
    low_->step(struts, plant_state, state.first(low_->state_size()), demands);
    high_->step(struts, plant_state, state.subspan(low_->state_size()),
                std::span(high).first(struts.size()));
    for (std::size_t k = 0; k < struts.size(); ++k)
      demands[k] = selected_demand(&struts[k], crossover_, demands[k], high[k]);
  }
  ControlDescription description() const override {
    return {.law = "selector",
            .parameters = {crossover_},
            .choices = {low_->description(), high_->description()}};
  }

  static constexpr std::size_t kMostStruts = 64;

 private:
  ControllerPointer low_, high_;
  double crossover_;
};

void require_limits(const ControlLimits& limits, const std::string& where) {
  if (!(limits.damping_min >= 0 && limits.damping_min <= limits.damping_max))
    throw Error(where,
                "damping from " + format_number(limits.damping_min) + " to " +
                    format_number(limits.damping_max) + " N*s/m",
                "rising, from 0 on");
  if (!(limits.current_min <= limits.current_max))
    throw Error(where,
                "current from " + format_number(limits.current_min) + " to " +
                    format_number(limits.current_max) + " A",
                "rising");
  if (!(limits.sample_time > 0)) throw Error(where, "its sample time is not above 0");
}

/// The two laws that a selector names.
std::array<std::string, 2> selected(const std::string& text, const std::string& where) {
  const std::string inside = text.substr(kSelector.size(), text.find(')') - kSelector.size());
  const std::vector<std::string> names = split(inside, '/');
  if (text.find(')') == std::string::npos || names.size() != 2)
    throw Error(where, "'" + text + "' does not name two laws", "as selector(skyhook/add)");
  return {std::string(trim(names[0])), std::string(trim(names[1]))};
}

ControllerPointer make_selector(const std::vector<std::string>& parts,
                                const ControlContext& context, const std::string& where) {
  const auto [low, high] = selected(parts.front(), where);
  if (context.plant.struts.size() > Selector::kMostStruts)
    throw Error(where,
                "the plant has more than " + std::to_string(Selector::kMostStruts) + " dampers");
  const std::array rows{kCrossover};
  const std::vector<double> values =
      parse_values(rows, std::span(parts).subspan(1), "selector", where);
  return std::make_unique<Selector>(make_controller(low, context, where),
                                    make_controller(high, context, where), values[0]);
}

}  // namespace

double strut_stiffness(const Plant& plant) {
  double stiffness = 0;
  if (plant.struts.empty()) return stiffness;

  // A unit of the wheel alone stretches the strut and the tyre by one.
  const std::vector<double>& wheel = plant.struts[0].wheel_row;
  for (std::size_t i = 0; i < wheel.size(); ++i)
    for (std::size_t j = 0; j < wheel.size(); ++j)
      stiffness += wheel[i] * plant.stiffness[i * plant.size() + j] * wheel[j];
  return stiffness;
}

std::span<const ControlLaw* const> control_laws() { return kControlLaws; }

const ControlLaw& find_control_law(std::string_view name, const std::string& where) {
  return find_row(kControlLaws, name, "controller", where);
}

ControllerPointer make_controller(const std::string& text, const ControlContext& context,
                                  const std::string& where) {
  require_limits(context.limits, where);
  const std::vector<std::string> parts = split_words(text, where);
  if (parts.front().starts_with(kSelector)) return make_selector(parts, context, where);
  const ControlLaw& law = find_control_law(parts.front(), where);
  for (std::size_t k = 1; k < parts.size(); ++k)
    if (std::ranges::find(kControlLaws, parts[k], &ControlLaw::name) !=
        std::ranges::end(kControlLaws))
      throw Error(where, "'" + parts[k] + "' is another controller, and a comma begins a setting",
                  "one controller; where several are taken, ';' between them");
  return law.make(parse_values(law.parameters, std::span(parts).subspan(1), law.name, where),
                  context);
}

bool needs_plant_state(const std::string& text) {
  const std::string name(trim(split(text, ',').front()));
  if (!name.starts_with(kSelector)) return find_control_law(name).needs_plant_state;
  const auto [low, high] = selected(name, "controller");
  return needs_plant_state(low) || needs_plant_state(high);
}

}  // namespace dashpot
