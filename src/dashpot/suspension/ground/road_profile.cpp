#include "dashpot/suspension/ground/road_profile.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "dashpot/base/random.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/numerics/constants.h"
#include "dashpot/numerics/spectrum.h"

namespace dashpot {
namespace {

/// Heights at points, a cubic between each two with central slopes. One more at each end mirrors
/// the track there, so that it is level where the road goes on level.
struct TrackPoints {
  const double* z;
  double last;        ///< place of the last but the mirrored one, from 0
  double per_second;  ///< how many pass
};
/// A place between two points: which is the first of them, and the share of the way to the next.
struct TrackPlace {
  int point;
  double share;
};

/// Where a way of so many points, held within the track, leads.
inline TrackPlace place_at(const TrackPoints& track, double reached) {
  const double ahead = reached > 0 ? reached : 0, last = track.last;
  const double place = ahead < last ? ahead : last, left = place < last - 1 ? place : last - 1;
  const int point = static_cast<int>(left);
  return {point, place - point};
}

/// The cubic between the middle two of four points, at a share of the way, and its slope per point.
/// Number: double, or several places side by side.
template <class Number>
struct Cubic {
  Number height, slope;
};
template <class Number>
[[gnu::always_inline]] inline Cubic<Number> cubic_at(Number z0, Number z1, Number z2, Number z3,
                                                     Number u) {
  const Number rise = z2 - z1, slope = 0.5 * (z2 - z0);
  const Number twist = slope + 0.5 * (z3 - z1) - 2 * rise, bend = rise - slope - twist;
  return {z1 + u * (slope + u * (bend + u * twist)), slope + u * (2 * bend + 3 * u * twist)};
}

inline FootMotion motion_at(const TrackPoints& track, TrackPlace place) {
  const double* z = track.z + place.point;
  const auto at = cubic_at(z[0], z[1], z[2], z[3], place.share);
  return {at.height, track.per_second * at.slope};
}

constexpr int kTogether = 4;
typedef double Places __attribute__((vector_size(kTogether * sizeof(double))));

/// Heights and slopes at four places: the four points of each are loaded as one, and turned so that
/// the first points of all stand side by side.
[[gnu::always_inline]] inline Cubic<Places> cubics_at(const double* z, const int* points,
                                                      const double* shares) {
  Places of[kTogether];
  for (int n = 0; n < kTogether; ++n) std::memcpy(&of[n], z + points[n], sizeof of[n]);
  const Places u{shares[0], shares[1], shares[2], shares[3]};
  const Places a = __builtin_shufflevector(of[0], of[1], 0, 4, 2, 6),
               b = __builtin_shufflevector(of[0], of[1], 1, 5, 3, 7),
               c = __builtin_shufflevector(of[2], of[3], 0, 4, 2, 6),
               d = __builtin_shufflevector(of[2], of[3], 1, 5, 3, 7);
  return cubic_at<Places>(
      __builtin_shufflevector(a, c, 0, 1, 4, 5), __builtin_shufflevector(b, d, 0, 1, 4, 5),
      __builtin_shufflevector(a, c, 2, 3, 6, 7), __builtin_shufflevector(b, d, 2, 3, 6, 7), u);
}

/// Heights and rates at these places, several side by side. kCount: how many, where that is known.
template <std::size_t kCount = std::dynamic_extent>
[[gnu::always_inline]] inline void motions_at(const TrackPoints& track, const int* points,
                                              const double* shares,
                                              std::span<FootMotion, kCount> out) {
  const int count = static_cast<int>(out.size());
  int n = 0;
  for (; n + kTogether <= count; n += kTogether) {
    const auto at = cubics_at(track.z, points + n, shares + n);
    for (int k = 0; k < kTogether; ++k) out[n + k] = {at.height[k], track.per_second * at.slope[k]};
  }
  for (; n < count; ++n) out[n] = motion_at(track, {points[n], shares[n]});
}

/// Heights and rates at places begin, begin + step, ... in points. Places are found first and
/// heights then.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
[[gnu::target_clones("default", "avx2", "avx512f")]]
#endif
void pass_over(const TrackPoints& track, double begin, double step, std::span<FootMotion> out) {
  constexpr int kChunk = 64;
  int points[kChunk];
  double shares[kChunk];
  for (std::size_t first = 0; first < out.size(); first += kChunk) {
    const std::span<FootMotion> some =
        out.subspan(first, std::min<std::size_t>(kChunk, out.size() - first));
    const double from = begin + step * static_cast<double>(first);
    for (int n = 0; n < kChunk; ++n) {
      const TrackPlace place = place_at(track, from + step * n);
      points[n] = place.point;
      shares[n] = place.share;
    }
    motions_at(track, points, shares, some);
  }
}

/// The same where `behind` points less than the way that these instants, s, lead to.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
[[gnu::target_clones("default", "avx2", "avx512f")]]
#endif
void meet_at(const TrackPoints& track, std::span<const double> t, double behind,
             std::span<FootMotion> out) {
  constexpr std::size_t kStep = 5;  // an integrator's step asks for so many
  const auto meet = [&](auto at, auto motions) __attribute__((always_inline)) {
    int points[kStep];
    double shares[kStep];
    for (std::size_t n = 0; n < motions.size(); ++n) {
      const TrackPlace place = place_at(track, track.per_second * at[n] - behind);
      points[n] = place.point;
      shares[n] = place.share;
    }
    motions_at(track, points, shares, motions);
  };

  std::size_t first = 0;
  for (; first + kStep <= out.size(); first += kStep)
    meet(t.subspan(first).first<kStep>(), out.subspan(first).first<kStep>());
  meet(t.subspan(first), out.subspan(first));
}

class DrivenRoad final : public GroundMotion {
 public:
  DrivenRoad(RoadProfile profile, double speed)
      : profile_(std::move(profile)), speed_(speed), points_per_second_(speed / profile_.spacing) {
    for (const std::vector<double>& heights : profile_.tracks)
      points_.push_back(mirrored_at_ends(heights));
    for (const std::vector<double>& points : points_)
      tracks_.push_back(
          {points.data(), static_cast<double>(points.size() - 3), points_per_second_});
  }
  bool is_steady() const noexcept override { return true; }
  std::string description() const override {
    return profile_.description + ", at " + format_number(speed_) + " m/s";
  }
  double duration() const noexcept override { return profile_.length() / speed_; }
  double speed() const noexcept override { return speed_; }
  FootMotion foot(double t, std::size_t track, double behind) const noexcept override {
    const TrackPoints& points = track_points(track);
    return motion_at(points, place_at(points, points_at(t, behind)));
  }
  void feet(double t, double step, std::size_t track, double behind,
            std::span<FootMotion> out) const noexcept override {
    pass_over(track_points(track), points_at(t, behind), points_per_second_ * step, out);
  }
  void feet_at(std::span<const double> t, std::size_t track, double behind,
               std::span<FootMotion> out) const noexcept override {
    meet_at(track_points(track), t, behind / profile_.spacing, out);
  }

