#pragma once
#include <string>
#include <vector>

#include "dashpot/machine/in_plant_report.h"
#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/plant_recording.h"
#include "dashpot/record.h"

namespace dashpot {

// Models of any kind as the damper of a plant. Laws are fitted in free run (in_plant.h). The
// numbers of networks, hybrids and whatever else learns on a bench are too many for that, and each
// kind has a trainer of its own. So the plant becomes a bench: once a law was fitted in it, the
// sensors tell what each damper did and which force it had, and the trainer learns from that
// (docs/decisions/027-a-plant-is-a-bench-for-networks.md).

/// The law along which a model learns where no law is asked for.
inline constexpr const char* kLawBeforeModels = "tanh_kwok";

/// The laws that are tried where no model is named: with and without a memory, with a spring of
/// their own and without.
std::vector<std::string> usual_in_plant();

class PlantFitStore;

/// A model that was identified in a plant.
struct InPlantFit {
  std::string model;
  InPlantReport report;
  bool was_asked_for = true;  ///< else it is the law along which others learnt
  bool was_kept = false;      ///< found in the store of finished fits
};

/// Throws Error(where, ...) at a name that no model has, at a model of many dampers, and at one
/// that is no law where nothing measures the road or a road follows another one.
void require_model_for_plant(const std::string& model, const InPlantSetup& setup,
                             const std::string& where);

/// Identifies each of these models as the damper of this plant, from the recordings without their
/// still parts (recording_parts.h): laws first, then the others along the law that leaves least of
/// the time that was fitted. Fits that the store has are taken from it, and new ones are kept there
/// as soon as they are done. Throws Error, before long work, where these recordings cannot serve.
/// Not converging is a status.
std::vector<InPlantFit> identify_in_plant(const std::vector<std::string>& models,
                                          const InPlantSetup& setup,
                                          const std::vector<PlantRecording>& recordings,
                                          const InPlantOptions& options,
                                          PlantFitStore* store = nullptr);

/// What the sensors tell of the dampers' motion and force along a fit that found a model, as a
/// bench would have recorded them: of the time that was fitted. `recordings` as that fit had them.
std::vector<Record> bench_records_along(const InPlantReport& fit, const InPlantSetup& setup,
                                        const std::vector<PlantRecording>& recordings,
                                        const InPlantOptions& options);

}  // namespace dashpot
