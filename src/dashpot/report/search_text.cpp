// The report of a search for a terminal, as Markdown and as CSV.
#include <cmath>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/report/safe_text.h"
#include "dashpot/report/search_report.h"
#include "dashpot/report/text_table.h"
#include "dashpot/report/words.h"

namespace dashpot {
namespace {

/// Empty where the trial's trainer has no use for the setting.
std::string setting_text(const Trial& trial, const std::string& setting) {
  return find_network_setting(setting, setting).format(trial.design);
}

std::string share_text(double share) {
  return share == 1 ? "all" : fmt::format("1/{:.0f}", 1 / share);
}

std::string error_text(const Trial& trial) {
  const std::string error = percent_text(trial.left_out.esr);
  return std::isfinite(trial.standard_error) ? error + " +- " + percent_text(trial.standard_error)
                                             : error;
}

std::string note_of(const Trial& trial, const SearchReport& of) {
  if (!trial.failure.empty()) return "failed: " + trial.failure;
  if (trial.diverged) return fmt::format("{} diverged", trial.diverged);
  std::vector<std::string> notes;
  if (&trial == of.best()) notes.emplace_back("best");
  if (&trial == of.smallest()) notes.emplace_back("smallest");
  if (trial.on_front) notes.emplace_back("front");
  return join(notes, ", ");
}

std::vector<TextColumn> trial_columns(const SearchReport& of) {
  std::vector<TextColumn> columns{{"#", true}};
  for (const SearchAxis& axis : of.options.space.axes) columns.push_back({axis.setting, true});
  columns.insert(columns.end(),
                 {{"ESR %", true}, {"Worst %", true, 1}, {"RMSE N", true, 2}, {"Par.", true}});
  if (of.rungs.size() > 1) columns.push_back({"Effort", true});
  columns.push_back({"Note", false, 0, true});
  return columns;
}

std::vector<std::string> trial_row(const Trial& trial, const SearchReport& of, std::size_t place) {
  std::vector<std::string> row{std::to_string(place)};
  for (const SearchAxis& axis : of.options.space.axes) {
    const std::string value = setting_text(trial, axis.setting);
    row.push_back(value.empty() ? "-" : value);
  }
  const bool has_model = trial.failure.empty();
  row.insert(row.end(),
             {has_model ? error_text(trial) : "-", has_model ? percent_text(trial.worst_esr) : "-",
              has_model ? number_text(trial.left_out.rmse) : "-",
              has_model ? std::to_string(trial.parameters) : "-"});
  if (of.rungs.size() > 1) row.push_back(share_text(of.rungs[trial.rung].share));
  row.push_back(note_of(trial, of));
  return row;
}

std::vector<std::vector<std::string>> trial_rows(const std::vector<Trial>& trials,
                                                 const SearchReport& of, std::size_t most) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < std::min(most, trials.size()); ++k)
    rows.push_back(trial_row(trials[k], of, k + 1));
  return rows;
}

/// "hidden=5 with 21 parameters".
std::string named(const Trial& trial, const SearchReport& search) {
  return searched_settings(trial, search) + " with " + counted(trial.parameters, "parameter");
}

}  // namespace

std::string searched_settings(const Trial& trial, const SearchReport& search) {
  std::vector<std::string> parts;
  for (const SearchAxis& axis : search.options.space.axes)
    if (const std::string value = setting_text(trial, axis.setting); !value.empty())
      parts.push_back(axis.setting + '=' + value);
  return join(parts, ", ");
}

std::string trial_table(const std::vector<Trial>& trials, const SearchReport& of, int width,
                        std::size_t most) {
  return text_table(trial_columns(of), trial_rows(trials, of, most), width);
}

std::string search_plan(const std::vector<Rung>& rungs, SearchEffort effort) {
  std::vector<std::string> parts;
  for (const Rung& rung : rungs) {
    std::string part = parts.empty() ? counted(rung.trials, "trial") : std::to_string(rung.trials);
    if (rungs.size() > 1) {
      part += " with " + share_text(rung.share);
      if (rung.share < 1 && parts.empty())
        part += effort == SearchEffort::Samples ? " of the data" : " of the epochs";
    }
    parts.push_back(part);
  }
  return join(parts, ", ");
}

std::string search_verdict(const SearchReport& search) {
  const Trial* best = search.best();
  if (!best)
    return "No trial can be used: each one failed or diverged on at least one left-out record.";
  std::string text = fmt::format(
      "{}: on recordings that it has not seen it leaves {} % of the force's power unexplained.",
      named(*best, search), percent_text(best->left_out.esr));
  const Trial* smallest = search.smallest();
  if (!std::isfinite(best->standard_error))
    text +=
        " There is one division only, so that no standard error tells which others are as good.";
  else if (smallest == best)
    text += " No smaller network comes within one standard error of it.";
  else
    text += fmt::format(" The smallest network within one standard error of it ({} %) is {}: {} %.",
                        percent_text(best->standard_error), named(*smallest, search),
                        percent_text(smallest->left_out.esr));
  return text +
         " The best of many trials was chosen by this very error: expect a little more on new "
         "records.";
}

std::string markdown_search(const SearchInput& input) {
  const SearchReport& search = input.search;
  std::string text = "# " + markdown_cell(input.dataset.name) + ", search of " +
                     search.options.model + "\n\n" + markdown_cell(search_verdict(search)) +
                     "\n\n" + search_plan(search.rungs, search.options.effort) +
                     ". Left out: " + format_leave_out(search.leave_out) + ". " +
                     protocol(search.leave_out, search.folds.size()) +
                     " ESR +- the standard error of its mean over the divisions.\n\n" +
                     markdown_table(trial_columns(search),
                                    trial_rows(search.trials, search, search.trials.size()));
  text += "\nMade by `" + input.command + "`, Dashpot " + input.version + ".\n";
  if (!input.dataset.citation.empty())
    text += "\nData: " + markdown_cell(input.dataset.citation) + "\n";
  return text;
}

std::string csv_search(const SearchReport& search) {
  std::string text = "rank";
  for (const SearchAxis& axis : search.options.space.axes) text += "," + axis.setting;
  text +=
      ",parameters,esr_percent,standard_error_percent,worst_esr_percent,rmse_N,samples,diverged_"
      "records,"
      "effort,usable,on_front,best,smallest,failure\n";
  const auto yes = [](bool value) { return std::string(value ? "yes" : "no"); };
  const auto number = [](double value) {
    return std::isfinite(value) ? format_exact(value) : std::string();
  };
  std::size_t rank = 0;
  for (const Trial& trial : search.trials) {
    std::vector<std::string> fields{std::to_string(++rank)};
    for (const SearchAxis& axis : search.options.space.axes)
      fields.push_back(csv_field(setting_text(trial, axis.setting)));
    fields.insert(
        fields.end(),
        {std::to_string(trial.parameters), number(trial.left_out.esr), number(trial.standard_error),
         number(trial.worst_esr), number(trial.left_out.rmse),
         std::to_string(trial.left_out.samples), std::to_string(trial.diverged),
         format_exact(search.rungs[trial.rung].share), yes(trial.is_usable()), yes(trial.on_front),
         yes(&trial == search.best()), yes(&trial == search.smallest()), csv_field(trial.failure)});
    text += join(fields, ",") + "\n";
  }
  return text;
}

}  // namespace dashpot
