#pragma once
#include <optional>
#include <string>
#include <vector>

#include "dashpot/evaluate.h"
#include "dashpot/identify/judge/extrapolation.h"
#include "dashpot/record/characterise.h"
#include "dashpot/report/document.h"

namespace dashpot {

/// One of the things that are compared: recordings, or a model with the forces that it gives.
struct ComparedThing {
  std::string name;  ///< as the caller calls it: a path
  Dataset dataset;   ///< the recordings; of a model, those that it was run over, with its forces
  Characterisation figures;  ///< of that dataset
  bool is_model = false;
  /// Of a model that was run over recordings: its errors there.
  std::optional<Evaluation> evaluation = {};
  std::size_t seen = 0;  ///< of the records that it was run over, how many its fit has seen
  std::vector<Extrapolation> beyond = {};  ///< where these leave the range that it was fitted on
};

struct ComparisonInput {
  const std::vector<ComparedThing>& things;  ///< two or more; the first is compared with the others
  std::vector<double> speeds;                ///< m/s, as asked for; empty: those of the first
  std::string command, version, date;
};

/// All things on one page: force over time, velocity and displacement, and their peak curves, laid
/// over each other; their differences in tables, with what cycles differ by among themselves.
Document comparison_document(const ComparisonInput& input);

}  // namespace dashpot
