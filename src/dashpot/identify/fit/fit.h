#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/drive.h"
#include "dashpot/identify.h"
#include "dashpot/model_kind.h"

// The fits behind identify(): one per kind of model, each in the file of its name. All take the
// records together in free run, throw Error when the records cannot serve, and report a fit that
// does not converge as a status. drive_unit: of the channel "drive" ("A", "V").
namespace dashpot {

struct FamilyPreset;
struct FuzzyPreset;
struct HybridPreset;
struct HysteresisNetworkPreset;
struct Law;
struct NarxPreset;
struct NetworkPreset;
struct PassiveHybridPreset;
struct PassiveNetworkPreset;
struct StateSpacePreset;

FitReport fit_law(const Law& law, const std::vector<Record>& training, DriveUnit drive_unit,
                  const IdentifyOptions& options);
/// With delayed inputs (--network delays) a static network becomes a NARX model: fit_narx() then.
FitReport fit_network(const NetworkPreset& preset, const std::vector<Record>& training,
                      DriveUnit drive_unit, const IdentifyOptions& options);
FitReport fit_narx(const NarxPreset& preset, const std::vector<Record>& training,
                   DriveUnit drive_unit, const IdentifyOptions& options);
FitReport fit_hysteresis_network(const HysteresisNetworkPreset& preset,
                                 const std::vector<Record>& training, DriveUnit drive_unit,
                                 const IdentifyOptions& options);
FitReport fit_state_space(const StateSpacePreset& preset, const std::vector<Record>& training,
                          DriveUnit drive_unit, const IdentifyOptions& options);
FitReport fit_passive_network(const PassiveNetworkPreset& preset,
                              const std::vector<Record>& training, DriveUnit drive_unit,
                              const IdentifyOptions& options);
/// Steps through windows that the fit above takes at most: its cost is in proportion.
double passive_training_steps(const PassiveNetworkPreset& preset,
                              const std::vector<Record>& training, DriveUnit drive_unit,
                              const NetworkDesign& design);
FitReport fit_fuzzy(const FuzzyPreset& preset, const std::vector<Record>& training,
                    DriveUnit drive_unit, const IdentifyOptions& options);
FitReport fit_hybrid(const HybridPreset& preset, const std::vector<Record>& training,
                     DriveUnit drive_unit, const IdentifyOptions& options);
FitReport fit_passive_hybrid(const PassiveHybridPreset& preset, const std::vector<Record>& training,
                             DriveUnit drive_unit, const IdentifyOptions& options);
/// Needs the conditions of a whole family member on each record. Throws Error where one is missing.
FitReport fit_family(const FamilyPreset& preset, const std::vector<Record>& training,
                     DriveUnit drive_unit, const IdentifyOptions& options);

/// The fit of one kind of model.
struct KindFit {
  ModelKind kind;
  /// Fits the registered model of that name, which must be of this kind.
  FitReport (*fit)(std::string_view model, const std::vector<Record>& training,
                   DriveUnit drive_unit, const IdentifyOptions& options);
  /// Names of the settings (network_settings()) that the fit of that model follows.
  std::span<const std::string_view> (*settings)(std::string_view model);
  Trainer trainer = Trainer::LevenbergMarquardt;  ///< where the user names none
};
const KindFit& fit_of(ModelKind kind);

/// Names of the settings that a model's fit follows. Throws Error at an unknown model.
std::span<const std::string_view> network_settings_of(const std::string& model);
/// Throws Error when something is set that none of these models can follow, or that the trainer
/// does not use.
void require_design(const NetworkDesign& design, const std::vector<std::string>& models);

}  // namespace dashpot
