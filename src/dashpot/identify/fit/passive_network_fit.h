#pragma once
#include <optional>
#include <set>
#include <vector>

#include "dashpot/drive.h"
#include "dashpot/evaluate.h"
#include "dashpot/identify.h"

// What the fits of passive networks and of passive hybrids share.
namespace dashpot {

struct PassiveNetworkPreset;

/// Places of the training records that a trial does without.
using HeldBack = std::set<std::size_t>;

/// Motions in turn, dealt to four groups; a single one cannot be held back. Then the least level of
/// the drive and the greatest, where two others are left to extrapolate from.
struct HeldBackParts {
  std::vector<HeldBack> motions, ends;
};
HeldBackParts held_back_parts(const std::vector<Record>& training, const DriveRange& drive);

/// A network that is fitted, and how much its weights shrank.
struct PassiveNetworkTraining {
  FitReport report;
  double decay = 0;
};
/// Without a decay the one is taken that does best on the parts held back.
PassiveNetworkTraining train_passive_network(const PassiveNetworkPreset& preset,
                                             const std::vector<Record>& training,
                                             DriveUnit drive_unit, const IdentifyOptions& options,
                                             std::optional<double> decay = {});
/// Where no other motions and levels of the drive are to come than those of these records: the step
/// is finer, weights do not shrink, and all learn for twice as long.
FitReport fit_to_these_motions(const PassiveNetworkPreset& preset,
                               const std::vector<Record>& training, DriveUnit drive_unit,
                               IdentifyOptions options);
/// The design of a trial of that network: one member, and fewer updates.
NetworkDesign trial_design(NetworkDesign design);

}  // namespace dashpot
