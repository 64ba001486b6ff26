#pragma once
#include <string>
#include <vector>

#include "dashpot/machine/evaluate_in_plant.h"
#include "dashpot/machine/in_plant.h"
#include "dashpot/machine/observe.h"
#include "dashpot/model_file.h"
#include "dashpot/record.h"
#include "dashpot/value.h"

// What an identification inside a plant, a judgement there and an observation came to, as programs
// read it: JSON, model files, records. SI.

namespace dashpot {

Value to_json(const PlantAdvice& advice);
/// Figures, parameters with their 95 % intervals, what can be told, what would help.
Value to_json(const InPlantReport& report, const std::string& law);

/// A damper of the report as a file, its dissipation looked at; provenance is the caller's.
ModelFile found_damper(const FoundDamper& damper, const InPlantReport& report,
                       const InPlantSetup& setup, double sample_time);

/// Figures of every sensor in free run, without the samples.
Value to_json(const PlantEvaluation& evaluation, const InPlantSetup& setup);
/// The samples: each sensor as measured and as NAME_modelled, and each damper's force, deflection
/// and velocity.
Record run_of(const InPlantTrace& trace, const InPlantSetup& setup);

/// Uncertainties and how the sensors fitted them, without the estimates over time.
Value to_json(const ObserveReport& report, const InPlantSetup& setup);
/// The estimates over time: each quantity, and half the width of its band as NAME_half_band.
Record estimates_of(const ObservedRecording& observed);

}  // namespace dashpot
