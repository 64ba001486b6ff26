#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/numerics/constants.h"
#include "dashpot/parameter_table.h"
#include "dashpot/record/excitation.h"
#include "dashpot/record/road_deflection.h"

namespace dashpot {
namespace {

struct AmplitudeModulated {
  double amplitude, speed_max, carrier, modulation, depth, duration;
};

/// The amplitude starts at its least, so that the motion starts at rest.
PistonMotion amplitude_modulated(std::span<const double> values, std::uint64_t) {
  const auto p = values_as<AmplitudeModulated>(values);
  const double w = kTurn * p.carrier, slow = kTurn * p.modulation, share = p.depth / (1 + p.depth);
  const double most = std::min(p.amplitude, p.speed_max / (w + slow * share));
  return {{}, p.duration, [=](double t) -> MotionPoint {
            const double size = most * (1 - share - share * std::cos(slow * t));
            const double growth = most * share * slow * std::sin(slow * t);
            return {-size * std::cos(w * t), size * w * std::sin(w * t) - growth * std::cos(w * t)};
          }};
}

struct FrequencyModulated {
  double amplitude, speed_max, frequency_min, frequency_max, modulation, duration;
};

void require_band(double low, double high, std::string_view name) {
  if (!(low <= high))
    throw Error(std::string(name), "its band of frequencies ends below its start");
}

/// Where the speed limit reduces the amplitude, the amplitude changes with the frequency. This is
/// the most of that extra speed, as a share of speed_max: the greatest f' / (2 pi f^2).
double speed_of_amplitude(double mean, double swing, double slow) {
  const double c = 4 * swing / (mean + std::sqrt(mean * mean + 8 * swing * swing));
  const double f = mean - swing * c;
  return swing * slow * std::sqrt(1 - c * c) / (kTurn * f * f);
}

/// The amplitude bends smoothly from its own to the one that the speed allows, below both.
PistonMotion frequency_modulated(std::span<const double> values, std::uint64_t) {
  const auto p = values_as<FrequencyModulated>(values);
  require_band(p.frequency_min, p.frequency_max, "FM");

  // Frequency between the two as mean - swing cos(slow t); the speed limit leaves room for the
  // changing amplitude.
  const double mean = 0.5 * (p.frequency_min + p.frequency_max), swing = p.frequency_max - mean;
  const double slow = kTurn * p.modulation;
  const double speed = p.speed_max / std::hypot(1, speed_of_amplitude(mean, swing, slow));

  return {{}, p.duration, [=](double t) -> MotionPoint {
            constexpr double kSharpness = 8;
            const double f = mean - swing * std::cos(slow * t),
                         rise = swing * slow * std::sin(slow * t);
            const double phase = kTurn * mean * t - swing / p.modulation * std::sin(slow * t);
            const double excess = std::pow(kTurn * f * p.amplitude / speed, kSharpness);
            const double size = p.amplitude * std::pow(1 + excess, -1 / kSharpness);
            const double growth = -size * excess / (1 + excess) * rise / f;
            return {-size * std::cos(phase),
                    size * kTurn * f * std::sin(phase) - growth * std::cos(phase)};
          }};
}

/// Pieces of motion that follow each other, and again from the first one.
template <class Piece>
struct Pieces {
  std::vector<double> begins;
  std::vector<Piece> pieces;
  double length = 0;

  void add(const Piece& piece) {
    begins.push_back(length);
    pieces.push_back(piece);
    length += piece.duration();
  }
  MotionPoint at(double t) const {
    const double within = std::fmod(std::max(t, 0.0), length);
    const auto k =
        static_cast<std::size_t>(std::ranges::upper_bound(begins, within) - begins.begin()) - 1;
    return pieces[k].at(within - begins[k]);
  }
};

template <class Piece>
PistonMotion as_motion(Pieces<Piece> pieces, double repeats) {
  const double duration = repeats * pieces.length;
  return {{}, duration, [all = std::make_shared<const Pieces<Piece>>(std::move(pieces))](double t) {
            return all->at(t);
          }};
}

/// Whole periods of a sine, with half a period before and behind them in which it comes and goes.
struct Packet {
  double amplitude, frequency, periods;

