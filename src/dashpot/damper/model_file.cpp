#include "dashpot/damper/model_file.h"

#include "dashpot/base/error.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/fuzzy/fuzzy_model.h"
#include "dashpot/damper/hybrid_model.h"
#include "dashpot/damper/law_model.h"
#include "dashpot/damper/neural/hysteresis_network.h"
#include "dashpot/damper/neural/network_model.h"

namespace dashpot {
namespace {

constexpr std::string_view kFormat = "dashpot-model";
constexpr int kVersion = 1;

/// One axis of the domain: its key, its unit and where its ends are kept.
struct Axis {
  std::string_view key;
  std::string unit;
  double Domain::* min;
  double Domain::* max;
};

std::vector<Axis> axes(const std::string& drive_unit) {
  return {{"displacement", "m", &Domain::displacement_min, &Domain::displacement_max},
          {"velocity", "m/s", &Domain::velocity_min, &Domain::velocity_max},
          {"drive", drive_unit, &Domain::current_min, &Domain::current_max}};
}

Value to_json(const Domain& domain, const std::string& drive_unit) {
  Value out = Value::object();
  for (const Axis& axis : axes(drive_unit))
    out.add(std::string(axis.key),
            Value::object({{"min", domain.*axis.min}, {"max", domain.*axis.max}, {"unit", axis.unit}}));
  return out;
}

Domain read_domain(const Value& value, const std::string& drive_unit) {
  Domain domain;
  ObjectReader reader(value, "the domain");
  for (const Axis& axis : axes(drive_unit)) {
    const Value& range = reader.required(axis.key);
    ObjectReader ends(range, "the domain of " + std::string(axis.key));
    domain.*axis.min = ends.number("min");
    domain.*axis.max = ends.number("max");
    const std::string unit = ends.string("unit");
    ends.finish();
    if (unit != axis.unit) throw Error(range.where(), "unit is '" + unit + "'", "write " + axis.unit);
    if (domain.*axis.min > domain.*axis.max) throw Error(range.where(), "min is above max");
  }
  reader.finish();
  return domain;
}

Value to_json(const Provenance& from) {
  std::vector<Value> files;
  for (const Provenance::File& file : from.files)
    files.push_back(Value::object({{"path", file.path}, {"sha256", file.sha256}}));
  return Value::object({{"created", from.created},
                        {"command", from.command},
                        {"dataset", from.dataset},
                        {"citation", from.citation},
                        {"files", Value::array(std::move(files))},
                        {"training_records", Value::array(from.training_records)}});
}

Provenance read_provenance(const Value& value) {
  Provenance from;
  ObjectReader reader(value, "the provenance");
  from.created = reader.string("created");
  from.command = reader.string("command");
  from.dataset = reader.string("dataset");
  from.citation = reader.string("citation");
  for (const Value& item : reader.required("files").items()) {
    ObjectReader file(item, "a provenance file");
    from.files.push_back({file.string("path"), file.string("sha256")});
    file.finish();
  }
  for (const Value& item : reader.required("training_records").items())
    from.training_records.push_back(item.as_string());
  reader.finish();
  return from;
}

void require_format(ObjectReader& reader) {
  const Value& format = reader.required("format");
  if (format.as_string() != kFormat)
    throw Error(format.where(), "is '" + format.as_string() + "', not a model file",
                "write " + std::string(kFormat));
  const Value& version = reader.required("version");
  if (version.as_number() != kVersion)
    throw Error(version.where(), "version " + format_number(version.as_number()) + " is not known here",
                "this Dashpot reads version " + std::to_string(kVersion));
}

void require_law(const LawModel& law, const ModelFile& file, const std::string& where) {
  if (law.drive_unit() != file.drive_unit)
    throw Error(where, "drive_unit is " + law.drive_unit() + ", but " + file.drive_unit + " for the file");
  require_bounds(law, file.domain.current_min, where);
  require_bounds(law, file.domain.current_max, where);
}

std::unique_ptr<DamperModel> read_law(const Value& value, const ModelFile& file) {
  auto model = law_model_from_json(value);
  require_law(*model, file, value.where());
  return model;
}

std::unique_ptr<DamperModel> read_hybrid(const Value& value, const ModelFile& file) {
  auto model = hybrid_model_from_json(value);
  require_law(model->law(), file, value.where());
  return model;
}

std::unique_ptr<DamperModel> read_model(const Value& kind, const Value& value, const ModelFile& file) {
  if (kind.as_string() == "law") return read_law(value, file);
  if (kind.as_string() == "network") return network_model_from_json(value);
  if (kind.as_string() == "state_network") return hysteresis_network_from_json(value);
  if (kind.as_string() == "fuzzy") return fuzzy_model_from_json(value);
  if (kind.as_string() == "hybrid") return read_hybrid(value, file);
  throw Error(kind.where(), "unknown kind '" + kind.as_string() + "'",
              suggest(kind.as_string(), {"law", "network", "state_network", "fuzzy", "hybrid"}));
}

}  // namespace

std::string format_model(const ModelFile& file) {
  Value document = Value::object({{"format", kFormat},
                                  {"version", kVersion},
                                  {"kind", file.model->kind()},
                                  {"drive_unit", file.drive_unit},
                                  {"sample_time", file.sample_time},
                                  {"domain", to_json(file.domain, file.drive_unit)},
                                  {"model", file.model->to_json()},
                                  {"quality", file.quality},
                                  {"provenance", to_json(file.provenance)}});
  if (file.interval) document.add("interval", to_json(*file.interval));
  return format_json(document);
}

ModelFile parse_model(std::string_view text, const std::string& source) {
  const Value document = parse_json(text, source);
  ObjectReader reader(document, "a model file");
  require_format(reader);
  ModelFile file;
  const Value& kind = reader.required("kind");
  file.drive_unit = reader.string("drive_unit");
  file.sample_time = reader.number("sample_time");
  if (!(file.sample_time >= 0))
    throw Error(reader.required("sample_time").where(), "is negative", "seconds, or 0 when it varied");
  file.domain = read_domain(reader.required("domain"), file.drive_unit);
  file.model = read_model(kind, reader.required("model"), file);
  if (const Value* quality = reader.optional("quality")) {
    ObjectReader(*quality, "the quality");  // any keys, but a mapping
    file.quality = *quality;
  }
  if (const Value* interval = reader.optional("interval")) file.interval = read_force_band(*interval);
  file.provenance = read_provenance(reader.required("provenance"));
  reader.finish();
  return file;
}

ModelFile load_model(const std::filesystem::path& path) {
  return parse_model(read_file(path), path.string());
}

void save_model(const ModelFile& file, const std::filesystem::path& path) {
  write_file(path, format_model(file));
}

}  // namespace dashpot
