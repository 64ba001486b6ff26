#pragma once
#include "dashpot/report/report.h"

/// What the tests of the output show: three models on four motions and three currents of a made-up
/// damper (hyperbolic tangent and stiffness), each with its own error; the last one diverges on one
/// record.
struct ExampleRanking {
  dashpot::Dataset dataset;
  dashpot::Ranking ranking;
  dashpot::ReportInput input() const {
    return {dataset, ranking, "dashpot identify demo --leave-out condition", "0.1.0", "2026-11-21"};
  }
};

/// `samples` per record.
ExampleRanking example_ranking(std::size_t samples = 1500);

/// The same with the second model repeated until there are `models` of them, each a little worse.
ExampleRanking crowded_ranking(std::size_t models);
