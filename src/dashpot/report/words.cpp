#include "dashpot/report/words.h"

#include <algorithm>
#include <cmath>

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

std::string next_best(const RankedModel& best, const RankedModel& next) {
  const double ratio = next.left_out.pooled.esr / best.left_out.pooled.esr;
  if (ratio < 1.1)
    return fmt::format(" {} is practically as good ({} %).", display_name(next),
                       percent_text(next.left_out.pooled.esr));
  return fmt::format(" Next comes {} with {} %.", display_name(next),
                     percent_text(next.left_out.pooled.esr));
}

}  // namespace

bool is_judged(const RankedModel& model) {
  return model.fit.model && model.left_out.pooled.samples > 0;
}

bool is_usable(const RankedModel& model) {
  return model.fit.status != FitReport::Status::Failed && model.left_out.diverged == 0 &&
         !model.left_out.records.empty() && std::isfinite(model.left_out.pooled.esr);
}

std::string verdict(const Ranking& ranking) {
  const auto& models = ranking.models;
  if (models.empty()) return "No model was tried.";
  if (!is_usable(models.front()))
    return "No model can be used: each one failed or diverged on at least one left-out record.";
  const RankedModel& best = models.front();
  const Metrics& pooled = best.left_out.pooled;
  std::string text = fmt::format(
      "{} predicts the force best: on recordings that it has not seen it leaves {} % of the "
      "force's power unexplained, an RMS error of {} N; its worst record is {} with {} %.",
      display_name(best), percent_text(pooled.esr), number_text(pooled.rmse),
      best.left_out.worst_record, percent_text(best.left_out.worst_esr));

  // Beside it the next one, and how many cannot be used.
  if (models.size() > 1 && is_usable(models[1])) text += next_best(best, models[1]);
  const auto diverged =
      std::ranges::count_if(models, [](const RankedModel& m) { return m.left_out.diverged > 0; });
  if (diverged) text += fmt::format(" {} diverged.", counted(diverged, "model"));
  return text;
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