  double duration() const { return (periods + 1) / frequency; }
  MotionPoint at(double t) const {
    const double phase = kTurn * frequency * t, to_end = kTurn * (periods + 1) - phase;
    const double edge = std::min({phase, to_end, std::numbers::pi});
    const double share = 0.5 * (1 - std::cos(edge));
    const double change = 0.5 * std::sin(edge) * (phase <= to_end ? 1 : -1);
    return {amplitude * share * std::sin(phase),
            amplitude * kTurn * frequency * (share * std::cos(phase) + change * std::sin(phase))};
  }
};

struct SteppedFrequency {
  double amplitude, speed_max, frequency_min, frequency_max, step, hold, repeats;
};

PistonMotion stepped_frequency(std::span<const double> values, std::uint64_t) {
  const auto p = values_as<SteppedFrequency>(values);
  require_band(p.frequency_min, p.frequency_max, "SFS");

  constexpr double kMost = 10000, kRounding = 1e-9;
  const double last = std::floor((p.frequency_max - p.frequency_min) / p.step + kRounding);
  if (last >= kMost) throw Error("SFS", format_number(last) + " frequencies", "a larger step");

  // One packet for each frequency: whole periods, at least for the time to hold.
  Pieces<Packet> packets;
  for (int k = 0; k <= static_cast<int>(last); ++k) {
    const double f = p.frequency_min + k * p.step;
    packets.add({std::min(p.amplitude, p.speed_max / (kTurn * f)), f,
                 std::max(1.0, std::ceil(p.hold * f))});
  }
  return as_motion(std::move(packets), p.repeats);
}

/// From one end to the other at a constant speed, with a constant acceleration at both ends.
struct Stroke {
  double from, distance, speed, acceleration, side;