 private:
  const TrackPoints& track_points(std::size_t track) const noexcept {
    return tracks_[std::min(track, tracks_.size() - 1)];
  }
  /// The way, in points, of a foot so far behind.
  double points_at(double t, double behind) const noexcept {
    const double way = points_per_second_ * t;
    return behind == 0 ? way : way - behind / profile_.spacing;
  }
  static std::vector<double> mirrored_at_ends(const std::vector<double>& z) {
    std::vector<double> points{z[1]};
    points.insert(points.end(), z.begin(), z.end());
    points.push_back(z[z.size() - 2]);
    return points;
  }

  RoadProfile profile_;
  double speed_, points_per_second_;
  std::vector<std::vector<double>> points_;  ///< of each track
  std::vector<TrackPoints> tracks_;          ///< the same as they are met
};

/// Lets the road rise from level and 0 over its first metres: a car does not fall onto the road.
void start_level(RoadProfile& road) {
  constexpr double kRamp = 5;  // m
  const auto count = static_cast<std::size_t>(std::min(kRamp, 0.1 * road.length()) / road.spacing);
  for (std::vector<double>& z : road.tracks)
    for (std::size_t k = 0; k < count; ++k) {
      const double u = static_cast<double>(k) / static_cast<double>(count);
      z[k] *= u * u * (3 - 2 * u);
    }
}

/// Each cosine turns by a constant angle from point to point; several points at once, since each
/// turn waits for the one before.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
[[gnu::target_clones("default", "avx2", "avx512f")]]  // the same sums, side by side
#endif
void add_wave(std::vector<double>& heights, double spacing, const RoadWave& wave) {
  constexpr std::size_t kPoints = 8;
  const double angle = kTurn * wave.wave_number * spacing;
  const double c = std::cos(kPoints * angle), s = std::sin(kPoints * angle);

  // The first kPoints points of the wave.
  double re[kPoints], im[kPoints];
  for (std::size_t j = 0; j < kPoints; ++j) {
    re[j] = wave.amplitude * std::cos(wave.phase + angle * static_cast<double>(j));
    im[j] = wave.amplitude * std::sin(wave.phase + angle * static_cast<double>(j));
  }

  // All further ones: each point turns by kPoints angles at a time.
  std::size_t k = 0;
  for (double* at = heights.data(); k + kPoints <= heights.size(); k += kPoints, at += kPoints)
    for (std::size_t j = 0; j < kPoints; ++j) {
      at[j] += re[j];
      const double turned = c * re[j] - s * im[j];
      im[j] = s * re[j] + c * im[j];
      re[j] = turned;
    }
  for (std::size_t j = 0; k < heights.size(); ++j, ++k) heights[k] += re[j];
}

void require_usable(const RoadOptions& o) {
  if (!(o.spacing > 0 && o.length > 2 * o.spacing))
    throw Error("road",
                "a length of " + format_number(o.length) + " m in steps of " +
                    format_number(o.spacing) + " m",
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

double shared_part(double wave_number, double width) {
  const double x = kTurn * wave_number * width;
  return std::min(1.0, x * std::cyl_bessel_k(1.0, x));
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
  start_level(road);
  return road;
}

RoadProfile harmonic_road(const RoadOptions& o) {
  RoadProfile road = empty_road("ISO 8608, sum of harmonics", o);

  // Lines of the spectrum at whole multiples of 1 / L, with L a power of two of points.
  const std::size_t points = std::bit_ceil(road.tracks[0].size());
  const double step = 1 / (o.spacing * static_cast<double>(points));
  std::vector<std::vector<std::complex<double>>> lines(road.tracks.size());
  for (auto& track : lines) track.resize(points / 2);
  Random random(o.seed);

  // Waves of the band, with random phases; a second track shares the coherent part.
  const auto first = static_cast<std::size_t>(std::ceil(o.wave_number_min / step));
  for (std::size_t k = first; k < points / 2 && step * static_cast<double>(k) <= o.wave_number_max;
       ++k) {
    const double n = step * static_cast<double>(k),
                 amplitude = wave_amplitude(o.roughness, n, step);
    lines[0][k] = std::polar(amplitude, random.uniform(0, kTurn));
    if (lines.size() < 2) continue;
    const double shared = shared_part(n, o.track_width);
    lines[1][k] = shared * lines[0][k] +
                  std::polar(std::sqrt(1 - shared * shared) * amplitude, random.uniform(0, kTurn));
  }

  // Heights by one transform per track.
  for (std::size_t t = 0; t < lines.size(); ++t) {
    const std::vector<double> heights = sum_of_harmonics(lines[t], points);
    std::copy_n(heights.begin(), road.tracks[t].size(), road.tracks[t].begin());
  }
  start_level(road);
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
