#include "dashpot/report/words.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "dashpot/base/text.h"

namespace dashpot {

std::string percent_text(double value) {
  if (!std::isfinite(value)) return "-";
  const double size = std::abs(value);
  if (size >= 1e6) return fmt::format("{:.1e}", value);
  return fmt::format("{:.{}f}", value, size < 1 ? 2 : size < 100 ? 1 : 0);
}

std::string number_text(double value, int digits) {
  return std::isfinite(value) ? format_number(value, digits) : "-";
}

std::string level_text(double level, const std::string& unit) {
  return unit.empty() ? "constant drive" : format_number(level, 3) + " " + unit;
}

std::string counted(std::size_t count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string status_name(FitReport::Status status) {
  switch (status) {
    case FitReport::Status::Converged:
      return "converged";
    case FitReport::Status::IterationLimit:
      return "iteration_limit";
    case FitReport::Status::Failed:
      break;
  }
  return "failed";
}

const std::string& display_name(const RankedModel& model) {
  return model.title.empty() ? model.name : model.title;
}

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
      "it leaves {} % of the force's power unexplained, an RMS error of {} N; its worst record is "
      "{} with {} %.",
      percent_text(pooled.esr), number_text(pooled.rmse), model.left_out.worst_record,
      percent_text(model.left_out.worst_esr));
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

/// "about 40 s", "about 6 min": an estimate is not told more precisely.
std::string about_minutes(double minutes) {
  constexpr double kSeconds = 60, kTens = 10, kMinutesFrom = 1.5;
  const double seconds = kSeconds * minutes;
  if (minutes >= kMinutesFrom) return fmt::format("about {:.0f} min", minutes);
  return fmt::format("about {:.0f} s",
                     seconds < kTens ? std::ceil(seconds) : kTens * std::ceil(seconds / kTens));
}

}  // namespace

bool is_judged(const RankedModel& model) {
  return model.fit.model && model.left_out.pooled.samples > 0;
}

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

std::string protocol_title(const LeaveOut& leave_out) {
  switch (leave_out.by) {
    case LeaveOut::By::Condition:
      return "one condition left out";
    case LeaveOut::By::Current:
      return "one drive level left out";
    case LeaveOut::By::Record:
      return "one record left out";
    case LeaveOut::By::Fraction:
      return "the end of every record left out";
    case LeaveOut::By::Blocks:
      return fmt::format("one of {} blocks of time left out", leave_out.blocks);
    case LeaveOut::By::Each:
      return "each " + join(leave_out.values, " and ") + " left out";
    case LeaveOut::By::Roles:
      break;
  }
  return "records left out as the dataset states";
}

std::string protocol(const LeaveOut& leave_out, std::size_t folds) {
  const std::string in_turn = fmt::format(
      " In turn ({}), the model is fitted on all other records and judged on those left out; the "
      "figures pool all of them.",
      counted(folds, "division"));
  const std::string chosen =
      leave_out.values.empty() ? "" : " (" + join(leave_out.values, ", ") + " by choice)";

  // The sentence of each way, with the values that were chosen.
  switch (leave_out.by) {
    case LeaveOut::By::Condition:
      return "All records of one motion are left out" + chosen + "." + in_turn;
    case LeaveOut::By::Current:
      return "All records at one drive level are left out" + chosen +
             (chosen.empty()
                  ? ", inner levels only, since a model is not asked to extrapolate in current." +
                        in_turn
                  : "." + in_turn);
    case LeaveOut::By::Record:
      return "One record is left out" + chosen + "." + in_turn;
    case LeaveOut::By::Each:
      return "All records that agree in " + join(leave_out.values, " and ") + " are left out." +
             in_turn;
    case LeaveOut::By::Fraction:
      return fmt::format(
          "The last {} % of every record is left out: the model is fitted on what comes before, "
          "runs on, and is judged on the end.",
          format_number(100 * leave_out.fraction, 3));
    case LeaveOut::By::Blocks:
      return fmt::format(
          "The time of every record is divided into {0} blocks. In turn ({0} divisions), the model "
          "is fitted on what lies before and after a block, runs from the start of the record "
          "through it, and is judged on it; the figures pool all of them.",
          leave_out.blocks);
    case LeaveOut::By::Roles:
      break;
  }
  return "The dataset file states which records are for training and which are left out; the model "
         "is fitted on the former and judged on the latter.";
}

