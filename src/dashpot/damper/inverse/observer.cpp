#include "dashpot/damper/inverse/observer.h"

#include <algorithm>
#include <cmath>
#include <math.h>  // the C text says isfinite, not std::isfinite
#include <numbers>
#include <vector>

#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/damper/kinds/hybrid/hybrid_model.h"

namespace dashpot {
namespace {

constexpr int kMostSteps = 64;  // of a horizon

// The functions that the C text below calls.

inline int observed_states(const Observer* m) { return static_cast<int>(m->model().state_size()); }
inline double observer_step(const Observer* m) { return m->limits().sample_time; }
inline int observer_lags(const Observer* m) { return m->limits().lag_rate > 0; }
inline int observer_horizon(const Observer* m) { return m->steps(); }
inline void observed_rest(const Observer* m, const DamperInput* input, double* state) {
  m->model().rest(*input, {state, m->model().state_size()});
}
inline void observed_advance(const Observer* m, const DamperInput* from, const DamperInput* to,
                             double dt, double* state) {
  m->model().advance(*from, *to, dt, {state, m->model().state_size()});
}
inline double observed_force(const Observer* m, const DamperInput* input, const double* state) {
  return m->model().force(*input, {state, m->model().state_size()});
}

#include "dashpot/damper/c_text/inverse_observer.h"

}  // namespace

BareDamper without_coil_lag(const DamperModel& model) {
  const LawModel* law = model.law_inside();
  const auto* hybrid = model_as<HybridModel>(model);
  if (const auto* family = model_as<FamilyModel>(model); family && family->member().lag_rate > 0)
    return {family->without_lag(), family->member().lag_rate};
  // Beside a law, a network has a lag of its own: that of the law cannot stand for both.
  const bool apart = model.kind() == ModelKind::PassiveHybrid;
  if (!law || law->lag_rate() == 0 || apart) return {model.with_offset(0), 0};
  LawModel bare(law->law(), law->parameters(), law->drive_unit(), 0);
  if (!hybrid) return {std::make_unique<LawModel>(std::move(bare)), law->lag_rate()};
  return {std::make_unique<HybridModel>(HybridSource{std::move(bare), hybrid->source().bank},
                                        hybrid->mixing(), hybrid->network(), hybrid->offset()),
          law->lag_rate()};
}

Observer::Observer(const DamperModel& model, const InverseLimits& limits)
    : model_(without_coil_lag(model).model), limits_(limits) {
  probe([&](const InverseInput& input, std::span<double> state) {
    const double low = force(limits_.current_min, input, state);
    const double high = force(limits_.current_max, input, state);
    force_max_ = std::max({force_max_, std::abs(low), std::abs(high)});
    effect_ = std::max(effect_, std::abs(high - low));
  });

  // Where the effect of a held current still grows as the square of time, a command aimed at a
  // shorter horizon would swing from limit to limit.
  constexpr double kSettling = 0.4;
  double here = mean_effect();
  for (int next = 1; next <= kMostSteps; next *= 2) {
    const int steps = steps_;
    steps_ = next;
    const double later = mean_effect();
    if (here >= kSettling * later) {
      steps_ = steps;
      break;
    }
    here = later;
  }

  // The greatest effect of the current over that horizon.
  if (steps_ > 0)
    probe([&](const InverseInput& input, std::span<double> state) {
      effect_ = std::max(effect_, std::abs(force(limits_.current_max, input, state) -
                                           force(limits_.current_min, input, state)));
    });
}

std::size_t Observer::state_size() const noexcept { return 2 * model_->state_size() + 3; }

void Observer::rest(const DamperInput& input, std::span<double> state) const noexcept {
  observer_rest(this, &input, state.data());
}

void Observer::follow(const InverseInput& input, std::span<double> state) const noexcept {
  observer_follow(this, &input, state.data());
}

double Observer::force(double current, const InverseInput& input,
                       std::span<double> state) const noexcept {
  return observer_force(this, current, &input, state.data());
}

void Observer::probe(
    const std::function<void(const InverseInput&, std::span<double>)>& visit) const {
  constexpr double kAmplitude = 0.02, kFrequency = 1;  // m, Hz
  constexpr int kSteps = 400, kVisits = 20;            // over one and a half periods
  constexpr double w = 2 * std::numbers::pi * kFrequency;
  const double h = 1.5 / kFrequency / kSteps,
               half = 0.5 * (limits_.current_min + limits_.current_max);

  std::vector<double> state(state_size());
  const auto at = [&](int k) {
    return DamperInput{-kAmplitude * std::cos(w * k * h), kAmplitude * w * std::sin(w * k * h),
                       half};
  };

  // Run the model from rest at one end of the stroke, and visit equally spaced instants.
  rest(at(0), state);
  for (int k = 0; k < kSteps; ++k) {
    model_->advance(at(k), at(k + 1), h, std::span(state).first(model_->state_size()));
    if ((k + 1) % (kSteps / kVisits) == 0)
      visit({0, at(k + 1).displacement, at(k + 1).velocity, half, 0}, state);
  }
}

double Observer::mean_effect() const {
  double sum = 0;
  probe([&](const InverseInput& input, std::span<double> state) {
    sum += std::abs(force(limits_.current_max, input, state) -
                    force(limits_.current_min, input, state));
  });
  return sum;
}

}  // namespace dashpot
