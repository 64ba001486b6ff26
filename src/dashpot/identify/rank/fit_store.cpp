#include "dashpot/identify/rank/fit_store.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/identify/rank/fit_identity.h"
#include "dashpot/model_file.h"

namespace dashpot {
namespace {

constexpr std::string_view kFormat = "dashpot fit 1";

/// JSON has no infinity: an interval without a bound becomes null, and not a number when it is
/// read.
Value number(double value) { return std::isfinite(value) ? Value(value) : Value(); }

double number(const Value& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.as_number();
}

Value to_json(const FittedParameter& p) {
  return Value::array({p.name, p.unit, p.meaning, number(p.value), number(p.low), number(p.high),
                       p.fixed, p.at_bound, p.weak});
}

FittedParameter read_parameter(const Value& value) {
  const std::vector<Value>& v = value.items();
  if (v.size() != 9) throw Error(value.where(), "is not a fitted parameter");
  return {v[0].as_string(), v[1].as_string(), v[2].as_string(), number(v[3]),  number(v[4]),
          number(v[5]),     v[6].as_bool(),   v[7].as_bool(),   v[8].as_bool()};
}

Value to_json(const FitStore::Request& request, const FitReport& fit) {
  Value parameters = Value::array(), offsets = Value::array();
  for (const FittedParameter& p : fit.parameters) parameters.push_back(to_json(p));
  for (const auto& [record, offset] : fit.offsets) offsets.push_back(offset);
  ModelFile file;
  file.model = fit.model->with_offset(0);
  file.drive_unit = request.drive_unit;
  const DriveRange drive = drive_range(request.training, request.drive_unit);
  file.domain.current_min = drive.low;
  file.domain.current_max = drive.high;
  return Value::object({{"converged", fit.status == FitReport::Status::Converged},
                        {"message", fit.message},
                        {"model", format_model(file)},
                        {"parameters", std::move(parameters)},
                        {"offsets", std::move(offsets)},
                        {"warnings", Value::array(fit.warnings)},
                        {"iterations", fit.iterations},
                        {"seconds", fit.seconds},
                        {"training_rmse", number(fit.training_rmse)}});
}

/// The offsets stand in the order of the training records, which have their names.
void read_offsets(const Value& value, const std::vector<Record>& training, FitReport& fit) {
  const std::vector<double> offsets = value.as_numbers();
  if (!offsets.empty() && offsets.size() != training.size())
    throw Error(value.where(), "has not one offset per record");
  for (std::size_t k = 0; k < offsets.size(); ++k)
    fit.offsets.emplace_back(training[k].name, offsets[k]);
}

FitReport read_fit(const Value& value, const std::vector<Record>& training) {
  ObjectReader reader(value, "a kept fit");
  FitReport fit;
  fit.status = reader.required("converged").as_bool() ? FitReport::Status::Converged
                                                      : FitReport::Status::IterationLimit;
  fit.message = reader.string("message");
  fit.model = parse_model(reader.string("model"), value.where()).model;
  for (const Value& p : reader.required("parameters").items())
    fit.parameters.push_back(read_parameter(p));
  read_offsets(reader.required("offsets"), training, fit);
  for (const Value& warning : reader.required("warnings").items())
    fit.warnings.push_back(warning.as_string());
  fit.iterations = static_cast<int>(std::clamp(reader.number("iterations"), 0.0, 1e9));
  fit.seconds = reader.number("seconds");
  const Value* rmse = reader.optional("training_rmse");
  fit.training_rmse = rmse ? number(*rmse) : number(Value());
  reader.finish();
  return fit;
}

}  // namespace

FitStore::FitStore(std::filesystem::path folder, std::string program)
    : folder_(std::move(folder)), program_(std::move(program)) {}

std::string FitStore::key_of(const Request& request) const {
  std::vector<std::string> parts{program_, request.model, fingerprint(request.training),
                                 to_string(request.drive_unit)};
  for (const auto& [name, value] : describe_options(request.options)) parts.push_back(value);
  return join(parts, "\n");
}

std::filesystem::path FitStore::file_of(const Request& request, const std::string& key) const {
  return folder_ / (request.model + "-" + sha256(key).substr(0, 16) + ".json");
}

std::optional<FitReport> FitStore::load(const Request& request) const {
  const std::string key = key_of(request);
  const std::filesystem::path path = file_of(request, key);
  if (!std::filesystem::exists(path)) return std::nullopt;
  try {
    const Value document = parse_json(read_file(path), path.string());
    ObjectReader reader(document, "a kept fit");
    if (reader.string("format") != kFormat || reader.string("key") != key) return std::nullopt;
    return read_fit(reader.required("fit"), request.training);
  } catch (const Error&) {  // damaged or from elsewhere: the fit is made again
    return std::nullopt;
  }
}

void FitStore::save(const Request& request, const FitReport& fit) const {
  if (!fit.model) return;
  const std::string key = key_of(request);
  write_file(file_of(request, key),
             format_json(Value::object(
                 {{"format", kFormat}, {"key", key}, {"fit", to_json(request, fit)}})));
}

}  // namespace dashpot
