#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/damper/nets/mlp.h"
#include "dashpot/dataset.h"
#include "dashpot/drive.h"

namespace dashpot {

/// The inputs of the family paper's network, in the order of its authors' code: conditions of a
/// record, then its channels. SI.
inline constexpr std::array kFamilyInputs{"piston_area", "gap_area",    "gap",
                                          "pole_length", "viscosity",   "yield_stress",
                                          "velocity",    "displacement"};
inline constexpr std::size_t kFamilyConditions = 6;

/// One cycle of each record of a family of dampers, as samples to learn the force from.
struct FamilySamples {
  std::vector<Record> cycles;
  /// The records up to their cycles' ends, scored on the cycles: models with states run in before.
  std::vector<Record> runs;
  DriveUnit drive_unit = DriveUnit::None;
  TrainingSamples samples;         ///< the cycles one behind the other
  std::vector<std::size_t> first;  ///< of each cycle in them, and their number

  std::size_t size() const { return samples.targets.size(); }
  /// A condition of a cycle, SI, by its name in kFamilyInputs.
  double condition(std::size_t cycle, std::string_view name) const;
};

/// Throws Error when a record lacks one of the conditions, or has no whole cycle.
FamilySamples family_samples(const Dataset& dataset);

/// The samples that a network learns from and those that judge it, by their index.
struct FamilyDivision {
  std::string name;
  std::vector<std::size_t> training, judged;
};

/// Every sample for learning and for judging, as in the paper's bar charts.
FamilyDivision all_samples(const FamilySamples& family);
/// One damper with one fluid in each division, both for learning and for judging.
std::vector<FamilyDivision> single_dampers(const FamilySamples& family);
/// Left out in turn: each geometry (pole length and gap, whatever the fluid); each fluid. Throws
/// Error where the family has only one.
std::vector<FamilyDivision> without_geometries(const FamilySamples& family);
std::vector<FamilyDivision> without_fluids(const FamilySamples& family);
/// A share of the samples drawn at random judges. Neighbours of every one of them are learnt from,
/// so this judges nothing; it is here to show which figure it gives.
FamilyDivision random_samples(const FamilySamples& family, double share, std::uint64_t seed);

/// The samples with these indices, in their order.
TrainingSamples chosen(const TrainingSamples& samples, const std::vector<std::size_t>& indices);

}  // namespace dashpot
