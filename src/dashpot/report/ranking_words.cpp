#include "dashpot/report/ranking_words.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/report/quantity.h"
#include "dashpot/report/words.h"

namespace dashpot {

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
    case LeaveOut::By::Groups:
      return fmt::format("one of {} groups left out", leave_out.groups);
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
    case LeaveOut::By::Groups:
      return fmt::format(
                 "The motions, or the records where all have one motion, are dealt to {} groups, "
                 "and all records of one group are left out.",
                 leave_out.groups) +
             in_turn;
    case LeaveOut::By::Roles:
      break;
  }
  return "The dataset file states which records are for training and which are left out; the model "
         "is fitted on the former and judged on the latter.";
}

std::string judged_records(const Ranking& ranking) {
  if (!ranking.seen) return "left-out records";
  const std::size_t seen = *ranking.seen, all = ranking.models.front().left_out.records.size();
  if (seen == 0) return "records that its fit has not seen";
  return seen < all ? fmt::format("{} records, {} of them of its fit", all, seen)
                    : "records of its fit";
}

std::string records_title(const Ranking& ranking) {
  return ranking.seen ? "Records" : "Left-out records";
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

std::optional<std::string> comparison_note(const Ranking& ranking) {
  const auto compared = std::ranges::find_if(
      ranking.models, [](const RankedModel& model) { return model.over_first.has_value(); });
  if (compared == ranking.models.end()) return std::nullopt;

  // Of few divisions their records were compared, which have more in common than the interval
  // knows.
  const std::size_t units = compared->over_first->units, divisions = ranking.folds.size();
  std::string over = ranking.unit == "stretch of time" ? fmt::format("{} stretches of time", units)
                                                       : counted(units, ranking.unit);
  if (divisions > 1 && units != divisions)
    over += fmt::format(" of {}, within each of which they share a fit",
                        counted(divisions, "division"));
  return fmt::format(
      "Apart: whether a model's ESR is shown to be above that of the first on a typical {}: the "
      "90 % interval of how many times that it is (x first), over {}, lies above 1. Else the two "
      "cannot be told apart.",
      ranking.unit, over);
}

std::optional<std::string> inertia_note(const Ranking& ranking) {
  if (!ranking.inertia) return std::nullopt;
  const FoundInertia& found = *ranking.inertia;
  const std::string mass = format_number(found.mass, 3);
  return fmt::format(
      "The inertia of {} kg between load cell and damper is taken off the force of all records: "
      "the errors on left-out records showed it, and {} leaves {} {} of them in place of {} {} "
      "(RMSE). Model files state it, and 'evaluate' takes as much off further recordings; a "
      "dataset file states it for other commands, force: {{..., moving_mass: {}}}. With "
      "--keep-inertia the force stays as it was recorded.",
      mass, found.model, quantity(found.after, "N"), unit_name("N"), quantity(found.before, "N"),
      unit_name("N"), mass);
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
