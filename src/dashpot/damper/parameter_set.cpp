#include "dashpot/damper/parameter_set.h"

#include <algorithm>
#include <filesystem>

#include "dashpot/base/error.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

/// Beside the source when Dashpot runs where it was built, else where it was installed.
fs::path folder() {
  const fs::path source = fs::path(DASHPOT_DATA_SOURCE_DIR) / "parameters";
  return fs::is_directory(source) ? source : fs::path(DASHPOT_DATA_INSTALL_DIR) / "parameters";
}

/// Nothing where the driver can give any level.
std::vector<double> read_drive_levels(const Value* levels, double low, double high) {
  if (!levels) return {};
  const std::vector<double> values = levels->as_numbers();
  if (values.size() < 2 || !std::ranges::is_sorted(values, std::less_equal<>{}) || values.front() < low ||
      values.back() > high)
    throw Error(levels->where(), "are not levels", "at least two, rising, within drive_range");
  return values;
}

}  // namespace

std::vector<std::string> parameter_set_names() {
  std::vector<std::string> names;
  std::error_code missing;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder(), missing))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

ParameterSet parse_parameter_set(std::string_view text, const std::string& source, const std::string& name) {
  const Value document = parse_json(text, source);
  ObjectReader reader(document, "a parameter set");
  const Value& model = reader.required("model");
  const Value& range = reader.required("drive_range");
  const std::vector<double> ends = range.as_numbers();
  if (ends.size() != 2 || !(ends[0] <= ends[1]))
    throw Error(range.where(), "is not a range", "write [lowest, highest]");
  ParameterSet set{.name = name,
                   .damper = reader.string("damper"),
                   .source = reader.string("source"),
                   .verified = reader.required("verified").as_bool(),
                   .reason = reader.string("reason"),
                   .drive_min = ends[0],
                   .drive_max = ends[1],
                   .model = std::move(*law_model_from_json(model)),
                   .drive_levels = read_drive_levels(reader.optional("drive_levels"), ends[0], ends[1])};
  reader.finish();
  for (const double drive : ends) require_bounds(set.model, drive, model.where());
  return set;
}

ParameterSet load_parameter_set(const std::string& name) {
  const std::vector<std::string> known = parameter_set_names();
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw Error("", "unknown parameter set '" + name + "'", suggest(name, known));
  const fs::path path = folder() / (name + ".json");
  return parse_parameter_set(read_file(path), path.string(), name);
}

LawModel load_parameters(const std::string& name) { return load_parameter_set(name).model; }

}  // namespace dashpot
