// A search for people: error against size, error by setting, all trials.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/report/provenance.h"
#include "dashpot/report/ranking_words.h"
#include "dashpot/report/search_report.h"
#include "dashpot/report/words.h"

namespace dashpot {
namespace {

using Mark = FigureSeries::Mark;

/// Empty where the trial's trainer has no use for the setting.
std::string setting_text(const Trial& trial, const std::string& setting) {
  return find_network_setting(setting, setting).format(trial.design);
}

std::string share_text(double share) {
  return share == 1 ? "all" : fmt::format("1/{:.0f}", 1 / share);
}

std::string error_text(const Trial& trial) {
  const std::string error = percent_text(trial.left_out.esr);
  return std::isfinite(trial.standard_error) ? error + " ± " + percent_text(trial.standard_error)
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

/// "hidden=5 with 21 parameters".
std::string named(const Trial& trial, const SearchReport& search) {
  return searched_settings(trial, search) + " with " + counted(trial.parameters, "parameter");
}

/// Trials as points of x and the error.
template <typename X>
FigureSeries points(const SearchReport& search, const std::string& label, const std::string& colour,
                    Mark mark, const std::function<bool(const Trial&)>& is_shown, X x_of) {
  FigureSeries series{
      .label = label, .colour = colour, .x = {}, .y = {}, .mark = mark, .width = 3.5};
  for (const Trial& trial : search.trials) {
    if (!trial.is_usable() || !is_shown(trial)) continue;
    series.x.push_back(x_of(trial));
    series.y.push_back(trial.left_out.esr);
    series.names.push_back(searched_settings(trial, search));
  }
  return series;
}

FigurePanel size_panel(const SearchReport& search) {
  FigurePanel panel{.title = "Error against parameters",
                    .x_label = "Parameters",
                    .y_label = "Left-out ESR (%)",
                    .series = {},
                    .note =
                        "Every point is a network, judged on records that it has not seen. Both "
                        "axes are logarithmic.",
                    .x_log = true,
                    .y_log = true,
                    .height = 420,
                    .empty = "No trial is usable."};
  const Trial* best = search.best();
  if (!best) return panel;
  const auto size = [](const Trial& trial) { return static_cast<double>(trial.parameters); };
  const auto add = [&](const char* label, const char* colour, Mark mark, const auto& is_shown) {
    panel.series.push_back(points(search, label, colour, mark, is_shown, size));
    return &panel.series.back();
  };
  add("dropped on the way", "muted", Mark::Rings,
      [&](const Trial& trial) { return !search.is_finalist(trial); });

  // The front is a line from the smallest network to the best.
  FigureSeries* front = add("front: none better with as few", "series-2", Mark::Line,
                            [](const Trial& trial) { return trial.on_front; });
  std::ranges::reverse(front->x);
  std::ranges::reverse(front->y);
  front->names.clear();
  front->width = 1.5;
  front->is_read = false;

  // Networks below the dashes are practically as good as the best.
  if (std::isfinite(best->standard_error)) {
    const double limit = best->left_out.esr + best->standard_error;
    double least = size(*best), greatest = least;
    for (const Trial& trial : search.trials)
      if (trial.is_usable()) {
        least = std::min(least, size(trial));
        greatest = std::max(greatest, size(trial));
      }
    panel.series.push_back({.label = "best + one standard error",
                            .colour = "muted",
                            .x = {least, greatest},
                            .y = {limit, limit},
                            .mark = Mark::Dashes,
                            .is_read = false});
  }
  add("trials", "series-1", Mark::Dots,
      [&](const Trial& trial) { return search.is_finalist(trial); });
  FigureSeries* smallest = add("smallest within one standard error", "series-2", Mark::Rings,
                               [&](const Trial& trial) { return &trial == search.smallest(); });
  smallest->width = 8;
  smallest->is_read = false;
  return panel;
}

/// The error of all usable trials by one setting: over its values, or over its range.
FigurePanel setting_panel(const SearchReport& search, const SearchAxis& axis) {
  const bool is_range = axis.values.empty();
  FigurePanel panel{.title = "Error by " + axis.setting,
                    .x_label = axis.setting,
                    .y_label = "Left-out ESR (%)",
                    .series = {},
                    .places = axis.values,
                    .note = std::string(find_network_setting(axis.setting, axis.setting).meaning),
                    .x_log = is_range && axis.low > 0,
                    .y_log = true,
                    .height = 260};

  // Values of a list stand at their places, numbers of a range where they are.
  const auto place = [&](const Trial& trial) {
    const std::string value = setting_text(trial, axis.setting);
    if (is_range) return parse_number(value).value_or(NAN);
    const auto found = std::ranges::find(axis.values, value);
    return found == axis.values.end() ? NAN : static_cast<double>(found - axis.values.begin());
  };
  for (const bool is_finalist : {false, true})
    panel.series.push_back(points(
        search, is_finalist ? "trials" : "dropped on the way", is_finalist ? "series-1" : "muted",
        is_finalist ? Mark::Dots : Mark::Rings,
        [&](const Trial& trial) {
          return search.is_finalist(trial) == is_finalist &&
                 !setting_text(trial, axis.setting).empty();
        },
        place));
  return panel;
}

Terms search_terms() {
  Terms terms = judged_terms();
  std::erase_if(terms, [](const auto& term) {
    return term.first == "Energy error" || term.first == "Covered" || term.first == "95 % interval";
  });

  // Terms of a search only.
  terms.insert(terms.end(),
               {{"Standard error",
                 "of the mean over the divisions' ESR. Within one of the best, a smaller network "
                 "is taken to be as good (Breiman and others, 1984)."},
                {"Front", "networks of which none with as few parameters has a smaller error."},
                {"Dropped",
                 "by halving: judged with a share of the effort, and not among the best third "
                 "(Jamieson and Talwalkar, 2016)."}});
  return terms;
}

std::vector<KeyFigure> key_figures(const SearchReport& search) {
  const Trial *best = search.best(), *smallest = search.smallest();
  if (!best) return {};
  return {{percent_text(best->left_out.esr), "%",
           "of the force's power left unexplained by the best (ESR)"},
          {std::to_string(best->parameters), "", "parameters of the best"},
          {percent_text(smallest->left_out.esr), "%",
           "ESR of the smallest network within one standard error"},
          {std::to_string(smallest->parameters), "", "parameters of the smallest"}};
}

}  // namespace

std::string searched_settings(const Trial& trial, const SearchReport& search) {
  std::vector<std::string> parts;
  for (const SearchAxis& axis : search.options.space.axes)
    if (const std::string value = setting_text(trial, axis.setting); !value.empty())
      parts.push_back(axis.setting + '=' + value);
  return join(parts, ", ");
}

DocumentTable trial_table(const std::vector<Trial>& trials, const SearchReport& of,
                          std::size_t most) {
  DocumentTable table{.title = {}, .columns = {{"#", true}}, .rows = {}};
  for (const SearchAxis& axis : of.options.space.axes)
    table.columns.push_back(
        {.title = axis.setting,
         .numeric = true,
         .hint = std::string(find_network_setting(axis.setting, axis.setting).meaning)});
  table.columns.insert(table.columns.end(),
                       {{.title = "ESR %",
                         .numeric = true,
                         .hint = "Error power over force power, left-out records, one offset per "
                                 "record; with the standard error of its mean over the divisions"},
                        {.title = "Worst %",
                         .numeric = true,
                         .priority = 1,
                         .hint = "ESR of the worst left-out record"},
                        {"RMSE N", true, 2},
                        {.title = "Par.", .numeric = true, .hint = "Fitted numbers"}});
  const bool is_halved = of.rungs.size() > 1;
  if (is_halved)
    table.columns.push_back(
        {.title = "Effort",
         .numeric = true,
         .hint = "The share of the full effort at which the trial was last judged"});
  table.columns.push_back({.title = "Fit s",
                           .numeric = true,
                           .hint = "CPU time of all divisions",
                           .audience = Audience::Page});
  table.columns.push_back({.title = "Note",
                           .elastic = true,
                           .hint = "smallest: the smallest network within one standard error of "
                                   "the best; front: none better with as few parameters"});

  // A row per trial; of one that failed its settings and why.
  for (std::size_t k = 0; k < std::min(most, trials.size()); ++k) {
    const Trial& trial = trials[k];
    std::vector<DocumentCell> row{{std::to_string(k + 1)}};
    for (const SearchAxis& axis : of.options.space.axes) {
      const std::string value = setting_text(trial, axis.setting);
      row.push_back({value.empty() ? "-" : value});
    }
    const auto cell = [&](const std::string& text, double key) {
      return trial.failure.empty() ? DocumentCell{text, key} : DocumentCell{"-", NAN};
    };
    row.push_back(cell(error_text(trial), trial.left_out.esr));
    row.push_back(cell(percent_text(trial.worst_esr), trial.worst_esr));
    row.push_back(cell(number_text(trial.left_out.rmse), trial.left_out.rmse));
    row.push_back(cell(std::to_string(trial.parameters), static_cast<double>(trial.parameters)));
    if (is_halved) {
      const double share = of.rungs[trial.rung].share;
      row.push_back({share_text(share), share});
    }
    row.push_back({number_text(trial.seconds, 2), trial.seconds});
    row.push_back({note_of(trial, of)});
    add_row(table, row);
    table.warnings.push_back(!trial.is_usable());
  }
  return table;
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

  // A smaller network that is practically as good is the usual choice.
  const Trial* smallest = search.smallest();
  if (!std::isfinite(best->standard_error))
    text +=
        " There is one division only, so that there is no standard error to say which others are "
        "as good.";
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

Document search_document(const SearchInput& input) {
  constexpr std::size_t kBrief = 30;  // trials on a terminal
  const SearchReport& search = input.search;
  const std::string plan = search_plan(search.rungs, search.options.effort);
  Document document{.title = input.dataset.name + ", search of " + search.options.model,
                    .subtitle = counted(input.dataset.records.size(), "record") + " · " + plan +
                                " · " + protocol_title(search.leave_out),
                    .verdict = search_verdict(search),
                    .sections = {},
                    .command = input.command,
                    .version = input.version,
                    .date = input.date,
                    .kind = "search",
                    .key_figures = key_figures(search),
                    .data = json_search(input)};

  // Error against size, then by each setting.
  document.sections.push_back({.name = "size",
                               .title = "Error and size",
                               .paragraphs = {},
                               .figures = {{.name = "size",
                                            .title = {},
                                            .caption = {},
                                            .panels = {size_panel(search)},
                                            .audience = Audience::Page}},
                               .lead = "The smallest network within one standard error of the best "
                                       "is the usual choice: what is beyond it may be chance.",
                               .audience = Audience::Page});
  DocumentFigure settings{.name = "settings",
                          .title = {},
                          .caption = {},
                          .panels = {},
                          .columns = 2,
                          .audience = Audience::Page};
  for (const SearchAxis& axis : search.options.space.axes)
    settings.panels.push_back(setting_panel(search, axis));
  document.sections.push_back({.name = "settings",
                               .title = "Setting by setting",
                               .paragraphs = {},
                               .figures = {std::move(settings)},
                               .lead = "All trials over each setting that was searched; the other "
                                       "settings vary at the same time.",
                               .audience = Audience::Page});

  // All trials, of which a terminal shows the best.
  DocumentTable trials = trial_table(search.trials, search, search.trials.size());
  if (trials.rows.size() > kBrief) {
    trials.brief.resize(kBrief);
    std::iota(trials.brief.begin(), trials.brief.end(), std::size_t{0});
  }
  document.sections.push_back({.name = "trials",
                               .title = "Trials",
                               .paragraphs = {},
                               .tables = {std::move(trials)},
                               .lead = "Best first; a click on a head sorts."});
  document.sections.push_back(judged_section(protocol(search.leave_out, search.folds.size()),
                                             search.folds, search_terms()));
  document.provenance = provenance_section(input.dataset, "All trials are shown.");
  return document;
}

}  // namespace dashpot
