#include "dashpot/suspension/road_profile.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "dashpot/base/error.h"
#include "dashpot/base/random.h"
#include "dashpot/base/text.h"

namespace dashpot {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

class DrivenRoad final : public GroundMotion {
 public:
  DrivenRoad(RoadProfile profile, double speed) : profile_(std::move(profile)), speed_(speed) {
    for (const std::vector<double>& heights : profile_.tracks) slopes_.push_back(slopes_of(heights));
  }
  bool is_steady() const noexcept override { return true; }
  std::string description() const override {
    return profile_.description + ", at " + format_number(speed_) + " m/s";
  }
  double duration() const noexcept override { return profile_.length() / speed_; }
  double speed() const noexcept override { return speed_; }
  FootMotion foot(double t, std::size_t track, double behind) const noexcept override {
    const std::size_t which = std::min(track, profile_.tracks.size() - 1);
    const std::vector<double>&z = profile_.tracks[which], &slope = slopes_[which];
    const double place = (speed_ * t - behind) / profile_.spacing;
    if (!(place > 0)) return {z.front(), 0};
    if (place >= static_cast<double>(z.size() - 1)) return {z.back(), 0};
    const auto k = static_cast<std::size_t>(place);
    const double u = place - static_cast<double>(k), w = 1 - u, rise = z[k + 1] - z[k];
    return {z[k] + u * (rise * u * (3 - 2 * u) + w * (w * slope[k] - u * slope[k + 1])),
            speed_ / profile_.spacing *
                (6 * u * w * rise + w * (w - 2 * u) * slope[k] + u * (u - 2 * w) * slope[k + 1])};
  }

 private:
  /// Per spacing, central; level at both ends, where the road goes on level.
  static std::vector<double> slopes_of(const std::vector<double>& z) {
    std::vector<double> slopes(z.size());
    for (std::size_t k = 1; k + 1 < z.size(); ++k) slopes[k] = 0.5 * (z[k + 1] - z[k - 1]);
    return slopes;
  }

  RoadProfile profile_;
  double speed_;
  std::vector<std::vector<double>> slopes_;
};

/// Begins level and at 0, over a twentieth of a second's way at most: a car does not fall onto the road.
void begin_level(RoadProfile& road) {
  constexpr double kRamp = 5;  // m
  const auto count = static_cast<std::size_t>(std::min(kRamp, 0.1 * road.length()) / road.spacing);
  for (std::vector<double>& z : road.tracks)
    for (std::size_t k = 0; k < count; ++k) {
      const double u = static_cast<double>(k) / static_cast<double>(count);
      z[k] *= u * u * (3 - 2 * u);
    }
}

/// Each cosine turns by a constant angle from point to point.
void add_wave(std::vector<double>& heights, double spacing, const RoadWave& wave) {
  const std::complex<double> turn = std::polar(1.0, kTurn * wave.wave_number * spacing);
  std::complex<double> now = std::polar(wave.amplitude, wave.phase);
  for (double& height : heights) {
    height += now.real();
    now *= turn;
  }
}

double shared_part(double wave_number, double width) {
  const double x = kTurn * wave_number * width;
  return std::min(1.0, x * std::cyl_bessel_k(1.0, x));
}

void require_usable(const RoadOptions& o) {
  if (!(o.spacing > 0 && o.length > 2 * o.spacing))
    throw Error(
        "road",
        "a length of " + format_number(o.length) + " m in steps of " + format_number(o.spacing) + " m",
        "more than two steps");
  if (!(o.wave_number_min > 0 && o.wave_number_min < o.wave_number_max))
    throw Error("road",
                "wave numbers from " + format_number(o.wave_number_min) + " to " +
                    format_number(o.wave_number_max) + " cycle/m",
                "rising, above 0");
  if (!(o.roughness > 0)) throw Error("road", "the roughness is not above 0");
}

std::string described(const char* generator, const RoadOptions& o) {
  std::string text = std::string(generator) + ": G_d(n0) " + format_number(1e6 * o.roughness) +
                     "e-6 m^3, seed " + std::to_string(o.seed);
  if (o.track_width > 0) text += ", tracks " + format_number(o.track_width) + " m apart";
  return text;
}

RoadProfile empty_road(const char* generator, const RoadOptions& o) {
  require_usable(o);
  const auto count = static_cast<std::size_t>(std::ceil(o.length / o.spacing)) + 1;
  return {described(generator, o), o.spacing,
          std::vector(o.track_width > 0 ? 2 : 1, std::vector<double>(count))};
}

}  // namespace

GroundPointer drive_over(RoadProfile profile, double speed) {
  if (profile.tracks.empty() || profile.tracks.front().size() < 2 || !(profile.spacing > 0))
    throw Error("road", "has less than two points");
  if (!(speed > 0)) throw Error("road", "a speed of " + format_number(speed) + " m/s", "above 0");
  return std::make_unique<DrivenRoad>(std::move(profile), speed);
}

double road_roughness(char road_class) {
  if (road_class < 'A' || road_class > 'H')
    throw Error("road", std::string("unknown class '") + road_class + "'", "A (smooth) to H");
  return 16e-6 * std::pow(4.0, road_class - 'A');
}

double road_density(double roughness, double wave_number) {
  const double ratio = kReferenceWaveNumber / wave_number;
  return roughness * ratio * ratio;
}

double wave_amplitude(double roughness, double wave_number, double step) {
  return std::sqrt(2 * road_density(roughness, wave_number) * step);
}

double height_at(const std::vector<RoadWave>& waves, double distance) {
  double height = 0;
  for (const RoadWave& wave : waves)
    height += wave.amplitude * std::cos(kTurn * wave.wave_number * distance + wave.phase);
  return height;
}

RoadProfile cosine_road(const RoadOptions& o) {
  RoadProfile road = empty_road("ISO 8608, sum of cosines", o);
  Random random(o.seed);
  const double step = (o.wave_number_max - o.wave_number_min) / static_cast<double>(o.waves);
  for (std::size_t k = 0; k < o.waves; ++k) {
    // Anywhere within its step: whole multiples of one step would make the road repeat itself.
    const double n = o.wave_number_min + step * (static_cast<double>(k) + random.uniform());
    const double amplitude = wave_amplitude(o.roughness, n, step);
    const double phase = random.uniform(0, kTurn), own_phase = random.uniform(0, kTurn);
    add_wave(road.tracks[0], o.spacing, {amplitude, n, phase});
    if (road.tracks.size() < 2) continue;
    const double shared = shared_part(n, o.track_width);
    add_wave(road.tracks[1], o.spacing, {shared * amplitude, n, phase});
    add_wave(road.tracks[1], o.spacing, {std::sqrt(1 - shared * shared) * amplitude, n, own_phase});
  }
  begin_level(road);
  return road;
}

RoadProfile filtered_road(const RoadOptions& o) {
  if (o.track_width > 0)
    throw Error("road", "filtered noise makes one track", "the sum of cosines makes two");
  RoadProfile road = empty_road("ISO 8608, filtered noise", o);
  Random random(o.seed);
  const double rate = kTurn * o.wave_number_min, keep = std::exp(-rate * o.spacing);
  // One-sided density 1 needs a variance of 1 / (2 ds).
  const double gain =
      kTurn * kReferenceWaveNumber * std::sqrt(o.roughness / (2 * o.spacing)) * (1 - keep) / rate;
  double height = 0;
  for (double& z : road.tracks[0]) {
    z = height;
    height = keep * height + gain * random.normal();
  }
  return road;
}

}  // namespace dashpot
