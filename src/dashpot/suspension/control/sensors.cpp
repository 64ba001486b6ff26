#include "dashpot/suspension/control/sensors.h"

#include <cmath>
#include <math.h>  // the C texts say isfinite, not std::isfinite
#include <utility>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/numerics/constants.h"

namespace dashpot {
namespace {

// clang-format off: the texts are taken in
#include "dashpot/suspension/control/c_text/leaky_integral.h"
#include "dashpot/suspension/control/c_text/filtered_slope.h"
// clang-format on

double quantised(double value, double resolution) {
  return resolution > 0 ? resolution * std::round(value / resolution) : value;
}

void require_at_least_zero(double value, const char* what) {
  if (!(value >= 0))
    throw Error("sensors", std::string(what) + " is " + format_number(value), "0 or more");
}

}  // namespace

Sensors::Sensors(const SensorOptions& o, std::size_t struts, double sample_time)
    : options_(o), dt_(sample_time), delay_(0), memories_(struts), random_(o.seed) {
  require_at_least_zero(o.acceleration_noise, "acceleration_noise");
  require_at_least_zero(o.acceleration_resolution, "acceleration_resolution");
  require_at_least_zero(o.deflection_noise, "deflection_noise");
  require_at_least_zero(o.deflection_resolution, "deflection_resolution");
  require_at_least_zero(o.delay, "delay");
  require_at_least_zero(o.integration_corner, "integration_corner");
  if (!(o.derivative_corner > 0)) throw Error("sensors", "derivative_corner is not above 0");
  if (o.delay > 1000 * sample_time)
    throw Error("sensors", "a delay of " + format_number(o.delay) + " s",
                "a thousand samples at most");

  // Coefficients of the filters at this sample time, and room for what the delay holds back.
  delay_ = static_cast<std::size_t>(std::lround(o.delay / sample_time));
  keep_ = std::exp(-kTurn * o.integration_corner * dt_);
  share_ = -std::expm1(-kTurn * o.derivative_corner * dt_);
  for (Memory& memory : memories_) memory.waiting.resize(delay_);
}

void Sensors::measure(std::span<StrutSignals> signals) {
  if (ideal()) return;
  for (std::size_t k = 0; k < signals.size(); ++k) measure(memories_[k], signals[k]);
  if (delay_ > 0) place_ = (place_ + 1) % delay_;
}

StrutSignals Sensors::delayed(Memory& memory, const StrutSignals& now) {
  if (delay_ == 0) return now;
  if (!memory.started) memory.waiting.assign(delay_, now);
  return std::exchange(memory.waiting[place_], now);
}

/// The body's velocity by integration that leaks; the deflection's by a filtered difference; the
/// wheel's as what is left between them.
void Sensors::measure(Memory& m, StrutSignals& s) {
  const StrutSignals seen = delayed(m, s);
  const double acceleration =
      quantised(seen.body_acceleration + options_.acceleration_noise * random_.normal(),
                options_.acceleration_resolution);
  const double deflection =
      quantised(seen.deflection + options_.deflection_noise * random_.normal(),
                options_.deflection_resolution);

  // Before the first sample the filters remember the same one.
  if (!m.started) {
    m.started = true;
    m.body[1] = acceleration;
    m.deflection[1] = deflection;
  }

  // The signals of a car's controller; force and current it knows as they are.
  s = {.body_velocity = leaky_integral(acceleration, keep_, dt_, m.body),
       .body_acceleration = acceleration,
       .deflection = deflection,
       .deflection_velocity = filtered_slope(deflection, share_, dt_, m.deflection),
       .force = s.force,
       .current = s.current};
  s.wheel_velocity = s.body_velocity - s.deflection_velocity;
}

}  // namespace dashpot
