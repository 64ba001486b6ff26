#pragma once
#include <memory>
#include <string>
#include <vector>

#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/drive.h"
#include "dashpot/record.h"

namespace dashpot {

/// What a recording of one build tells of it, beside its family.
struct BuildReport {
  struct Deviation {
    std::string name;
    double value = 0;   ///< from the drawing, as a share; the offset's in N
    double spread = 0;  ///< of builds and of what the family gets wrong, likewise, before
    double left = 0;    ///< standard deviation after
  };
  std::shared_ptr<const FamilyModel> model;  ///< of this build
  std::vector<Deviation> deviations;
  double esr_before = 0, esr_after = 0;  ///< % on the recording, in free run
  /// Squared distance of the deviations from the drawing in those that left-out dampers had, and
  /// the distance that one in a hundred builds exceeds.
  double distance = 0, unlikely = 0;
  bool is_likely() const { return distance <= unlikely; }
  /// What this build leaves of the force, in the model's errors of a record; one in a hundred would
  /// leave more than 2.58 if these were normal, which nobody has counted. A recording that the
  /// family tells nothing of moves no deviation.
  double left_of_usual = 0;
  bool is_told() const { return left_of_usual <= 2.58; }
};

/// Where the forces of recordings are counted from.
enum class ForceZero {
  LoadCell,  ///< from nothing: what the damper has at rest is a part of the build
  Anywhere   ///< each recording from a force of its own, as in a plant whose springs bear that
};

/// Throws Error where the family does not know how builds of a drawing differ, and where the member
/// states its build.
void require_builds(const FamilyModel& member);

/// The member as its recordings, a few cycles or more, say that it was built: the most probable
/// deviations, given those of dampers that the family's fit had left out, each record with what is
/// known of a record's model error. Other currents and speeds follow by the family. Where forces
/// are counted from anywhere, the offset of the build is what goes with the rest of it. Throws
/// Error where the family knows no builds, or the records are of several dampers or of another than
/// the member.
BuildReport measure_build(const FamilyModel& member, const std::vector<Record>& recordings,
                          DriveUnit drive_unit, ForceZero zero = ForceZero::LoadCell);

}  // namespace dashpot
