#pragma once
#include "dashpot/report/search_report.h"

/// What the tests of the output show: a halving of nine made-up networks, one of which failed and
/// one of which diverged. The best has 41 parameters, the smallest within one standard error 13.
inline dashpot::SearchReport example_search() {
  using namespace dashpot;
  SearchReport search;
  search.folds = {"without a", "without b"};
  search.rungs = {{9, 1.0 / 3}, {3, 1}};
  search.results = 24;
  search.options.method = SearchMethod::Halving;
  search.options.space.axes = {parse_search_axis("hidden=2:20", "--over"),
                               parse_search_axis("activation=tanh,relu", "--over"),
                               parse_search_axis("l2=1e-6:1e-2", "--over")};
  for (std::size_t k = 0; k < 9; ++k) {
    Trial trial;
    trial.design = {.hidden = {k == 0 ? 10 : 2 + k},
                    .activation = k % 2 ? Activation::Relu : Activation::Tanh,
                    .l2 = 1e-6 * static_cast<double>(1 + 7 * k * k)};
    trial.rung = k < 3 ? 1 : 0;
    trial.folds.resize(2);
    trial.parameters = 4 * trial.design.hidden.front() + 1;
    trial.left_out.samples = 1000;
    trial.left_out.esr = 2 + 0.5 * static_cast<double>(k);
    trial.standard_error = 0.7;
    trial.worst_esr = 9;
    search.trials.push_back(trial);
  }
  search.trials[7].failure = "<script>alert('a failure')</script>";
  search.trials[8].diverged = 1;
  sort_trials(search.trials);
  search.trials[0].on_front = search.trials[1].on_front = true;
  return search;
}
