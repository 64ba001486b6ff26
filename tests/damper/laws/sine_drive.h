#pragma once
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <vector>

#include "dashpot/damper/kinds/law/law_model.h"
#include "support.h"

/// The motion of the test cases: x = X sin(2 pi f t) at a constant drive.
struct Sine {
  double amplitude, frequency, drive = 0;  ///< m, Hz, A or V
  dashpot::DamperInput at(double t) const {
    const double w = 2 * std::numbers::pi * frequency;
    return {amplitude * std::sin(w * t), amplitude * w * std::cos(w * t), drive};
  }
  double acceleration(double t) const {
    const double w = 2 * std::numbers::pi * frequency;
    return -w * w * amplitude * std::sin(w * t);
  }
};

/// Calls visit(t, input, force, state) at every step, from the zero state (no current in the coil)
/// on.
template <class Visit>
void simulate(const dashpot::LawModel& model, const Sine& sine, double duration, double step,
              Visit visit) {
  std::vector<double> state(model.state_size());
  model.rest({}, state);
  const auto steps = std::llround(duration / step);
  for (long long k = 0;; ++k) {
    const double t = static_cast<double>(k) * step;
    const dashpot::DamperInput input = sine.at(t);
    visit(t, input, model.force(input, state), state);
    if (k == steps) return;
    model.advance(input, sine.at(static_cast<double>(k + 1) * step), step, state);
  }
}

struct Simulated {
  double t, force;
  std::vector<double> state;
};

/// Forces and states at these times, which ascend.
inline std::vector<Simulated> at_times(const dashpot::LawModel& model, const Sine& sine,
                                       const std::vector<double>& times, double step = 5e-6) {
  std::vector<Simulated> found;
  simulate(
      model, sine, times.back(), step,
      [&](double t, const dashpot::DamperInput&, double force, const std::vector<double>& state) {
        for (const double wanted : times)
          if (std::abs(t - wanted) < step / 2) found.push_back({t, force, state});
      });
  return found;
}

/// Half a unit of the last of `digits` significant digits of a printed number.
inline double half_digit(double printed, int digits = 8) {
  return 0.5 * std::pow(10, std::floor(std::log10(std::abs(printed))) - (digits - 1));
}

/// Forces against printed ones of eight significant digits; `drive_error` N is what a sine taken as
/// straight lines between steps may add.
inline void check_forces(const std::vector<Simulated>& found, const std::vector<double>& printed,
                         double drive_error = 1e-6) {
  REQUIRE(found.size() == printed.size());
  for (std::size_t k = 0; k < printed.size(); ++k) {
    CAPTURE(found[k].t);
    CHECK_CLOSE(found[k].force, printed[k], 0, half_digit(printed[k]) + drive_error);
  }
}

/// One state against printed values of eight significant digits.
inline void check_states(const std::vector<Simulated>& found, std::size_t state,
                         const std::vector<double>& printed, double drive_error = 1e-9) {
  REQUIRE(found.size() == printed.size());
  for (std::size_t k = 0; k < printed.size(); ++k) {
    CAPTURE(found[k].t);
    CHECK_CLOSE(found[k].state[state], printed[k], 0, half_digit(printed[k]) + drive_error);
  }
}
