#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "dashpot/damper/nets/free_run_record.h"
#include "dashpot/damper/nets/free_run_search.h"
#include "dashpot/damper/probe_sine.h"

namespace dashpot {

/// What a training pays for energy that its model feeds into motions: for each of some sines,
/// (weight (margin - share))^2 where the share of energy that a cycle takes out is below a small
/// margin, else nothing. For models that do not read the displacement.
class ActivityPenalty {
 public:
  ActivityPenalty(std::span<const ProbeSine> sines, double weight) : weight_(weight) {
    for (const ProbeSine& sine : sines) probes_.emplace_back(sine);
  }

  /// Adds the penalties of a model with so many unknowns. run(record, use) runs it through a record
  /// and calls use(force) at each scored sample; differentiate(record, use) calls use(row) with the
  /// force's derivatives by the unknowns. Any unit of force.
  template <class Run, class Differentiate>
  void add(std::size_t unknowns, RowSink& sink, Run run, Differentiate differentiate) const {
    std::vector<double> force, penalty(unknowns + 1);
    for (const Probe& probe : probes_) {
      force.clear();
      run(probe.record, [&](double value) { force.push_back(value); });
      const ProbedCycle cycle = measured(probe.cycle, force, probe.step);
      const double lacking = kMargin - cycle.share();
      if (!(lacking > 0) || !(cycle.passed > 0)) continue;

      std::ranges::fill(penalty, 0.0);
      const std::vector<double> slopes = share_slopes(probe.cycle, force, cycle);
      auto slope = slopes.begin();
      differentiate(probe.record, [&](const double* row) {
        const double factor = -weight_ * *slope++;
        for (std::size_t k = 0; k < unknowns; ++k) penalty[k] += factor * row[k];
      });
      penalty.back() = weight_ * lacking;
      sink.add_penalty(penalty);
    }
  }

 private:
  static constexpr double kMargin = 0.01;            // where a verdict asks for -1e-3
  static constexpr std::size_t kSettlingCycles = 3;  // before the one that counts

  struct Probe {
    explicit Probe(const ProbeSine& sine) : cycle(cycle_of(sine)), step(step_of(sine)) {
      for (std::size_t n = 0; n < kSettlingCycles; ++n)
        record.inputs.insert(record.inputs.end(), cycle.begin(), cycle.end() - 1);
      record.first = record.inputs.size();
      record.inputs.insert(record.inputs.end(), cycle.begin(), cycle.end());
      for (std::size_t k = 0; k < record.inputs.size(); ++k)
        record.time.push_back(step * static_cast<double>(k));
    }

    std::vector<DamperInput> cycle;
    double step;
    FreeRunRecord record;
  };

  double weight_;
  std::vector<Probe> probes_;
};

}  // namespace dashpot
