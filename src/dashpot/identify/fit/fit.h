#pragma once
#include <string>
#include <vector>

#include "dashpot/damper/law.h"
#include "dashpot/damper/registry.h"
#include "dashpot/drive.h"
#include "dashpot/identify.h"

// The ways of fitting behind identify().
namespace dashpot {

FitReport fit_law(const Law& law, const std::vector<Record>& training, DriveUnit drive_unit,
                  const IdentifyOptions& options);
FitReport fit_network(const NetworkPreset& preset, const std::vector<Record>& training,
                      DriveUnit drive_unit, const IdentifyOptions& options);
/// Regressor networks: with delayed inputs, or fed-back forces.
FitReport fit_narx(const NetworkPreset& preset, const std::vector<Record>& training,
                   DriveUnit drive_unit, const IdentifyOptions& options);
FitReport fit_state_network(const StateNetworkPreset& preset, const std::vector<Record>& training,
                            DriveUnit drive_unit, const IdentifyOptions& options);
FitReport fit_state_space(const StateSpacePreset& preset, const std::vector<Record>& training,
                          DriveUnit drive_unit, const IdentifyOptions& options);
FitReport fit_fuzzy(const FuzzyPreset& preset, const std::vector<Record>& training,
                    DriveUnit drive_unit, const IdentifyOptions& options);
/// Needs the conditions of a whole family member on each record. Throws Error where one is missing.
FitReport fit_family(const FamilyPreset& preset, const std::vector<Record>& training,
                     DriveUnit drive_unit, const IdentifyOptions& options);
FitReport fit_hybrid(const HybridPreset& preset, const std::vector<Record>& training,
                     DriveUnit drive_unit, const IdentifyOptions& options);

}  // namespace dashpot
