#pragma once
#include "dashpot/identify/judge/extrapolation.h"
#include "dashpot/report/report.h"

namespace dashpot {

/// Name, citation, files and notes of a dataset: what every page shows as provenance.
Value dataset_json(const Dataset& dataset);

/// A model's figures: pooled, by velocity band and by record.
Value evaluation_json(const Evaluation& evaluation);
/// And the model's name, where it extrapolates, and of how many records the inertia was taken off:
/// what `dashpot evaluate --json` prints.
Value evaluation_json(const ModelFile& file, const Evaluation& evaluation,
                      const std::vector<Extrapolation>& outside, std::size_t without_inertia);

/// Status, parameters with their intervals, offsets and warnings of a fit.
Value fit_json(const FitReport& fit);

/// Displayed series of all left-out records, packed.
Value series_json(const Ranking& ranking);

}  // namespace dashpot
