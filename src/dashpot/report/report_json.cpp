#include "dashpot/report/report_json.h"

#include <algorithm>

#include "dashpot/base/any_number.h"
#include "dashpot/base/escape.h"
#include "dashpot/damper/file_parts.h"
#include "dashpot/damper/force_band.h"
#include "dashpot/identify/judge/stress.h"
#include "dashpot/identify/rank/information.h"
#include "dashpot/identify/rank/paired_ratio.h"
#include "dashpot/report/predicted_ride_section.h"
#include "dashpot/report/quantity.h"
#include "dashpot/report/ranking_words.h"
#include "dashpot/report/residual_section.h"

namespace dashpot {

namespace {

Value optional_number(const std::optional<double>& value) {
  return value ? Value(*value) : Value();
}

Value coverage_json(const Coverage& coverage) {
  if (coverage.samples == 0) return {};
  return Value::object({{"coverage_percent", coverage.percent()},
                        {"mean_width_N", coverage.mean_width()},
                        {"mean_width_percent", coverage.mean_width_percent()}});
}

Value band_json(const std::optional<ForceBand>& band) { return band ? to_json(*band) : Value(); }

Value record_json(const RecordResult& record) {
  const std::size_t first =
      std::min(record.warm_up, record.time.empty() ? 0 : record.time.size() - 1);
  return Value::object({{"record", record.record},
                        {"condition", record.condition},
                        {"drive_level", optional_number(record.drive_level)},
                        {"left_out", record.left_out},
                        {"scored_from", record.time.empty() ? Value() : Value(record.time[first])},
                        {"offset_N", record.offset},
                        {"metrics", to_json(record.metrics)},
                        {"metrics_without_offset", to_json(record.metrics_without_offset)},
                        {"energy_error_percent", record.energy_error},
                        {"interval", coverage_json(record.coverage)},
                        {"band", band_json(record.band)},
                        {"diverged_at", optional_number(record.diverged_at)}});
}

Value parameter_json(const FittedParameter& p) {
  return Value::object({{"name", p.name},
                        {"unit", p.unit},
                        {"meaning", p.meaning},
                        {"value", p.value},
                        {"low", p.low},
                        {"high", p.high},
                        {"fixed", p.fixed},
                        {"at_bound", p.at_bound},
                        {"weak", p.weak}});
}

Value stress_json(const StressRun& run) {
  if (run.seconds == 0) return {};
  return Value::object({{"seconds", run.seconds},
                        {"factor", kStressFactor},
                        {"finite", run.finite},
                        {"bounded", run.is_bounded()},
                        {"largest_spans", run.largest_share}});
}

Value forgetting_json(const Forgetting& result) {
  if (!result.is_tested) return {};
  return Value::object({{"forgets", result.is_forgotten()},
                        {"seconds", result.seconds},
                        {"percent_left", any_number(100 * result.share_left)},
                        {"record", result.record}});
}

Value over_first_json(const std::optional<PairedRatio>& ratio) {
  if (!ratio) return {};
  return Value::object({{"times", ratio->times},
                        {"low", ratio->low},
                        {"high", ratio->high},
                        {"level_percent", 100 * kPairedLevel},
                        {"units", ratio->units},
                        {"told_apart", ratio->is_worse()}});
}

Value information_json(const RankedModel& model,
                       const std::optional<InformationCriteria>& criteria) {
  if (!criteria) return {};
  return Value::object({{"samples", model.likelihood->samples},
                        {"correlation_length", model.likelihood->correlation_length},
                        {"independent_samples", criteria->independent},
                        {"parameters", model.likelihood->parameters},
                        {"log_likelihood", criteria->log_likelihood},
                        {"aic", criteria->aic},
                        {"bic", criteria->bic}});
}

/// Tests of the residuals with their statistics, limits and verdicts, record by record.
Value residual_tests_json(const std::vector<ResidualTest>& tests) {
  Value list = Value::array();
  for (const ResidualTest& test : tests) {
    if (!test.is_tested()) continue;
    Value inputs = Value::array();
    for (const InputCorrelation& with : test.inputs)
      inputs.push_back(Value::object({{"input", with.input},
                                      {"largest", with.largest},
                                      {"delay", with.delay},
                                      {"t", with.statistic},
                                      {"limit", with.limit},
                                      {"independent", with.is_independent()}}));

    list.push_back(Value::object({{"record", test.record},
                                  {"samples", test.samples},
                                  {"lags", test.lags},
                                  {"ljung_box", test.portmanteau},
                                  {"limit", test.limit},
                                  {"white", test.is_white()},
                                  {"memory", test.memory},
                                  {"inputs", std::move(inputs)}}));
  }
  return Value::object({{"confidence", kResidualConfidence},
                        {"verdict", residual_verdict(tests)},
                        {"records", std::move(list)}});
}

Value model_json(const RankedModel& model, const std::vector<std::string>& folds,
                 const std::vector<ResidualTest>& tests,
                 const std::optional<InformationCriteria>& criteria) {
  Value fold_fits = Value::array();
  for (std::size_t i = 0; i < model.fold_fits.size(); ++i) {
    Value fit = fit_json(model.fold_fits[i]);
    fit.add("fold", i < folds.size() ? folds[i] : "");
    fold_fits.push_back(std::move(fit));
  }

  // A failed fit has neither kind nor parameters.
  const auto& fitted = model.fit.model;
  Value object =
      Value::object({{"name", model.name},
                     {"title", display_name(model)},
                     {"kind", fitted ? Value(name_of(fitted->kind())) : Value()},
                     {"parameter_count", fitted ? Value(fitted->parameter_count()) : Value()},
                     {"nanoseconds_per_step", model.nanoseconds_per_step},
                     {"seconds", model.seconds},
                     {"interval", band_json(model.band)},
                     {"over_first", over_first_json(model.over_first)},
                     {"esr_parts_percent", Value::array(model.esr_parts)},
                     {"forgetting", forgetting_json(model.forgetting)},
                     {"dissipation", to_json(model.dissipation)},
                     {"stress", stress_json(model.stress)},
                     {"fit", fit_json(model.fit)},
                     {"fold_fits", std::move(fold_fits)},
                     {"left_out", evaluation_json(model.left_out)},
                     {"training", evaluation_json(model.training)},
                     {"residual_tests", residual_tests_json(tests)},
                     {"information", information_json(model, criteria)}});
  if (!model.validation.records.empty())
    object.add("validation", evaluation_json(model.validation));
  if (model.ride) object.add("ride", predicted_json(model));
  return object;
}

}  // namespace

Value evaluation_json(const Evaluation& evaluation) {
  Value records = Value::array(), bands = Value::array();
  for (const RecordResult& record : evaluation.records) records.push_back(record_json(record));
  for (const BandResult& band : evaluation.bands)
    bands.push_back(Value::object({{"name", band.name},
                                   {"low", band.low},
                                   {"high", band.high},
                                   {"metrics", to_json(band.metrics)}}));
  Value drive = Value::array();
  for (const DriveResult& range : evaluation.drive)
    drive.push_back(Value::object(
        {{"low", range.low}, {"high", range.high}, {"metrics", to_json(range.metrics)}}));

  // Intervals with the record that they cover worst.
  Value interval = coverage_json(evaluation.coverage);
  if (const RecordResult* worst = evaluation.worst_covered()) {
    interval.add("level_percent", 100 * worst->band->level);
    interval.add("worst_coverage_percent", worst->coverage.percent());
    interval.add("worst_record", worst->record);
  }

  // Pooled figures first, single records last.
  Value value = Value::object({{"pooled", to_json(evaluation.pooled)},
                               {"pooled_without_offset", to_json(evaluation.pooled_without_offset)},
                               {"worst_esr_percent", evaluation.worst_esr},
                               {"worst_record", evaluation.worst_record},
                               {"mean_esr_percent", evaluation.mean_esr},
                               {"mean_energy_error_percent", evaluation.mean_energy_error},
                               {"diverged", evaluation.diverged},
                               {"interval", std::move(interval)},
                               {"bands", std::move(bands)},
                               {"drive", std::move(drive)},
                               {"records", std::move(records)}});
  if (evaluation.one_step) value.add("one_step", to_json(*evaluation.one_step));
  return value;
}

Value evaluation_json(const ModelFile& file, const Evaluation& evaluation,
                      const std::vector<Extrapolation>& outside, std::size_t without_inertia) {
  Value value = evaluation_json(evaluation);
  value.add("model", file.model->name());
  if (without_inertia > 0)
    value.add("without_inertia",
              Value::object({{"mass_kg", file.moving_mass}, {"records", without_inertia}}));
  value.add("outside_domain", to_json(outside));
  value.add("outside_family", Value::array(outside_family(evaluation)));
  std::vector<ResidualTest> tests;
  for (const RecordResult& record : evaluation.records) tests.push_back(test_residual(record));
  value.add("residual_tests", residual_tests_json(tests));
  return value;
}

Value fit_json(const FitReport& fit) {
  Value parameters = Value::array(), offsets = Value::array();
  for (const FittedParameter& parameter : fit.parameters)
    parameters.push_back(parameter_json(parameter));
  for (const auto& [record, offset] : fit.offsets)
    offsets.push_back(Value::object({{"record", record}, {"offset_N", offset}}));
  // Row by row, in the order of the parameters and in their units.
  Value covariance = Value::array();
  for (std::size_t k = 0; k * fit.parameters.size() < fit.covariance.size(); ++k) {
    Value row = Value::array();
    for (std::size_t j = 0; j < fit.parameters.size(); ++j)
      row.push_back(fit.covariance[k * fit.parameters.size() + j]);
    covariance.push_back(std::move(row));
  }
  return Value::object({{"status", status_name(fit.status)},
                        {"message", fit.message},
                        {"iterations", fit.iterations},
                        {"seconds", fit.seconds},
                        {"training_rmse_N", fit.training_rmse},
                        {"parameters", std::move(parameters)},
                        {"covariance", std::move(covariance)},
                        {"offsets", std::move(offsets)},
                        {"warnings", Value::array(fit.warnings)}});
}

Value dataset_json(const Dataset& dataset) {
  Value files = Value::array();
  for (const SourceFile& file : dataset.files)
    files.push_back(Value::object({{"path", file.path}, {"sha256", file.sha256}}));
  return Value::object({{"name", dataset.name},
                        {"citation", dataset.citation},
                        {"drive_unit", to_string(dataset.drive_unit)},
                        {"records", dataset.records.size()},
                        {"files", std::move(files)},
                        {"notes", Value::array(dataset.notes)}});
}

/// Of models that nobody named one by one: what they were chosen by.
Value budget_json(const Ranking& ranking) {
  const FitBudget& budget = *ranking.budget;
  Value untried = Value::array();
  for (const UntriedModel& model : budget.untried)
    untried.push_back(Value::object({{"name", model.name},
                                     {"title", model.title},
                                     {"minutes", model.minutes},
                                     {"budget_minutes", model.budget_minutes}}));
  const std::optional<std::string> note = budget_note(ranking);
  return Value::object({{"minutes", budget.minutes},
                        {"expected_minutes", budget.expected_minutes},
                        {"untried", std::move(untried)},
                        {"note", note ? Value(*note) : Value()}});
}

Value json_report(const ReportInput& input) {
  const Ranking& ranking = input.ranking;
  const std::vector<std::vector<ResidualTest>> tests = residual_tests(ranking);
  const std::vector<std::optional<InformationCriteria>> criteria = information_criteria(ranking);
  Value models = Value::array();
  for (std::size_t k = 0; k < ranking.models.size(); ++k)
    models.push_back(model_json(ranking.models[k], ranking.folds, tests[k], criteria[k]));
  Value leaders = Value::array();
  for (const RankedModel* model : ranking.leaders()) leaders.push_back(model->name);
  const std::optional<std::string> one_step = one_step_note(ranking);

  // Provenance and protocol first.
  Value report =
      Value::object({{"format", "dashpot report 1"},
                     {"version", input.version},
                     {"date", input.date},
                     {"command", input.command},
                     {"dataset", dataset_json(input.dataset)},
                     {"leave_out", format_leave_out(ranking.leave_out)},
                     {"protocol_title", protocol_title(ranking)},
                     {"protocol", protocol(ranking)},
                     {"folds", Value::array(ranking.folds)},
                     {"verdict", in_units(verdict(ranking, input.dataset), PrintUnits::si())},
                     {"leaders", std::move(leaders)},
                     {"unit", ranking.unit},
                     {"one_step", one_step ? Value(*one_step) : Value()},
                     {"wall_seconds", ranking.wall_seconds},
                     {"models", std::move(models)}});

  // Only a ranking whose models Dashpot chose has a budget.
  if (ranking.budget) report.add("budget", budget_json(ranking));
  if (ranking.inertia)
    report.add("inertia", Value::object({{"mass_kg", ranking.inertia->mass},
                                         {"model", ranking.inertia->model},
                                         {"rmse_before_N", ranking.inertia->before},
                                         {"rmse_after_N", ranking.inertia->after}}));
  if (!ranking.validated_on.empty()) report.add("validated_on", ranking.validated_on);
  if (ranking.ridden) report.add("ride", ridden_json(ranking));
  return presentable(std::move(report));
}

}  // namespace dashpot
