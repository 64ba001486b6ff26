#pragma once
#include <memory>

#include "dashpot/damper/kinds/law/law_text.h"

/// A law from a file with two states that takes the current, a condition and most functions.
inline constexpr const char* kExampleLawText = R"yaml(
law: two_states
title: An example of two states
source: made up for a test
remarks: All that equations may say.
states:
  z: {unit: m}
  v_f: {unit: m/s, rest: v}
parameters:
  k: {unit: N/m, value: 40000, bounds: [0, 1e8], start: 0.5, form: quadratic, meaning: hysteresis}
  c: {unit: N*s/m, value: 900, bounds: [0, 1e8], start: 0.3, form: linear, meaning: damping}
  z_y: {unit: m, value: 0.004, bounds: [1e-5, 1], start: 0.2, meaning: where it yields}
  p: {unit: 1, value: 1.4, bounds: [1, 5], start: 1, fit: fixed, meaning: sharpness}
  r: {unit: 1/s, value: 150, bounds: [1, 1e4], start: 150, fit: fixed, meaning: of the filter}
  g: {unit: N, value: 30, bounds: [-1e6, 1e6], start: 0.1, meaning: gas and stops}
equations:
  - "u = abs(z)/z_y"
  - "dz/dt = v - where(v*z > 0 and u < 2 or u >= 2, min(u, 3)^p*v, 0)"
  - "dv_f/dt = r*(v - v_f)"
  - "soft = tanh(v_f/0.01) + atan(x/0.01)/pi"
  - "F = c*v + k*(1 + 0.2*i)*z + g*soft*exp(-x^2)*max(sqrt(1 + u), 1.5) + g*log(2 + sin(x)*cos(x))"
rate: max(r, 4*p*abs(v)/z_y)
)yaml";

inline std::shared_ptr<const dashpot::LawText> example_law_text() {
  static const std::shared_ptr<const dashpot::LawText> text =
      dashpot::parse_law_text(kExampleLawText, "two_states.yaml");
  return text;
}

/// A law from a file with a closed form of its state.
inline constexpr const char* kTravellingLawText = R"yaml(
law: travels
source: made up for a test
states: {w: {unit: 1}}
parameters:
  k: {unit: N, value: 600, bounds: [0, 1e6], start: 0.5, form: linear}
  rho: {unit: 1/m, value: 300, bounds: [1, 1e5], start: 3}
  c: {unit: N*s/m, value: 500, bounds: [0, 1e8], start: 0.3}
equations: [dw/dt = rho*(v - abs(v)*w), F = k*w + c*v]
rate: rho*abs(v)
travel_holds: rho > 0
travel:
  - side = where(s < 0, -1, 1)
  - w = side*(1 - (1 - side*w)*exp(-rho*abs(s)))
)yaml";

inline std::shared_ptr<const dashpot::LawText> travelling_law_text() {
  static const std::shared_ptr<const dashpot::LawText> text =
      dashpot::parse_law_text(kTravellingLawText, "travels.yaml");
  return text;
}
