#include "dashpot/damper/inverse/observer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "dashpot/damper/hybrid_model.h"

namespace dashpot {
namespace {

constexpr int kMostSteps = 64;  // of a horizon

/// Where an observer's state keeps what: the model's states, room to try, the last motion and current.
struct Layout {
  std::span<double> now, trial, last;
  Layout(std::span<double> state, std::size_t n)
      : now(state.subspan(0, n)), trial(state.subspan(n, n)), last(state.subspan(2 * n, 3)) {}
};

}  // namespace

BareDamper without_coil_lag(const DamperModel& model) {
  const auto* hybrid = dynamic_cast<const HybridModel*>(&model);
  const LawModel* law = hybrid ? &hybrid->law() : dynamic_cast<const LawModel*>(&model);
  if (!law || law->lag_rate() == 0) return {model.with_offset(0), 0};
  LawModel bare(law->law(), law->parameters(), law->drive_unit(), 0);
  if (!hybrid) return {std::make_unique<LawModel>(std::move(bare)), law->lag_rate()};
  return {std::make_unique<HybridModel>(HybridSource{std::move(bare), hybrid->source().bank},
                                        hybrid->mixing(), hybrid->network(), hybrid->offset()),
          law->lag_rate()};
}

Observer::Observer(const DamperModel& model, const InverseLimits& limits)
    : model_(without_coil_lag(model).model), limits_(limits), model_states_(model_->state_size()) {
  probe([&](const InverseInput& input, std::span<double> state) {
    const double low = force(limits_.current_min, input, state);
    const double high = force(limits_.current_max, input, state);
    force_max_ = std::max({force_max_, std::abs(low), std::abs(high)});
    effect_ = std::max(effect_, std::abs(high - low));
  });
  // Where the effect of a held current still grows as the square of time, a command aimed at a shorter
  // horizon would swing from limit to limit.
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
  if (steps_ > 0)
    probe([&](const InverseInput& input, std::span<double> state) {
      effect_ = std::max(effect_, std::abs(force(limits_.current_max, input, state) -
                                           force(limits_.current_min, input, state)));
    });
}

std::size_t Observer::state_size() const noexcept { return 2 * model_states_ + 3; }

void Observer::rest(const DamperInput& input, std::span<double> state) const noexcept {
  const Layout at(state, model_states_);
  model_->rest(input, at.now);
  std::copy_n(std::array{input.displacement, input.velocity, input.current}.data(), 3, at.last.data());
}

void Observer::follow(const InverseInput& input, std::span<double> state) const noexcept {
  const Layout at(state, model_states_);
  const DamperInput now{input.displacement, input.velocity, input.current};
  // A coil without lag jumped to its present current at the last command.
  const DamperInput before{at.last[0], at.last[1], limits_.lag_rate > 0 ? at.last[2] : input.current};
  model_->advance(before, now, limits_.sample_time, at.now);
  std::copy_n(std::array{now.displacement, now.velocity, now.current}.data(), 3, at.last.data());
  if (!std::all_of(at.now.begin(), at.now.end(), [](double z) { return std::isfinite(z); }))
    model_->rest(now, at.now);
}

double Observer::force(double current, const InverseInput& input, std::span<double> state) const noexcept {
  const Layout at(state, model_states_);
  DamperInput from{input.displacement, input.velocity, current};
  if (steps_ == 0) return model_->force(from, at.now);
  std::copy(at.now.begin(), at.now.end(), at.trial.begin());
  for (int k = 0; k < steps_; ++k) {
    DamperInput to = from;
    to.displacement += to.velocity * limits_.sample_time;
    model_->advance(from, to, limits_.sample_time, at.trial);
    from = to;
  }
  return model_->force(from, at.trial);
}

void Observer::probe(const std::function<void(const InverseInput&, std::span<double>)>& visit) const {
  constexpr double kAmplitude = 0.02, kFrequency = 1;  // m, Hz
  constexpr int kSteps = 400, kVisits = 20;            // over one and a half periods
  constexpr double w = 2 * std::numbers::pi * kFrequency;
  const double h = 1.5 / kFrequency / kSteps, half = 0.5 * (limits_.current_min + limits_.current_max);
  std::vector<double> state(state_size());
  const auto at = [&](int k) {
    return DamperInput{-kAmplitude * std::cos(w * k * h), kAmplitude * w * std::sin(w * k * h), half};
  };
  rest(at(0), state);
  for (int k = 0; k < kSteps; ++k) {
    model_->advance(at(k), at(k + 1), h, Layout(state, model_states_).now);
    if ((k + 1) % (kSteps / kVisits) == 0)
      visit({0, at(k + 1).displacement, at(k + 1).velocity, half, 0}, state);
  }
}

double Observer::mean_effect() const {
  double sum = 0;
  probe([&](const InverseInput& input, std::span<double> state) {
    sum += std::abs(force(limits_.current_max, input, state) - force(limits_.current_min, input, state));
  });
  return sum;
}

}  // namespace dashpot
