#include "dashpot/suspension/ride/gain_curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "dashpot/numerics/constants.h"
#include "dashpot/suspension/ground/deterministic.h"

namespace dashpot {
namespace {

constexpr double kBeyond = 1.25;  // how far the chirp goes beyond the frequencies that are read
constexpr int kChirpPeriods = 4;

/// The response signals of a GainPoint, in its order, and its members.
struct Responses {
  std::array<const std::vector<double>*, 4> signals;
  const std::vector<double>*road, *velocity;
};
constexpr std::array<Gain GainPoint::*, 4> kGains{&GainPoint::body_acceleration, &GainPoint::body,
                                                  &GainPoint::tyre_deflection, &GainPoint::travel};

Responses responses_of(const Plant& plant, const Trace& trace) {
  const auto channel = [&](const std::string& name) { return &trace.record.channel(name).samples; };
  const std::string &body = plant.coordinates.front().name, &tyre = plant.tyres.front().name;
  return {{channel(body + "_acceleration"), channel(body), channel(tyre + "_deflection"),
           channel(plant.struts.front().name + "_deflection")},
          channel(tyre + "_road"),
          channel(plant.struts.front().name + "_velocity")};
}

GainPoint no_gain(double frequency) {
  GainPoint point{.frequency = frequency};
  for (const auto gain : kGains) point.*gain = {kNoNumber, kNoNumber};
  point.speed = kNoNumber;
  return point;
}

SimulateOptions simulate_options(const Vehicle& vehicle, double duration,
                                 const GainOptions& options) {
  SimulateOptions settings = vehicle.options(duration);
  settings.relative_tolerance = options.relative_tolerance;
  settings.monitor = options.monitor;
  return settings;
}

/// Over the samples first ... last - 1; the fundamental by the phase that the road had at each.
template <class Phase>
Gain gain_along(const std::vector<double>& y, const std::vector<double>& u, std::size_t first,
                std::size_t last, Phase phase) {
  std::complex<double> fy = 0, fu = 0;
  double yy = 0, uu = 0;
  for (std::size_t k = first; k < last; ++k) {
    const std::complex<double> turn = std::polar(1.0, -phase(k));
    fy += y[k] * turn;
    fu += u[k] * turn;
    yy += y[k] * y[k];
    uu += u[k] * u[k];
  }
  return {std::sqrt(yy / uu), std::abs(fy) / std::abs(fu)};
}

/// Over the samples first ... last - 1.
double greatest_speed(const std::vector<double>& velocity, std::size_t first, std::size_t last) {
  double greatest = 0;
  for (std::size_t k = first; k < last; ++k) greatest = std::max(greatest, std::abs(velocity[k]));
  return greatest;
}

}  // namespace

std::vector<double> usual_frequencies() {
  return {0.5, 0.75, 1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10, 11, 12, 13, 15, 20};
}

GainPoint gain_by_sine(const Vehicle& vehicle, double f, const GainOptions& options) {
  const int periods = std::max(4, static_cast<int>(std::lround(options.counted * f)));

  const GroundPointer sine = sine_ground(options.amplitude, f);
  const SimulateOptions settings =
      simulate_options(vehicle, options.settling + periods / f, options);
  const Trace trace = simulate(vehicle.on(*sine), settings);
  if (trace.diverged_at) return no_gain(f);

  // Over whole periods, after all has settled.
  const auto [signals, road, velocity] = responses_of(vehicle.set.plant, trace);
  GainPoint point{.frequency = f};
  for (std::size_t k = 0; k < kGains.size(); ++k)
    point.*kGains[k] = gain_at(*signals[k], *road, settings.output_step, f, periods);
  point.speed =
      greatest_speed(*velocity, velocity->size() - velocity->size() / 4, velocity->size());
  return point;
}

std::vector<GainPoint> gains_by_chirp(const Vehicle& vehicle,
                                      const std::vector<double>& frequencies,
                                      const GainOptions& options) {
  // One run on a chirp that goes a little beyond the frequencies that are read.
  const double f0 = frequencies.front() / kBeyond, f1 = frequencies.back() * kBeyond;
  const double duration = options.chirp;
  const GroundPointer chirp = chirp_ground(options.amplitude, f0, f1, duration, true);
  const SimulateOptions settings = simulate_options(vehicle, duration, options);
  const Trace trace = simulate(vehicle.on(*chirp), settings);
  const auto [signals, road, velocity] = responses_of(vehicle.set.plant, trace);

  // Each frequency over kChirpPeriods about the instant at which the chirp has it.
  std::vector<GainPoint> points;
  for (const double f : frequencies) {
    points.push_back(no_gain(f));
    if (trace.diverged_at) continue;
    const double at = duration * std::log(f / f0) / std::log(f1 / f0), h = settings.output_step;
    const double half = 0.5 * kChirpPeriods / f;
    const auto first = static_cast<std::size_t>(std::max(0.0, std::round((at - half) / h)));
    const auto last = std::min(road->size(), static_cast<std::size_t>(std::round((at + half) / h)));
    for (std::size_t k = 0; k < kGains.size(); ++k)
      points.back().*kGains[k] = gain_along(*signals[k], *road, first, last, [&](std::size_t i) {
        return exponential_chirp(f0, f1, duration, h * static_cast<double>(i)).phase;
      });
    points.back().speed = greatest_speed(*velocity, first, last);
  }
  return points;
}

}  // namespace dashpot
