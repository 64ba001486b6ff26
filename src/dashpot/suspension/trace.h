#pragma once
#include <span>
#include <vector>

#include "dashpot/simulate.h"
#include "dashpot/suspension/steps/step_method.h"

namespace dashpot {

/// Writes what a plant does, sample by sample, into the channels of a record.
class TraceWriter {
 public:
  TraceWriter(const Setting& setting, const PlantForces& forces, std::size_t samples);
  /// At the state's instant, road: under the plant's tyres; motions: of its struts.
  void write(const PlantState& state, std::span<const FootMotion> road,
             std::span<const DamperInput> motions);
  Record take();

 private:
  void make_room();
  /// write() of a plant with these sizes, into a room for one more sample.
  template <class Sizes>
  void write_row(Sizes sizes, const PlantState& state, std::span<const FootMotion> road,
                 std::span<const DamperInput> motions);

  const Plant& plant_;
  const PlantForces& forces_;
  const GroundMotion& ground_;
  Record record_;
  /// The next kRows samples of the time and of each channel, of which row_ are written.
  static constexpr std::size_t kRows = 64;
  std::vector<double*> columns_;
  std::size_t row_ = kRows;
};

/// Shares of the samples from `first` on: in which some tyre has no load or pulls; in which some
/// stop is met.
double contact_lost(const Record& trace, const Plant& plant, std::size_t first);
double stops_met(const Record& trace, const Plant& plant, std::size_t first);

/// J, that the damper of a strut takes from sample `first` on, by the trapezoidal rule.
double damper_energy(const Record& trace, const Strut& strut, std::size_t first);

/// What stands on the ground, in a word: "tyre", or the plant's own name of it, as a driver's seat.
std::string foot_of(const Plant& plant);

}  // namespace dashpot
