#pragma once
#include <span>
#include <string>
#include <vector>

#include "dashpot/record.h"
#include "dashpot/record/readers/table.h"

namespace dashpot {

/// The step of a uniform grid that all stamps agree with, within the rounding of their printed
/// digits; 0 when there is none, or fewer than two stamps. In the unit of the stamps. A step within
/// the tolerance of a whole rate or of the printed digits becomes exactly that.
double uniform_step(std::span<const double> stamps);

/// The median step; two stamps at least.
double usual_step(std::span<const double> stamps);

/// Throws Error at the first stamp that is repeated or runs backwards. `table` gives its place, and
/// the columns that tell rows which are there twice.
void require_increasing(std::span<const double> stamps, const RawTable& table);

/// Samples that a logger lost: now and then a step is a multiple of the usual one.
struct LostSamples {
  std::size_t samples = 0, places = 0;
  double first_behind = 0;  ///< the stamp before the first gap
};
/// None where steps differ in another way.
LostSamples lost_samples(std::span<const double> stamps);
/// "5 samples are missing in 2 places by the time stamps, the first behind 0.995 s"; "" for none.
std::string describe(const LostSamples& lost);

/// Each stamp becomes start + row * sample_time.
void make_uniform(std::span<double> stamps, double start, double sample_time);

/// Puts all channels on a uniform grid of that rate by linear interpolation, from the first stamp
/// on; adds a note. Throws Error when fewer than 2 or more than 1e9 samples would result.
void resample(Record& record, double rate_hz);

/// First and one-past-last sample of what moves: rest of at least 0.3 s at either end is left out.
/// Rest is where `motion` stays within 2 % of its half range of its value at that end.
std::pair<std::size_t, std::size_t> moving_part(std::span<const double> time,
                                                std::span<const double> motion);

}  // namespace dashpot
