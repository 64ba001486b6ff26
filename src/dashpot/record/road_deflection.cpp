#include "dashpot/record/road_deflection.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>

#include "dashpot/base/random.h"
#include "dashpot/error.h"
#include "dashpot/numerics/constants.h"

namespace dashpot {
namespace {

using Complex = std::complex<double>;

/// |deflection / road| at f Hz of the one-sensor paper's quarter-car (its table 7).
double deflection_gain(double f, double damping) {
  constexpr double kSprung = 387, kUnsprung = 139.5, kSpring = 37300, kTyre = 295200;  // kg, N/m
  const Complex s(0, kTurn * f), suspension = kSpring + damping * s, sprung = kSprung * s * s;
  return std::abs(kTyre * sprung /
                  ((kUnsprung * s * s + kTyre) * (sprung + suspension) + suspension * sprung));
}

/// m^2/Hz, one-sided: the road's power over time, G_d(n0) n0^2 v / f^2, through the car.
double deflection_density(const RoadDeflection& road, double f) {
  constexpr double kReference = 0.1;  // cycle/m
  const double gain = deflection_gain(f, road.damping);
  return road.roughness * kReference * kReference * road.vehicle_speed / (f * f) * gain * gain;
}

/// Displacement and velocity at equal steps of time, and the cubic that has both between them.
struct Knots {
  double step = 0;
  std::vector<double> x, v;

  MotionPoint at(double t) const {
    const double place = std::clamp(t / step, 0.0, static_cast<double>(x.size() - 1));
    const auto k = std::min(static_cast<std::size_t>(place), x.size() - 2);
    const double u = place - static_cast<double>(k), w = 1 - u;
    const double rise = x[k + 1] - x[k];
    return {x[k] + u * (rise * u * (3 - 2 * u) + step * w * (w * v[k] - u * v[k + 1])),
            6 * u * w * rise / step + w * (w - 2 * u) * v[k] + u * (u - 2 * w) * v[k + 1]};
  }
};

/// Adds a sine to the knots. Its phase turns by a constant angle from knot to knot, so that one
/// multiplication takes the place of a sine each.
void add_sine(Knots& knots, double amplitude, double f, double phase) {
  const Complex turn = std::polar(1.0, kTurn * f * knots.step);
  Complex now = std::polar(amplitude, phase);
  for (std::size_t k = 0; k < knots.x.size(); ++k, now *= turn) {
    knots.x[k] += now.real();
    knots.v[k] -= kTurn * f * now.imag();
  }
}

/// Fades in over the first second by a share whose slope is zero at both ends. The velocity gets
/// the share's own slope too, so that it stays the derivative of the displacement.
void fade_in(Knots& knots) {
  constexpr double kFade = 1;  // s
  const double w = std::numbers::pi / kFade;
  for (std::size_t k = 0; k < knots.x.size() && static_cast<double>(k) * knots.step < kFade; ++k) {
    const double t = static_cast<double>(k) * knots.step, share = 0.5 * (1 - std::cos(w * t));
    knots.v[k] = share * knots.v[k] + 0.5 * w * std::sin(w * t) * knots.x[k];
    knots.x[k] *= share;
  }
}

/// Scales down, never up, until amplitude and speed are kept between the knots, too.
void scale_into(Knots& knots, double amplitude, double speed_max) {
  const auto size = [](double a, double b) { return std::abs(a) < std::abs(b); };
  // Between knots a wave of 64 knots can rise by 1 - cos(pi / 64).
  const double margin = std::cos(std::numbers::pi / 64);
  const double x = std::abs(*std::ranges::max_element(knots.x, size)) / margin;
  const double v = std::abs(*std::ranges::max_element(knots.v, size)) / margin;
  const double scale = std::min({1.0, amplitude / x, speed_max / v});
  for (double& value : knots.x) value *= scale;
  for (double& value : knots.v) value *= scale;
}

}  // namespace

PistonMotion road_deflection(const RoadDeflection& road, std::uint64_t seed) {
  constexpr int kSines = 300;
  if (!(road.frequency_min < road.frequency_max))
    throw Error("RP", "frequency_min is not below frequency_max");

  // Knots 64 to the shortest period, one more than the duration needs at the end.
  Random random(seed);
  auto knots = std::make_shared<Knots>();
  knots->step = 1 / (64 * road.frequency_max);
  const auto count = static_cast<std::size_t>(std::ceil(road.duration / knots->step)) + 2;
  knots->x.assign(count, 0);
  knots->v.assign(count, 0);

  // One sine from each of equal bands, with a random frequency within it and a random phase.
  const double band = (road.frequency_max - road.frequency_min) / kSines;
  for (int k = 0; k < kSines; ++k) {
    const double f = road.frequency_min + band * (k + random.uniform());
    add_sine(*knots, std::sqrt(2 * deflection_density(road, f) * band), f,
             random.uniform(0, kTurn));
  }

  fade_in(*knots);
  scale_into(*knots, road.amplitude, road.speed_max);
  return {{}, road.duration, [knots](double t) { return knots->at(t); }};
}

}  // namespace dashpot
