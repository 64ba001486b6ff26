#pragma once
#include <filesystem>
#include <string>

#include "dashpot/rank.h"
#include "support.h"

// What the tests on measured recordings share.

/// The recordings of a folder; none where sanitizers would let fits take minutes.
inline std::filesystem::path recordings(const std::string& folder) {
#ifdef __SANITIZE_ADDRESS__
  MESSAGE("SKIPPED: fits on " << folder << " run in the release build");
  return {};
#else
  return shared_data(folder);
#endif
}

/// The model's place in a ranking, judged as the dataset file says. A single start is the harder
/// test: with more of them the best is taken.
inline dashpot::RankedModel ranked(const std::string& model, const dashpot::Dataset& dataset) {
  return dashpot::rank({model}, dataset, *dataset.leave_out, {.starts = 1}).models.front();
}
