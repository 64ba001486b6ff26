#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/ground_motion.h"

namespace dashpot {

/// Heights along the way.
struct RoadProfile {
  std::string description;
  double spacing = 0;                       ///< m
  std::vector<std::vector<double>> tracks;  ///< m; one, or left and right, of one length

  double length() const { return spacing * static_cast<double>(tracks.front().size() - 1); }
};

/// A profile driven over at `speed` m/s from its start: a cubic through its points, level before
/// and after. Tyres on a second track of a profile that has one see the first. Throws Error on less
/// than two points.
GroundPointer drive_over(RoadProfile profile, double speed);

/// ISO 8608: G_d(n) = G_d(n0) (n / n0)^-2, n0 = 0.1 cycle/m, one-sided.
constexpr double kReferenceWaveNumber = 0.1;
/// Geometric mean of G_d(n0) of class 'A' ... 'H', m^3. Throws Error at another letter.
double road_roughness(char road_class);
double road_density(double roughness, double wave_number);  ///< m^3 at n in cycle/m

/// One cosine of a road: amplitude m, wave number cycle/m, phase rad.
struct RoadWave {
  double amplitude, wave_number, phase;
};
double height_at(const std::vector<RoadWave>& waves, double distance);

struct RoadOptions {
  double roughness = 256e-6;                               ///< m^3, G_d(n0): class C
  double length = 1000;                                    ///< m
  double spacing = 0.02;                                   ///< m between the points of the profile
  double wave_number_min = 0.011, wave_number_max = 2.83;  ///< cycle/m
  std::size_t waves = 1000;                                ///< of a sum of cosines
  double track_width = 0;  ///< m between left and right; 0: one track
  std::uint64_t seed = 1;
};
/// Sum of cosines of equal steps in n, random phases, amplitudes sqrt(2 G_d dn). With two tracks,
/// those of an isotropic surface: the part that both share is the coherence 2 pi n t K_1(2 pi n t)
/// of Kamash and Robson (Vehicle System Dynamics 1978, recalled).
RoadProfile cosine_road(const RoadOptions& options);
/// The part of a wave that two such tracks share, from 0 to 1. width: m, above 0.
double shared_part(double wave_number, double width);
/// The amplitude of one of its waves.
double wave_amplitude(double roughness, double wave_number, double step);

/// The same by a fast Fourier transform: waves are all those within the band of which a whole
/// number fits into the road's length, rounded up; `waves` is not looked at. A hundredth of the
/// work.
RoadProfile harmonic_road(const RoadOptions& options);

/// White noise through a first-order filter along the way, z' = -2 pi n_min z + 2 pi n0 sqrt(G_d)
/// w, with w of one-sided density 1: as the filtered noise over time at any speed. wave_number_max
/// is that of its points.
RoadProfile filtered_road(const RoadOptions& options);

/// Measured profile: a file whose columns stand in pairs, distance and height, a pair per track,
/// all of one stretch of the way; units from the columns' names, else stated. Throws Error with
/// what is missing.
RoadProfile load_road(const std::filesystem::path& path, std::string_view distance_unit = {},
                      std::string_view height_unit = {});

}  // namespace dashpot
