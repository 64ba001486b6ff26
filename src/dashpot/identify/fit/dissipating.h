#pragma once
#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/nets/activity_penalty.h"
#include "dashpot/damper/probe_sine.h"
#include "dashpot/identify.h"
#include "dashpot/identify/fit/member_report.h"

namespace dashpot {

/// The decay of moves of rates in a training that pays: they all but stay, and with them the ranges
/// within which the model will hold its signals, which the penalty must know beforehand.
constexpr double kPaidRateDecay = 1e3;

/// The report on a fitted ensemble. One that feeds energy into motions is trained on from where it
/// stands while it pays for that (ActivityPenalty), at a penalty that rises until the measured
/// verdict holds; a note says what that costs. It pays for the sines of the verdict that took out
/// little when they were last measured: the others cost nothing, and most do. Where no penalty is
/// enough, or the user allows it, the ensemble stays as it fits best.
///
/// make_model(members) gives the ensemble's model; train_on(member, penalty) trains one member on
/// and renews its `report`.
template <class Member, class MakeModel, class TrainOn>
FitReport report_of_dissipating(std::vector<Member> members, const std::vector<Record>& training,
                                DriveUnit drive_unit, const IdentifyOptions& options,
                                MakeModel make_model, TrainOn train_on) {
  constexpr std::array kWeights{0.03, 0.1, 0.3, 1.0, 3.0, 10.0};
  constexpr int kMostRounds = 10;
  constexpr double kWatched = 0.05;  // the share that a sine takes out which a training may turn
  const auto report_of = [&] {
    FitReport report = report_of_members(members);
    report.model = make_model(members);
    return report;
  };
  const FitReport active = report_of();
  if (options.allow_active) return active;

  // What dissipates as it fits best stays as it is.
  const Domain domain = domain_of(training, drive_unit);
  const std::vector<ProbeSine> sines = probe_sines(*active.model, domain);
  std::vector<ProbedCycle> cycles = settled_cycles(*active.model, sines, options.threads);
  const auto is_active = [](const ProbedCycle& cycle) { return cycle.is_active(); };
  if (std::ranges::none_of(cycles, is_active)) return active;

  // Raise the penalty until the verdict holds; not where what fails was not paid for yet.
  std::vector<bool> is_paid(sines.size());
  std::size_t step = 0;
  for (int round = 0; round < kMostRounds && step < kWeights.size(); ++round) {
    std::vector<ProbeSine> paid;
    for (std::size_t k = 0; k < sines.size(); ++k) {
      if (cycles[k].share() < kWatched) is_paid[k] = true;
      if (is_paid[k]) paid.push_back(sines[k]);
    }
    const ActivityPenalty penalty(paid, kWeights[step]);
    parallel_for(members.size(), options.threads,
                 [&](std::size_t k) { train_on(members[k], penalty); });
    FitReport paying = report_of();
    cycles = settled_cycles(*paying.model, sines, options.threads);
    if (std::ranges::any_of(cycles, is_active)) {
      bool is_new = false;
      for (std::size_t k = 0; k < sines.size(); ++k)
        is_new = is_new || (cycles[k].is_active() && !is_paid[k]);
      if (!is_new) ++step;
      continue;
    }
    paying.warnings.push_back(
        "it is trained on to dissipate: as it fits best, " +
        activity(dissipation(*active.model, domain, options.threads), drive_unit) +
        "; the training RMSE is " + format_number(paying.training_rmse, 3) + " N in place of " +
        format_number(active.training_rmse, 3) + " N (--allow-active keeps that fit)");
    return paying;
  }
  return active;
}

}  // namespace dashpot
