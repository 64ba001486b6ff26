#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>

#include "dashpot/base/random.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/parameter_table.h"
#include "dashpot/record/excitation.h"

namespace dashpot {
namespace {

/// A signal that keeps each value until the next one begins.
struct Steps {
  std::vector<double> begins, values;

  void add(double begin, double value) {
    begins.push_back(begin);
    values.push_back(value);
  }
};

DriveSignal as_signal(Steps steps) {
  return {{}, [steps = std::make_shared<const Steps>(std::move(steps))](double t) {
            const auto after = std::ranges::upper_bound(steps->begins, t);
            const auto index = std::max<std::ptrdiff_t>(after - steps->begins.begin() - 1, 0);
            return steps->values[static_cast<std::size_t>(index)];
          }};
}

/// Clock periods that cover the duration.
std::size_t count_clocks(double duration, double clock) {
  constexpr double kMost = 1e7;
  const double count = std::ceil(duration / clock);
  if (!(count <= kMost))
    throw Error("clock", format_number(count) + " periods in " + format_number(duration) + " s",
                "at most " + format_number(kMost));
  return static_cast<std::size_t>(std::max(count, 1.0));
}

struct SteppedConstants {
  double levels, hold;
};

DriveSignal stepped_constants(std::span<const double> values, const DriveFrame& frame) {
  const auto p = values_as<SteppedConstants>(values);
  const auto levels = static_cast<std::size_t>(p.levels);
  const double hold = p.hold > 0 ? p.hold : frame.duration / static_cast<double>(levels);
  const std::size_t count = p.hold > 0 ? count_clocks(frame.duration, hold) : levels;
  Steps steps;
  for (std::size_t k = 0; k < count; ++k) {
    const double share = static_cast<double>(k % levels) / static_cast<double>(levels - 1);
    steps.add(static_cast<double>(k) * hold, frame.low + (frame.high - frame.low) * share);
  }
  return as_signal(std::move(steps));
}

DriveSignal increased_clock_period(std::span<const double> values, const DriveFrame& frame) {
  const double clock = values[0];
  count_clocks(frame.duration, clock);
  Random random(frame.seed);
  Steps steps;
  double begin = 0;
  for (int k = 1; begin < frame.duration || k == 1; ++k) {
    steps.add(begin, random.uniform(frame.low, frame.high));
    begin += k * clock;
  }
  return as_signal(std::move(steps));
}

struct ShiftRegister {
  double clock, order;

  std::vector<bool> bits(const DriveFrame& frame, Random& random) const {
    const auto bit_count = static_cast<int>(order);
    const auto start =
        static_cast<std::uint32_t>(1 + random.index((std::size_t{1} << bit_count) - 1));
    return maximum_length_bits(bit_count, start, count_clocks(frame.duration, clock));
  }
};

DriveSignal pseudo_random_binary(std::span<const double> values, const DriveFrame& frame) {
  const auto p = values_as<ShiftRegister>(values);
  Random random(frame.seed);
  Steps steps;
  for (const bool bit : p.bits(frame, random))
    steps.add(static_cast<double>(steps.values.size()) * p.clock, bit ? frame.high : frame.low);
  return as_signal(std::move(steps));
}

DriveSignal amplitude_modulated_binary(std::span<const double> values, const DriveFrame& frame) {
  const auto p = values_as<ShiftRegister>(values);
  Random random(frame.seed);
  const std::vector<bool> bits = p.bits(frame, random);
  Steps steps;
  for (std::size_t k = 0; k < bits.size(); ++k)
    if (k == 0 || bits[k] != bits[k - 1])
      steps.add(static_cast<double>(k) * p.clock, random.uniform(frame.low, frame.high));
  return as_signal(std::move(steps));
}

constexpr ParameterRow kClock{"clock", "s", 0.05, 1e-5, 1e4, "time of one bit"};
constexpr ParameterRow kOrder{"order", "1", 9, 3, 16, "bits of the shift register", true};
constexpr std::string_view kDriveSource =
    "the one-sensor paper, after Lozoya-Santos et al. 2009; times our own";

const std::array kDriveSequences{
    DriveSequence{
        {.name = "APRBS",
         .title = "Amplitude-modulated pseudo-random binary signal",
         .equation = "at each change of the PRBS a new level, uniform in low ... high",
         .source = "usual in the identification of nonlinear systems; not in the one-sensor paper",
         .remarks = "Switches as PRBS does and visits the whole range.",
         .params = {kClock, kOrder}},
        amplitude_modulated_binary},
    DriveSequence{
        {.name = "ICPS",
         .title = "Increased clock period signal",
         .equation = "the k-th level lasts k clock and is uniform in low ... high",
         .source = kDriveSource,
         .remarks = "Fast changes first, then slower and slower ones. The paper says that the "
                    "amplitude is random; that the period grows in proportion is recalled.",
         .params = {{"clock", "s", 0.02, 1e-5, 1e4, "time of the first level"}}},
        increased_clock_period},
    DriveSequence{
        {.name = "PRBS",
         .title = "Pseudo-random binary signal",
         .equation = "low or high by the bits of a maximum-length shift register",
         .source = kDriveSource,
         .remarks = "2^order - 1 bits long, one more high than low; the seed is where it begins.",
         .params = {kClock, kOrder}},
        pseudo_random_binary},
    DriveSequence{
        {.name = "SC",
         .title = "Stepped constants",
         .equation = "low + (high - low) k / (levels - 1), k = 0 ... levels - 1, each for hold",
         .source = kDriveSource,
         .remarks = "The paper's SC (10) and SC (2) are levels = 10 and 2. Begins again at low.",
         .params = {{"levels", "1", 10, 2, 1000, "number of constants", true},
                    {"hold", "s", 0, 0, 1e5, "time of each; 0: the duration over levels"}}},
        stepped_constants},
};

}  // namespace

std::span<const DriveSequence> drive_sequences() { return kDriveSequences; }

std::vector<bool> maximum_length_bits(int order, std::uint32_t start, std::size_t count) {
  // Bits that are fed back, of primitive polynomials: 0x60 is x^7 + x^6 + 1.
  constexpr std::array<std::uint32_t, 14> kTaps{
      0x6, 0xc, 0x14, 0x30, 0x60, 0xb8, 0x110, 0x240, 0x500, 0x829, 0x100d, 0x2015, 0x6000, 0xd008};
  if (order < 3 || order > 16)
    throw Error("shift register", std::to_string(order) + " bits", "3 to 16");
  const std::uint32_t taps = kTaps[static_cast<std::size_t>(order - 3)];
  const std::uint32_t mask = (std::uint32_t{1} << order) - 1;
  std::uint32_t word = start & mask;
  if (word == 0) throw Error("shift register", "it starts empty", "at least one bit set");

  // Give the highest bit, then shift in the parity of the taps.
  std::vector<bool> bits(count);
  for (std::size_t k = 0; k < count; ++k) {
    bits[k] = (word >> (order - 1) & 1) != 0;
    word = (word << 1 | (static_cast<std::uint32_t>(std::popcount(word & taps)) & 1)) & mask;
  }
  return bits;
}

}  // namespace dashpot
