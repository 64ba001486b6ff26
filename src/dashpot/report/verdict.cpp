// The sentences that name the best model and its errors.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/report/quantity.h"
#include "dashpot/report/ranking_words.h"
#include "dashpot/report/words.h"

namespace dashpot {
namespace {

/// "A", "A and B", "A, B, C and 4 more".
std::string names_of(const std::vector<const RankedModel*>& models) {
  constexpr std::size_t kMost = 4;
  std::vector<std::string> names;
  for (const RankedModel* model : models) names.push_back(display_name(*model));
  if (names.size() > kMost) {
    const std::string more = fmt::format("{} more", names.size() - kMost + 1);
    names.resize(kMost - 1);
    names.push_back(more);
  }
  const std::string last = names.back();
  names.pop_back();
  return names.empty() ? last : join(names, ", ") + " and " + last;
}

/// What a model was judged on: "on recordings that it has not seen".
std::string judged_on(const Ranking& ranking) {
  const std::size_t records = ranking.models.front().left_out.records.size();
  const std::size_t seen = ranking.seen.value_or(0);
  if (seen == records && seen > 0) return "on the recordings that it was fitted on";
  if (seen > 0)
    return fmt::format("on {}, of which its fit has seen {},", counted(records, "recording"), seen);
  const bool is_in_time = ranking.leave_out.by == LeaveOut::By::Fraction ||
                          ranking.leave_out.by == LeaveOut::By::Blocks;
  return is_in_time && !ranking.seen ? "on parts of the recordings that it has not seen"
                                     : "on recordings that it has not seen";
}

std::string errors_of(const RankedModel& model) {
  const Metrics& pooled = model.left_out.pooled;
  return fmt::format(
      "it leaves {} % of the force's power unexplained, an RMS error of {} {}; its worst record "
      "is {} with {} %.",
      percent_text(pooled.esr), quantity(pooled.rmse, "N"), unit_name("N"),
      model.left_out.worst_record, percent_text(model.left_out.worst_esr));
}

/// The model that is best, or those that may be.
std::string leading(const Ranking& ranking, const std::vector<const RankedModel*>& leaders) {
  const RankedModel& best = *leaders.front();
  const std::string errors = judged_on(ranking) + " " + errors_of(best);

  // Nothing to compare with.
  const auto usable = std::ranges::count_if(ranking.models, is_recommendable);
  if (usable == 1) {
    const char* alone =
        ranking.models.size() > 1 ? "{} is the only model that can be used: {}" : "{}: {}";
    return fmt::format(fmt::runtime(alone), display_name(best), errors);
  }

  // A winner, and the one behind it.
  if (leaders.size() == 1)
    return fmt::format("{} predicts the force best: {} Next comes {} with {} %.",
                       display_name(best), errors, display_name(ranking.models[1]),
                       percent_text(ranking.models[1].left_out.pooled.esr));

  // Several that may be best: the first and the simplest.
  const auto numbers = [](const RankedModel* m) { return m->fit.model->parameter_count(); };
  const RankedModel& simplest = **std::ranges::min_element(leaders, {}, numbers);
  return fmt::format("{} cannot be told apart on these recordings. {} has the smallest error: {}{}",
                     names_of(leaders), display_name(best), errors,
                     &simplest == &best ? " It is the simplest of them, too."
                                        : fmt::format(" The simplest of them is {}: {}, {} %.",
                                                      display_name(simplest),
                                                      counted(numbers(&simplest), "fitted number"),
                                                      percent_text(simplest.left_out.pooled.esr)));
}

}  // namespace

std::string verdict(const Ranking& ranking) {
  const auto& models = ranking.models;
  if (models.empty()) return "No model was tried.";
  const std::vector<const RankedModel*> leaders = ranking.leaders();
  if (std::ranges::none_of(models, is_usable))
    return "No model can be used: each one failed or diverged on at least one left-out record.";
  if (leaders.empty())
    return "No model can be recommended: each one failed, diverged, does not forget how it began "
           "or feeds energy into some motions.";
  std::string text = leading(ranking, leaders);

  // Which cannot be recommended; a smaller error is no reason to take one of them.
  const auto refused = [&](auto is_refused, std::string_view does, std::string_view do_) {
    std::vector<const RankedModel*> all;
    for (const RankedModel& model : models)
      if (is_usable(model) && is_refused(model)) all.push_back(&model);
    if (all.empty()) return std::string();
    const double least = all.front()->left_out.pooled.esr;
    const bool is_smaller = least < models.front().left_out.pooled.esr;
    const bool is_one = all.size() == 1;
    return fmt::format(" {} {} and {} not recommended{}.", names_of(all), is_one ? does : do_,
                       is_one ? "is" : "are",
                       is_smaller ? fmt::format(", in spite of {} %", percent_text(least)) : "");
  };
  const auto remembers = [](const RankedModel& m) { return !m.forgetting.is_forgotten(); };
  text += refused(remembers, "does not forget how it began", "do not forget how they began");
  text +=
      refused([&](const RankedModel& m) { return !remembers(m) && !m.dissipation.dissipates(); },
              "feeds energy into some motions", "feed energy into some motions");
  const auto diverged =
      std::ranges::count_if(models, [](const RankedModel& m) { return m.left_out.diverged > 0; });
  if (diverged) text += fmt::format(" {} diverged.", counted(diverged, "model"));
  return text;
}

std::string verdict(const Ranking& ranking, const Dataset& dataset) {
  if (dataset.suspects.empty()) return verdict(ranking);
  std::set<std::string> records;
  for (const Suspect& suspect : dataset.suspects) records.insert(suspect.record);
  const auto& [first, why] = dataset.suspects.front();
  const std::size_t others = records.size() - 1;
  return verdict(ranking) +
         fmt::format(" Look at the recordings first: {} suspect; {}: {}.",
                     others == 0 ? "one record is" : fmt::format("{} records are", records.size()),
                     first, why);
}

std::optional<std::string> validation_note(const Ranking& ranking) {
  if (ranking.validated_on.empty() || ranking.models.empty()) return std::nullopt;
  const RankedModel& best = ranking.models.front();
  const Evaluation& further = best.validation;
  if (further.pooled.samples == 0)
    return "On " + ranking.validated_on + ", which no fit has seen, " + display_name(best) +
           " gives no force that can be judged.";
  return fmt::format(
      "On {} of {}, which no fit has seen, the final fit of {} leaves {} % of the force's power "
      "unexplained, an RMS error of {} {} (left out: {} % and {} {}); its worst record there is {} "
      "with {} %.",
      counted(further.records.size(), "further record"), ranking.validated_on, display_name(best),
      percent_text(further.pooled.esr), quantity(further.pooled.rmse, "N"), unit_name("N"),
      percent_text(best.left_out.pooled.esr), quantity(best.left_out.pooled.rmse, "N"),
      unit_name("N"), further.worst_record, percent_text(further.worst_esr));
}

}  // namespace dashpot
