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
#include "dashpot/identify.h"
#include "dashpot/identify/fit/member_report.h"

namespace dashpot {

/// The decay of moves of rates in a training that pays: they all but stay, and with them the ranges
/// within which the model will hold its signals, which the penalty must know beforehand.
constexpr double kPaidRateDecay = 1e3;

/// The report on a fitted ensemble. One that feeds energy into motions is trained on from where it
/// stands while it pays for that (ActivityPenalty), at a penalty that rises until the measured
/// verdict holds; a note says what that costs. Where no penalty is enough, or the user allows it,
/// the ensemble stays as it fits best.
///
/// make_model(members) gives the ensemble's model; train_on(member, penalty) trains one member on
/// and renews its `report`.
template <class Member, class MakeModel, class TrainOn>
FitReport report_of_dissipating(std::vector<Member> members, const std::vector<Record>& training,
                                DriveUnit drive_unit, const IdentifyOptions& options,
                                MakeModel make_model, TrainOn train_on) {
  constexpr std::array kWeights{0.03, 0.1, 0.3, 1.0, 3.0, 10.0};
  const auto report_of = [&] {
    FitReport report = report_of_members(members);
    report.model = make_model(members);
    return report;
  };
  const FitReport active = report_of();
  if (options.allow_active) return active;

  // What dissipates as it fits best stays as it is.
  const Domain domain = domain_of(training, drive_unit);
  const Dissipation before = dissipation(*active.model, domain, options.threads);
  if (before.dissipates()) return active;

  // Raise the penalty until the verdict holds.
  for (const double weight : kWeights) {
    const ActivityPenalty penalty(domain, weight);
    parallel_for(members.size(), options.threads,
                 [&](std::size_t k) { train_on(members[k], penalty); });
    FitReport paying = report_of();
    if (!dissipation(*paying.model, domain, options.threads).dissipates()) continue;
    paying.warnings.push_back(
        "it is trained on to dissipate: as it fits best, " + activity(before, drive_unit) +
        "; the training RMSE is " + format_number(paying.training_rmse, 3) + " N in place of " +
        format_number(active.training_rmse, 3) + " N (--allow-active keeps that fit)");
    return paying;
  }
  return active;
}

}  // namespace dashpot
