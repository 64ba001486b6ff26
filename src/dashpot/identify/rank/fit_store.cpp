#include "dashpot/identify/rank/fit_store.h"

#include <algorithm>

#include "dashpot/base/any_number.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/law/law_text.h"
#include "dashpot/damper/nets/kernel.h"
#include "dashpot/damper/registry.h"
#include "dashpot/error.h"
#include "dashpot/identify/rank/fit_identity.h"
#include "dashpot/model_file.h"

namespace dashpot {
namespace {

Value to_json(const FittedParameter& p) {
  return Value::array({p.name, p.unit, p.meaning, any_number(p.value), any_number(p.low),
                       any_number(p.high), p.fixed, p.at_bound, p.weak});
}

FittedParameter read_parameter(const Value& value) {
  const std::vector<Value>& v = value.items();
  if (v.size() != 9) throw Error(value.where(), "is not a fitted parameter");
  return {v[0].as_string(),      v[1].as_string(),      v[2].as_string(),
          read_any_number(v[3]), read_any_number(v[4]), read_any_number(v[5]),
          v[6].as_bool(),        v[7].as_bool(),        v[8].as_bool()};
}

/// The model as it stands in a file of its own, which needs the drive's unit and range.
std::string model_text(const FitStore::Request& request, const FitReport& fit) {
  ModelFile file;
  file.model = fit.model->with_offset(0);
  file.drive_unit = request.drive_unit;
  const DriveRange drive = drive_range(request.training, request.drive_unit);
  file.domain.current_min = drive.low;
  file.domain.current_max = drive.high;
  return format_model(file);
}

std::string format_fit(const FitStore::Request& request, const FitReport& fit) {
  Value parameters = Value::array(), covariance = Value::array(), offsets = Value::array();
  for (const FittedParameter& p : fit.parameters) parameters.push_back(to_json(p));
  for (const double c : fit.covariance) covariance.push_back(any_number(c));
  for (const auto& [record, offset] : fit.offsets) offsets.push_back(offset);

  return format_json(Value::object({{"converged", fit.status == FitReport::Status::Converged},
                                    {"message", fit.message},
                                    {"model", model_text(request, fit)},
                                    {"parameters", std::move(parameters)},
                                    {"covariance", std::move(covariance)},
                                    {"offsets", std::move(offsets)},
                                    {"warnings", Value::array(fit.warnings)},
                                    {"iterations", fit.iterations},
                                    {"seconds", fit.seconds},
                                    {"training_rmse", any_number(fit.training_rmse)}}),
                     false);
}

/// The offsets stand in the order of the training records, which have their names.
void read_offsets(const Value& value, const std::vector<Record>& training, FitReport& fit) {
  const std::vector<double> offsets = value.as_numbers();
  if (!offsets.empty() && offsets.size() != training.size())
    throw Error(value.where(), "does not hold one offset per record");
  for (std::size_t k = 0; k < offsets.size(); ++k)
    fit.offsets.emplace_back(training[k].name, offsets[k]);
}

/// Throws Error, naming the key, when the text is not a kept fit on these records.
FitReport parse_fit(const std::string& text, const std::string& key,
                    const std::vector<Record>& training) {
  const Value value = parse_json(text, key);
  ObjectReader reader(value, "a kept fit");
  FitReport fit;

  // How the fit ended, and the model.
  fit.status = reader.required("converged").as_bool() ? FitReport::Status::Converged
                                                      : FitReport::Status::IterationLimit;
  fit.message = reader.string("message");
  fit.model = parse_model(reader.string("model"), value.where()).model;

  // Its figures.
  for (const Value& p : reader.required("parameters").items())
    fit.parameters.push_back(read_parameter(p));
  for (const Value& c : reader.required("covariance").items())
    fit.covariance.push_back(read_any_number(c));
  if (const std::size_t count = fit.parameters.size();
      !fit.covariance.empty() && fit.covariance.size() != count * count)
    throw Error(value.where(), "holds a covariance of other parameters");
  read_offsets(reader.required("offsets"), training, fit);
  for (const Value& warning : reader.required("warnings").items())
    fit.warnings.push_back(warning.as_string());
  fit.iterations = static_cast<int>(std::clamp(reader.number("iterations"), 0.0, 1e9));
  fit.seconds = reader.number("seconds");
  fit.training_rmse = read_any_number(reader.required("training_rmse"));
  reader.finish();
  return fit;
}

}  // namespace

FitStore::FitStore(const std::filesystem::path& path, std::string program)
    : program_(std::move(program)), store_(path, kFormat) {}

std::string FitStore::key_of(const Request& request) const {
  std::vector<std::string> parts{program_, request.model, fingerprint(request.training),
                                 to_string(request.drive_unit),
                                 std::string(name_of(simd_levels().back()))};
  for (const auto& [name, value] : describe_options(request.options)) parts.push_back(value);
  if (const Law* law = law_inside(request.model); law && law->text)
    parts.push_back(format_json(law->text->definition()));
  return request.model + ' ' + sha256(join(parts, "\n"));
}

std::optional<FitReport> FitStore::load(const Request& request) const {
  const std::string key = key_of(request);
  const std::optional<std::string> bytes = store_.load(key);
  if (!bytes) return std::nullopt;

  // A damaged fit is as good as none: the caller makes it again and saves it in this one's place.
  try {
    return parse_fit(*bytes, key, request.training);
  } catch (const Error&) {
    return std::nullopt;
  }
}

void FitStore::save(const Request& request, const FitReport& fit) {
  if (fit.model) store_.save(key_of(request), format_fit(request, fit));
}

}  // namespace dashpot
