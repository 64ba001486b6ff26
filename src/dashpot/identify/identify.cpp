#include "dashpot/identify.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/parallel.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/registry.h"
#include "dashpot/error.h"
#include "dashpot/identify/fit/fit.h"
#include "dashpot/identify/fit/uncertainty.h"

namespace dashpot {
namespace {

void require_usable(const std::string& model, const std::vector<Record>& training) {
  if (training.empty()) throw Error(model, "there is no record to fit it on");
  const bool needs_displacement = model_info(model).needs_displacement();
  for (const Record& record : training)
    if (needs_displacement && !record.find("displacement"))
      throw Error(record.name, "has no displacement, which " + model + " needs",
                  "record it, or leave this model out with --models");
}

/// Of the mean of the records' offsets, N: by how they differ; where there is one record alone, by
/// how its residuals scatter about its offset.
double error_of_mean_offset(const Evaluation& on_training, double mean) {
  const double n = static_cast<double>(on_training.records.size());
  if (n > 1) {
    double square = 0;
    for (const RecordResult& r : on_training.records)
      square += (r.offset - mean) * (r.offset - mean);
    return std::sqrt(square / (n - 1) / n);
  }

  const RecordResult& record = on_training.records.front();
  std::vector<double> residuals;
  for (std::size_t k = record.warm_up; k < record.measured.size(); ++k)
    residuals.push_back(record.measured[k] - record.modelled[k]);
  if (residuals.size() < 2) return 0;
  const double variance = independent_variances(residuals, {{0, residuals.size()}}, 1).front();
  return std::sqrt(variance / static_cast<double>(residuals.size()));
}

/// Gives the model the mean offset of its training records as its bias, and reports what each
/// record differs by.
void settle_offsets(FitReport& report, const std::vector<Record>& training, DriveUnit drive_unit,
                    const IdentifyOptions& options) {
  if (options.offset == OffsetMode::None) return;
  const Evaluation on_training =
      evaluate(*report.model, training, drive_unit, {.threads = options.threads});

  // The mean of the records' offsets becomes the model's bias; each record keeps its difference.
  const double n = static_cast<double>(on_training.records.size());
  double mean = 0;
  for (const RecordResult& r : on_training.records) mean += r.offset / n;
  report.model = report.model->with_offset(mean);
  for (const RecordResult& r : on_training.records)
    report.offsets.emplace_back(r.record, r.offset - mean);

  // A law has a parameter for the bias: report the mean there, with its 95 % interval.
  const auto* law = model_as<LawModel>(*report.model);
  if (!law) return;
  const double error = error_of_mean_offset(on_training, mean), spread = 1.96 * error;
  for (const ParamInfo& param : law->law().params) {
    if (param.fit != Fit::Bias) continue;
    const std::size_t count = report.parameters.size();
    for (std::size_t k = 0; k < count; ++k) {
      FittedParameter& fitted = report.parameters[k];
      if (fitted.name != param.name) continue;
      fitted = {fitted.name, fitted.unit,   "mean force offset of the records",
                mean,        mean - spread, mean + spread};
      report.covariance[k * count + k] = error * error;
    }
  }
}

}  // namespace

FitReport identify(const std::string& model, const std::vector<Record>& training,
                   DriveUnit drive_unit, const IdentifyOptions& options) {
  require_usable(model, training);
  const double begin = cpu_seconds();
  FitReport report = fit_of(model_info(model).kind).fit(model, training, drive_unit, options);
  if (report.status != FitReport::Status::Failed)
    settle_offsets(report, training, drive_unit, options);
  report.seconds = cpu_seconds() - begin;
  return report;
}

}  // namespace dashpot
