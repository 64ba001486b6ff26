// A search for programs: JSON and CSV.
#include <cmath>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/report/ranking_words.h"
#include "dashpot/report/report_json.h"
#include "dashpot/report/search_report.h"

namespace dashpot {
namespace {

Value axis_json(const SearchAxis& axis) {
  Value json = Value::object({{"setting", axis.setting}});
  json.add("meaning", std::string(find_network_setting(axis.setting, axis.setting).meaning));
  if (axis.values.empty())
    json.add("range", Value::array({Value(axis.low), Value(axis.high)}));
  else
    json.add("values", Value::array(axis.values));
  return json;
}

Value trial_json(const Trial& trial, const SearchReport& search) {
  Value settings = Value::object();
  for (const SearchAxis& axis : search.options.space.axes)
    if (const std::string value =
            find_network_setting(axis.setting, axis.setting).format(trial.design);
        !value.empty())
      settings.add(axis.setting, value);

  // The error of each fold, of which the standard error is made.
  Value folds = Value::array();
  for (const FoldResult& fold : trial.folds) folds.push_back(metrics(fold.sums).esr);
  return Value::object({{"design", format_design(trial.design)},
                        {"settings", std::move(settings)},
                        {"effort", search.rungs[trial.rung].share},
                        {"parameters", trial.parameters},
                        {"left_out", to_json(trial.left_out)},
                        {"standard_error_percent", trial.standard_error},
                        {"worst_esr_percent", trial.worst_esr},
                        {"fold_esr_percent", std::move(folds)},
                        {"diverged", trial.diverged},
                        {"failure", trial.failure},
                        {"usable", trial.is_usable()},
                        {"finalist", search.is_finalist(trial)},
                        {"on_front", trial.on_front},
                        {"best", &trial == search.best()},
                        {"smallest", &trial == search.smallest()},
                        {"seconds", trial.seconds}});
}

}  // namespace

Value json_search(const SearchInput& input) {
  const SearchReport& search = input.search;
  Value axes = Value::array(), trials = Value::array();
  for (const SearchAxis& axis : search.options.space.axes) axes.push_back(axis_json(axis));
  for (const Trial& trial : search.trials) trials.push_back(trial_json(trial, search));

  // Provenance and protocol first.
  return presentable(Value::object({{"format", "dashpot search 1"},
                                    {"version", input.version},
                                    {"date", input.date},
                                    {"command", input.command},
                                    {"dataset", dataset_json(input.dataset)},
                                    {"leave_out", format_leave_out(search.leave_out)},
                                    {"protocol_title", protocol_title(search.leave_out)},
                                    {"protocol", protocol(search.leave_out, search.folds.size())},
                                    {"folds", Value::array(search.folds)},
                                    {"model", search.options.model},
                                    {"fixed", format_design(search.options.space.fixed)},
                                    {"plan", search_plan(search.rungs, search.options.effort)},
                                    {"verdict", search_verdict(search)},
                                    {"fits", search.results},
                                    {"kept_fits", search.kept},
                                    {"wall_seconds", search.wall_seconds},
                                    {"axes", std::move(axes)},
                                    {"trials", std::move(trials)}}));
}

std::string csv_search(const SearchReport& search) {
  std::string text = "rank";
  for (const SearchAxis& axis : search.options.space.axes) text += "," + axis.setting;
  text +=
      ",parameters,esr_percent,standard_error_percent,worst_esr_percent,rmse_N,samples,diverged_"
      "records,effort,usable,on_front,best,smallest,failure\n";
  const auto yes = [](bool value) { return std::string(value ? "yes" : "no"); };
  const auto number = [](double value) {
    return std::isfinite(value) ? format_exact(value) : std::string();
  };

  // No times: the table is the same whenever the search is.
  std::size_t rank = 0;
  for (const Trial& trial : search.trials) {
    std::vector<std::string> fields{std::to_string(++rank)};
    for (const SearchAxis& axis : search.options.space.axes)
      fields.push_back(
          csv_field(find_network_setting(axis.setting, axis.setting).format(trial.design)));
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
