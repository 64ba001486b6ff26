#include "dashpot/damper/parameter_set.h"

#include <algorithm>
#include <filesystem>

#include "dashpot/base/data_folder.h"
#include "dashpot/base/file.h"
#include "dashpot/base/require_keys.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/file_parts.h"
#include "dashpot/error.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

/// Nothing where the driver can give any level.
std::vector<double> read_drive_levels(const Value* levels, double low, double high) {
  if (!levels) return {};
  const std::vector<double> values = levels->as_numbers();
  if (values.size() < 2 || !std::ranges::is_sorted(values, std::less_equal<>{}) ||
      values.front() < low || values.back() > high)
    throw Error(levels->where(), "are not levels", "at least two, rising, within drive_range");
  return values;
}

}  // namespace

std::vector<std::string> parameter_set_names() { return data_names("parameters", ".json"); }

ParameterSet parse_parameter_set(std::string_view text, const std::string& source,
                                 const std::string& name) {
  const Value document = parse_json(text, source);
  ObjectReader reader(document, "a parameter set");
  require_keys(document, "a parameter set",
               {"model", "drive_range", "damper", "source", "verified", "reason"});
  const Value& model = reader.required("model");
  const Value& range = reader.required("drive_range");
  const std::vector<double> ends = range.as_numbers();
  if (ends.size() != 2 || !(ends[0] <= ends[1]))
    throw Error(range.where(), "is not a range", "write [lowest, highest]");

  // Read the rest; the bounds must hold at both ends of the range.
  ParameterSet set{
      .name = name,
      .damper = reader.string("damper"),
      .source = reader.string("source"),
      .verified = reader.required("verified").as_bool(),
      .reason = reader.string("reason"),
      .drive_min = ends[0],
      .drive_max = ends[1],
      .model = std::move(*law_model_from_json(model)),
      .drive_levels = read_drive_levels(reader.optional("drive_levels"), ends[0], ends[1])};
  if (const Value* dissipation = reader.optional("dissipation"))
    set.dissipation = read_dissipation(*dissipation);
  reader.finish();
  for (const double drive : ends) require_bounds(set.model, drive, model.where());
  return set;
}

ParameterSet load_parameter_set(const std::string& name) {
  const std::vector<std::string> known = parameter_set_names();
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw Error("", "unknown parameter set '" + name + "'", suggest(name, known));
  const fs::path path = data_folder("parameters") / (name + ".json");
  return parse_parameter_set(read_file(path), path.string(), name);
}

ModelFile to_model_file(const ParameterSet& set) {
  ModelFile file;
  file.model = std::make_unique<LawModel>(set.model);
  file.drive_unit = set.model.drive_unit();
  file.domain.current_min = set.drive_min;
  file.domain.current_max = set.drive_max;
  if (set.dissipation.is_tested) file.dissipation = set.dissipation;
  file.provenance.dataset = set.damper;
  file.provenance.citation = set.source + (set.verified ? "" : " (an example: " + set.reason + ")");
  return file;
}

LawModel load_parameters(const std::string& name) { return load_parameter_set(name).model; }

}  // namespace dashpot
