#pragma once
#include "dashpot/output/report.h"

namespace dashpot {

/// Name, citation, files and notes of a dataset: what every page shows as provenance.
Value dataset_json(const Dataset& dataset);

/// A model's figures: pooled, by velocity band and by record.
Value evaluation_json(const Evaluation& evaluation);

/// Displayed series of all left-out records, packed, and the statistics of every residual.
Value series_json(const Ranking& ranking);
Value residuals_json(const Ranking& ranking);

}  // namespace dashpot