std::string protocol_title(const Ranking& ranking) {
  return ranking.seen ? "a model fitted elsewhere" : protocol_title(ranking.leave_out);
}

std::string protocol(const Ranking& ranking) {
  if (!ranking.seen) {
    const bool varies =
        std::ranges::find(ranking.folds, kWithoutVaryingDrive) != ranking.folds.end();
    return protocol(ranking.leave_out, ranking.folds.size()) +
           (varies ? " The records whose drive varies are one division of their own." : "");
  }
  return fmt::format(
      "The model comes from a file; nothing is fitted here but the force zero of each record. By "
      "name and by the SHA-256 of the files, its fit has seen {} of {}.",
      *ranking.seen, counted(ranking.models.front().left_out.records.size(), "record"));
}

std::optional<std::string> difference_note(const Ranking& ranking) {
  const auto compared = std::ranges::find_if(
      ranking.models, [](const RankedModel& model) { return model.behind.has_value(); });
  if (compared == ranking.models.end()) return std::nullopt;
  return fmt::format(
      "Behind: how far the ESR of a model lies behind that of the first, with the 90 % interval of "
      "the paired difference over {}. Where it holds 0, the two cannot be told apart.",
      ranking.unit == "stretch of time"
          ? fmt::format("{} stretches of time", compared->behind->units)
          : counted(compared->behind->units, ranking.unit));
}

std::optional<std::string> budget_note(const Ranking& ranking) {
  if (!ranking.budget) return std::nullopt;
  const FitBudget& budget = *ranking.budget;
  const std::string within = format_number(budget.minutes) + " min on two cores";

  std::string note;
  if (!budget.too_small_for.empty())
    note = fmt::format("No model can be fitted within {}: the cheapest, {}, was tried alone ({}).",
                       within, budget.too_small_for, about_minutes(budget.expected_minutes));
  if (budget.untried.empty()) return note.empty() ? std::nullopt : std::optional(note);

  // Each with its own cost; then the budgets that reach the next one and all of them.
  std::vector<std::string> models;
  for (const UntriedModel& model : budget.untried)
    models.push_back(fmt::format("{} ({})", model.name, about_minutes(model.minutes)));
  const std::string next = format_number(budget.untried.front().budget_minutes);
  const std::string all = format_number(budget.untried.back().budget_minutes);
  const std::string tries =
      next == all ? "" : fmt::format("--budget {} tries the first too, ", next);
  return fmt::format("{}Not tried within {}: {}; {}--budget {} tries {}.",
                     note.empty() ? "" : note + " ", within, join(models, ", "), tries, all,
                     models.size() == 1 ? "it too" : "all");
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
      "unexplained, an RMS error of {} N (left out: {} % and {} N); its worst record there is {} "
      "with {} %.",
      counted(further.records.size(), "further record"), ranking.validated_on, display_name(best),
      percent_text(further.pooled.esr), number_text(further.pooled.rmse),
      percent_text(best.left_out.pooled.esr), number_text(best.left_out.pooled.rmse),
      further.worst_record, percent_text(further.worst_esr));
}

std::optional<std::string> one_step_note(const Ranking& ranking) {
  std::vector<std::string> figures;
  bool all_known = !ranking.models.empty();
  for (const RankedModel& m : ranking.models) {
    all_known = all_known && m.fit.model;
    if (m.left_out.one_step)
      figures.push_back(m.name + " " + percent_text(m.left_out.one_step->esr) + " % (free run " +
                        percent_text(m.left_out.pooled.esr) + " %)");
  }

  // Say so where no model has such an error.
  if (!figures.empty())
    return "One step ahead, with the measured force fed back, which flatters and is not ranked by; "
           "ESR on left-out records: " +
           join(figures, ", ") + ".";
  if (!all_known) return std::nullopt;
  return "There is no one-step error to print beside the free run: none of these models feeds "
         "force back.";
}

}  // namespace dashpot
