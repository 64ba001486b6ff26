#pragma once
#include <span>
#include <string>
#include <vector>

#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/model_in_plant.h"
#include "dashpot/report/document.h"

namespace dashpot::cli {

class Console;

/// Error on the time held back over what the sensor showed, %: the worst sensor; the training
/// time's where nothing was held back. Infinite where there is no model.
double worst_of(const InPlantFit& fit);

/// Verdict, the models, and the first of them in full; JSON has all. doubted: those whose warnings
/// are told. left_out: a sentence, or empty.
Document in_plant_document(const std::vector<InPlantFit>& fits, std::span<const InPlantFit> doubted,
                           const std::string& left_out, const InPlantSetup& setup,
                           const Console& console);

}  // namespace dashpot::cli
