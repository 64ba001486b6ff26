#pragma once
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/registry.h"
#include "support.h"

/// Calls test(law) for every law of the registry; messages bear its name.
template <class Test>
void for_each_law(Test test) {
  for (const dashpot::Law* law : dashpot::laws()) {
    CAPTURE(std::string(law->name));
    test(*law);
  }
}

inline std::vector<double> defaults(const dashpot::Law& law) {
  std::vector<double> p;
  for (const dashpot::ParamInfo& info : law.params) p.push_back(info.value);
  return p;
}

/// 10 mm at 1 Hz.
inline dashpot::DamperInput sine(double t, double current = 0) {
  const double w = 2 * std::numbers::pi;
  return {0.01 * std::sin(w * t), 0.01 * w * std::cos(w * t), current};
}

struct Sample {
  dashpot::DamperInput input;
  double force;
};

/// The second cycle of the sine, after the first has let the start die away.
inline std::vector<Sample> steady_cycle(const dashpot::LawModel& model, int samples = 4000) {
  const double h = 1.0 / samples;
  std::vector<double> state(model.state_size());
  model.rest(sine(0), state);
  std::vector<Sample> cycle;
  for (int k = 0; k < 2 * samples; ++k) {
    const dashpot::DamperInput now = sine(k * h);
    if (k >= samples) cycle.push_back({now, model.force(now, state)});
    model.advance(now, sine((k + 1) * h), h, state);
  }
  return cycle;
}
