#include "dashpot/suspension/ground/ground_sequences.h"

#include <array>
#include <filesystem>

#include "dashpot/base/settings.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/suspension/ground/deterministic.h"
#include "dashpot/suspension/ground/recorded_ground.h"
#include "dashpot/suspension/ground/road_profile.h"

namespace dashpot {
namespace {

constexpr ParameterRow kRoughness{
    "roughness", "m^3", 256e-6, 1e-9, 1, "G_d at 0.1 cycle/m; class=A ... H stands for it"};
constexpr ParameterRow kSpeedRow{"speed", "m/s", 20, 0.1, 200, "of the vehicle"};
constexpr ParameterRow kLength{"length", "m", 1000, 1, 1e6, "of the road"};
constexpr ParameterRow kLeast{"wave_number_min",          "1/m", 0.011, 1e-4, 100,
                              "longest wave: 1 over this"};
constexpr ParameterRow kGreatestRow{"wave_number_max",           "1/m", 2.83, 1e-3, 1000,
                                    "shortest wave: 1 over this"};
constexpr ParameterRow kTrackWidth{
    "track_width", "m", 0, 0, 10, "between left and right; 0: one track"};
constexpr ParameterRow kAmplitude{"amplitude", "m", 0.01, 1e-6, 10, "of the sine"};
constexpr ParameterRow kFrom{"from", "Hz", 0.5, 1e-3, 1000, "first frequency"};
constexpr ParameterRow kTo{"to", "Hz", 20, 1e-3, 1000, "last frequency"};
constexpr ParameterRow kDuration{"duration", "s", 30, 1e-2, 1e5, "of the sweep"};
constexpr std::string_view kChirps = "the one-sensor paper sweeps 2 cm over 0.5 ... 20 Hz";

struct WaveRoad {
  double roughness, speed, length, least, greatest, track_width, waves;
};
RoadOptions options_of(const WaveRoad& p, std::uint64_t seed) {
  return {.roughness = p.roughness,
          .length = p.length,
          .spacing = 0.1 / p.greatest,
          .wave_number_min = p.least,
          .wave_number_max = p.greatest,
          .waves = static_cast<std::size_t>(p.waves),
          .track_width = p.track_width,
          .seed = seed};
}
GroundPointer make_cosine_road(std::span<const double> values, std::uint64_t seed) {
  const auto p = values_as<WaveRoad>(values);
  return drive_over(cosine_road(options_of(p, seed)), p.speed);
}
GroundPointer make_harmonic_road(std::span<const double> v, std::uint64_t seed) {
  const WaveRoad p{v[0], v[1], v[2], v[3], v[4], v[5], 0};
  return drive_over(harmonic_road(options_of(p, seed)), p.speed);
}

struct FilteredRoad {
  double roughness, speed, length, least, spacing;
};
GroundPointer make_filtered_road(std::span<const double> values, std::uint64_t seed) {
  const auto p = values_as<FilteredRoad>(values);
  return drive_over(filtered_road({.roughness = p.roughness,
                                   .length = p.length,
                                   .spacing = p.spacing,
                                   .wave_number_min = p.least,
                                   .wave_number_max = 0.5 / p.spacing,
                                   .seed = seed}),
                    p.speed);
}

const std::array kSequences{
    GroundSequence{{.name = "bump",
                    .title = "One bump",
                    .equation = "z = (height / 2) (1 - cos(2 pi s / length)), 0 <= s <= length",
                    .source = "common practice",
                    .remarks = "",
                    .params = {{"height", "m", 0.08, -1, 1, "at its middle"},
                               {"length", "m", 3, 0.01, 100, "along the way"},
                               kSpeedRow,
                               {"at", "m", 10, 0, 1e5, "where it begins"}}},
                   [](std::span<const double> v, std::uint64_t) {
                     return bump_ground(v[0], v[1], v[2], v[3]);
                   }},
    GroundSequence{
        {.name = "chirp",
         .title = "Linear chirp",
         .equation = "z = A sin 2 pi (f0 t + (f1 - f0) t^2 / (2 T))",
         .source = kChirps,
         .remarks = "",
         .params = {{"amplitude", "m", 0.02, 1e-6, 10, "of the sine"}, kFrom, kTo, kDuration}},
        [](std::span<const double> v, std::uint64_t) {
          return chirp_ground(v[0], v[1], v[2], v[3], false);
        }},
    GroundSequence{
        {.name = "exponential_chirp",
         .title = "Exponential chirp",
         .equation = "z = A sin(2 pi f0 T / ln(f1/f0) ((f1/f0)^(t/T) - 1))",
         .source = kChirps,
         .remarks = "As long in each octave.",
         .params = {{"amplitude", "m", 0.02, 1e-6, 10, "of the sine"}, kFrom, kTo, kDuration}},
        [](std::span<const double> v, std::uint64_t) {
          return chirp_ground(v[0], v[1], v[2], v[3], true);
        }},
    GroundSequence{
        {.name = "filtered_noise",
         .title = "ISO 8608 road, filtered white noise",
         .equation =
             "z' = -2 pi n_min z + 2 pi n0 sqrt(G_d) w along the way, w of one-sided density 1",
         .source = "ISO 8608",
         .remarks = "Quick to make; one track; rolls off below wave_number_min.",
         .params = {kRoughness,
                    kSpeedRow,
                    kLength,
                    kLeast,
                    {"spacing", "m", 0.05, 1e-3, 1, "between points"}}},
        make_filtered_road},
    GroundSequence{
        {.name = "iso8608",
         .title = "ISO 8608 road, sum of cosines",
         .equation = "z = sum sqrt(2 G_d(n) dn) cos(2 pi n s + phi),  G_d(n) = G_d(n0) (n / n0)^-2",
         .source = "ISO 8608",
         .remarks = "With a track width, left and right are those of an isotropic surface. The "
                    "first metres rise from level.",
         .params = {kRoughness,
                    kSpeedRow,
                    kLength,
                    kLeast,
                    kGreatestRow,
                    kTrackWidth,
                    {"waves", "1", 1000, 10, 1e5, "cosines", true}}},
        make_cosine_road},
    GroundSequence{{.name = "iso8608_fft",
                    .title = "ISO 8608 road, sum of harmonics by Fourier transform",
                    .equation = "z = sum sqrt(2 G_d(n) / L) cos(2 pi n s + phi), n = 1/L, 2/L, ...",
                    .source = "ISO 8608",
                    .remarks = "A hundredth of the work of the sum of cosines; repeats itself "
                               "after L, the length in points rounded up to a power of two.",
                    .params = {kRoughness, kSpeedRow, kLength, kLeast, kGreatestRow, kTrackWidth}},
                   make_harmonic_road},
    GroundSequence{
        {.name = "sine",
         .title = "Sine",
         .equation = "z = A sin(2 pi f t)",
         .source = "common practice",
         .remarks = "",
         .params = {kAmplitude, {"frequency", "Hz", 1, 1e-3, 1000, ""}}},
        [](std::span<const double> v, std::uint64_t) { return sine_ground(v[0], v[1]); }},
    GroundSequence{
        {.name = "step",
         .title = "Step",
         .equation = "z = height from `at` on",
         .source = "the one-sensor paper steps by 3 cm",
         .remarks = "",
         .params = {{"height", "m", 0.03, -1, 1, "of the step"}, {"at", "s", 0, 0, 1e5, "when"}}},
        [](std::span<const double> v, std::uint64_t) { return step_ground(v[0], v[1]); }}};

/// "class=C" as "roughness=0.000256".
std::string without_class(const std::string& text) {
  constexpr std::string_view kKey = "class=";
  const std::string_view spelled = trim(text);
  if (!spelled.starts_with(kKey)) return text;
  const std::string_view name = trim(spelled.substr(kKey.size()));
  const char letter = name.size() == 1 ? static_cast<char>(name[0] & ~0x20) : '?';
  return "roughness=" + format_exact(road_roughness(letter));
}

}  // namespace

std::span<const GroundSequence> ground_sequences() { return kSequences; }

const GroundSequence& find_ground_sequence(std::string_view name, const std::string& where) {
  std::vector<std::string> known;
  for (const GroundSequence& sequence : kSequences) {
    if (sequence.info.name == name) return sequence;
    known.emplace_back(sequence.info.name);
  }
  for (const RecordedGround& kind : recorded_grounds()) known.emplace_back(kind.name);

  const std::string file(name);
  if (std::filesystem::path(file).has_extension())
    throw Error(where, "'" + file + "' is no kind of ground",
                "of a file: measured,file=" + file +
                    " (heights over distance) or earthquake,file=" + file + " (accelerations)");
  throw Error(where, "unknown motion of the ground '" + std::string(name) + "'",
              suggest(name, known));
}

GroundPointer make_ground(const std::string& text, std::uint64_t seed, const std::string& where) {
  std::vector<std::string> parts = split_words(text, where);
  for (const RecordedGround& kind : recorded_grounds())
    if (kind.name == parts.front())
      return make_recorded_ground(kind, std::span(parts).subspan(1), where);
  const GroundSequence& sequence = find_ground_sequence(parts.front(), where);
  for (std::string& part : parts) part = without_class(part);
  if (stated_twice(parts))
    throw Error(where, "class stands beside roughness, which it stands for", "one of the two");
  return sequence.make(
      parse_values(sequence.info.params, std::span(parts).subspan(1), sequence.info.name, where),
      seed);
}

}  // namespace dashpot