  double duration() const { return distance / speed + speed / acceleration; }
  MotionPoint at(double t) const {
    const double ramp = speed / acceleration, left = duration() - t;
    double travelled = speed * (t - 0.5 * ramp), now = speed;
    if (t < ramp) {
      travelled = 0.5 * acceleration * t * t;
      now = acceleration * t;
    } else if (left < ramp) {
      travelled = distance - 0.5 * acceleration * left * left;
      now = acceleration * left;
    }
    return {from + side * travelled, side * now};
  }
};

struct VariableSlopes {
  double amplitude, speed_min, speed_max, levels, cycles, acceleration, repeats;
};

PistonMotion variable_slopes(std::span<const double> values, std::uint64_t) {
  const auto p = values_as<VariableSlopes>(values);
  if (!(p.speed_min <= p.speed_max)) throw Error("TPNVS", "speed_min is above speed_max");

  const double distance = 2 * p.amplitude;
  const double reachable = std::sqrt(p.acceleration * distance);  // the ends would meet

  // Speeds in equal ratios, each in both directions as often as asked.
  Pieces<Stroke> strokes;
  for (int k = 0; k < static_cast<int>(p.levels); ++k) {
    const double wanted = p.speed_min * std::pow(p.speed_max / p.speed_min, k / (p.levels - 1));
    const double speed = std::min({wanted, p.speed_max, reachable});
    for (int cycle = 0; cycle < static_cast<int>(p.cycles); ++cycle) {
      strokes.add({-p.amplitude, distance, speed, p.acceleration, 1});
      strokes.add({p.amplitude, distance, speed, p.acceleration, -1});
    }
  }
  return as_motion(std::move(strokes), p.repeats);
}

PistonMotion road_profile(std::span<const double> values, std::uint64_t seed) {
  return road_deflection(values_as<RoadDeflection>(values), seed);
}

constexpr ParameterRow kAmplitude{"amplitude", "m", 0.025, 1e-6, 1, "greatest displacement"};
constexpr ParameterRow kSpeedMax{"speed_max", "m/s", 1.5,
                                 1e-4,        20,    "amplitude is reduced to stay below"};
constexpr ParameterRow kFrequencyMin{"frequency_min", "Hz", 0.5, 1e-3, 500, "least frequency"};
constexpr ParameterRow kFrequencyMax{"frequency_max", "Hz", 15, 1e-3, 500, "greatest frequency"};
constexpr ParameterRow kDuration{"duration", "s", 60, 0.1, 3600, "length of the motion"};
constexpr ParameterRow kRepeats{"repeats", "1", 1, 1, 1000, "times that it is run through", true};
constexpr std::string_view kMotionSource =
    "the one-sensor paper (its ranges), after Lozoya-Santos et al. 2009; all other numbers our own";

const std::array kMotionSequences{
    MotionSequence{
        {.name = "AM",
         .title = "Amplitude-modulated sine",
         .equation = "x = -A(t) cos(2 pi carrier t)\n"
                     "A(t) = amplitude (1 - depth cos(2 pi modulation t)) / (1 + depth)",
         .source = kMotionSource,
         .remarks = "One frequency at every amplitude. Begins at the least amplitude.",
         .params = {kAmplitude,
                    kSpeedMax,
                    {"carrier", "Hz", 2, 1e-3, 500, "frequency of the sine"},
                    {"modulation", "Hz", 0.1, 1e-4, 100, "how often the amplitude swells"},
                    {"depth", "1", 1, 0, 1, "1: down to no motion at all"},
                    kDuration}},
        amplitude_modulated},
    MotionSequence{
        {.name = "FM",
         .title = "Frequency-modulated sine: a chirp up and down",
         .equation = "x = -A(f) cos(phi),  phi' = 2 pi f\n"
                     "f between frequency_min and frequency_max as 1 - cos(2 pi modulation t)\n"
                     "A(f) = amplitude (1 + (2 pi f amplitude / s)^8)^(-1/8)",
         .source = kMotionSource,
         .remarks = "Every frequency. Begins at the lowest. s is as far below speed_max as the "
                    "changing amplitude needs.",
         .params = {kAmplitude,
                    kSpeedMax,
                    kFrequencyMin,
                    kFrequencyMax,
                    {"modulation", "Hz", 0.05, 1e-4, 100, "how often it goes up and down"},
                    kDuration}},
        frequency_modulated},
    MotionSequence{
        {.name = "RP",
         .title = "Road profile: the deflection of a car's suspension on a rough way",
         .equation = "sum of 300 sines with the power G_d n0^2 v / f^2 |H(f)|^2, n0 = 0.1 cycle/m",
         .source =
             "ISO 8608; H: the one-sensor paper's quarter-car, its passive damper inferred; the "
             "paper says \"rough way\" and no more",
         .remarks =
             "1.024e-3 m^3 is a road of class D. Scaled down where it would leave the amplitude or "
             "the speed. Faded in over a second.",
         .params = {kAmplitude,
                    kSpeedMax,
                    kFrequencyMin,
                    kFrequencyMax,
                    {"roughness", "m^3", 1.024e-3, 1e-7, 1, "G_d at 0.1 cycle/m"},
                    {"vehicle_speed", "m/s", 20, 0.1, 200, "speed of the car"},
                    {"damping", "N*s/m", 1804, 0, 1e5,
                     "of the car, passive: what the paper's road holding needs"},
                    kDuration}},
        road_profile},
    MotionSequence{
        {.name = "SFS",
         .title = "Stepped frequency sinusoid",
         .equation = "x = A(f) sin(2 pi f t), whole periods at f = frequency_min, + step, ...\n"
                     "A(f) = min(amplitude, speed_max / (2 pi f))",
         .source = kMotionSource,
         .remarks = "Each packet comes and goes over half a period, so that a bench can follow: "
                    "the bare definition asks for jumps of velocity.",
         .params = {kAmplitude,
                    kSpeedMax,
                    kFrequencyMin,
                    {"frequency_max", "Hz", 14.5, 1e-3, 500, "greatest frequency"},
                    {"step", "Hz", 1, 1e-3, 500, "from one frequency to the next"},
                    {"hold", "s", 0.5, 0, 1000, "least time at full amplitude"},
                    kRepeats}},
        stepped_frequency},
    MotionSequence{
        {.name = "TPNVS",
         .title = "Triangular wave with positive and negative variable slopes",
         .equation = "x' = +-v_k, v_k = speed_min ... speed_max in equal ratios",
         .source = kMotionSource,
         .remarks = "Constant speed on every stroke, as great in one direction as in the other. "
                    "The turns have a constant acceleration, as a bench has. A speed that the "
                    "stroke is too short for is reduced.",
         .params = {kAmplitude,
                    {"speed_min", "m/s", 0.05, 1e-5, 20, "least speed"},
                    {"speed_max", "m/s", 1, 1e-4, 20, "greatest speed"},
                    {"levels", "1", 8, 2, 1000, "number of speeds", true},
                    {"cycles", "1", 1, 1, 1000, "at each speed", true},
                    {"acceleration", "m/s^2", 60, 1e-2, 1e5, "at the turns"},
                    kRepeats}},
        variable_slopes},
};

}  // namespace

std::span<const MotionSequence> motion_sequences() { return kMotionSequences; }

}  // namespace dashpot
