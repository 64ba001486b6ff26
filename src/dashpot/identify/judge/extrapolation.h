#pragma once
#include <string>
#include <vector>

#include "dashpot/evaluate.h"
#include "dashpot/model_file.h"
#include "dashpot/value.h"

namespace dashpot {

/// How much of the recordings lies outside the range of one quantity that a model was fitted on.
struct Extrapolation {
  std::string quantity, unit;
  double low = 0, high = 0;            ///< the model's range
  double data_low = 0, data_high = 0;  ///< the recordings' range
  double share = 0;                    ///< of the samples
};

/// One per quantity of which some samples lie outside (by more than 1 % of the range).
std::vector<Extrapolation> extrapolations(const ModelFile& file, const Dataset& dataset);
/// The same of motions that are no recordings.
std::vector<Extrapolation> extrapolations(const DamperModel& model, const Domain& domain,
                                          DriveUnit drive_unit,
                                          const std::vector<std::vector<DamperInput>>& motions);

/// "12 % of the samples have a velocity outside ...: the model extrapolates there".
std::string describe(const Extrapolation& extrapolation);
Value to_json(const std::vector<Extrapolation>& extrapolations);

/// The properties in which the recordings' dampers lie outside the model's family, each once.
std::vector<std::string> outside_family(const Evaluation& evaluation);

/// Throws Error(where, ...) when the model is driven in A and the recordings in V, or the other
/// way round.
void require_same_drive(const ModelFile& file, const Dataset& dataset, const std::string& where);

}  // namespace dashpot
