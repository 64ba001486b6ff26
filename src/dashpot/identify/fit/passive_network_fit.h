#pragma once
#include <optional>
#include <vector>

#include "dashpot/drive.h"
#include "dashpot/evaluate.h"
#include "dashpot/identify.h"
#include "dashpot/split.h"

// What the fits of passive networks and of passive hybrids share.
namespace dashpot {

struct PassiveNetworkPreset;

/// A division of the training records on which choices are tried, and how much it counts.
struct PassiveTrial {
  Fold fold;
  double weight = 1;
};
struct PassiveTrials {
  std::vector<PassiveTrial> folds;
  bool later = false;  ///< of what comes later in the same records
};
/// Motions held back in turn, dealt to four groups, and the least level of the drive and the
/// greatest, where two others are left to extrapolate from; both count alike. Of records that have
/// neither, the last 30 %.
PassiveTrials passive_trials(const std::vector<Record>& training, const DriveRange& drive);

/// How a network learns of its records.
struct PassiveEffort {
  double decay = 0;            ///< how much its weights shrink
  std::size_t updates = 1600;  ///< of a member
  std::size_t windows = 32;    ///< of an update
  double rate = 0.01;          ///< of learning, at the beginning
};

/// A network that is fitted, and how hard it learnt.
struct PassiveNetworkTraining {
  FitReport report;
  PassiveEffort effort;
};
/// Without an effort the one is taken that does best on the parts held back.
PassiveNetworkTraining train_passive_network(const PassiveNetworkPreset& preset,
                                             const std::vector<Record>& training,
                                             DriveUnit drive_unit, const IdentifyOptions& options,
                                             std::optional<PassiveEffort> effort = {});
/// Where no other motions and levels of the drive are to come than those of these records: the step
/// is finer, weights do not shrink, and all learn for twice as long.
FitReport fit_to_these_motions(const PassiveNetworkPreset& preset,
                               const std::vector<Record>& training, DriveUnit drive_unit,
                               IdentifyOptions options);
/// The design and the effort of a trial of that network: one member, and fewer updates.
NetworkDesign trial_design(NetworkDesign design);
PassiveEffort trial_effort(PassiveEffort effort);

}  // namespace dashpot
