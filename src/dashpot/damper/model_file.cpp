#include "dashpot/model_file.h"

#include "dashpot/base/file.h"
#include "dashpot/base/file_kind.h"
#include "dashpot/damper/file_parts.h"
#include "dashpot/damper/force_band.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/registry.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr FileFormat kFormat{"dashpot-model", "a model file", 1};

Value to_json(const std::vector<FoundNoise>& found) {
  Value list = Value::array();
  for (const FoundNoise& one : found)
    list.push_back(Value::object({{"channel", one.channel},
                                  {"unit", one.unit},
                                  {"deviation", one.deviation},
                                  {"zero", one.zero}}));
  return list;
}

std::vector<FoundNoise> read_noise_found(const Value& value) {
  std::vector<FoundNoise> found;
  for (const Value& item : value.items()) {
    ObjectReader reader(item, "a noise that was found");
    FoundNoise one{reader.string("channel"), reader.string("unit"), reader.number("deviation"),
                   reader.number("zero", 0)};
    reader.finish();
    if (!(one.deviation > 0)) throw Error(item.where(), "deviation is not above 0");
    if (!(one.zero >= 0)) throw Error(item.where(), "zero is below 0");
    found.push_back(std::move(one));
  }
  return found;
}

/// A law says its drive unit itself, and its parameters have bounds all over the file's domain.
void require_law(const LawModel& law, const ModelFile& file, const std::string& where) {
  if (law.drive_unit() != file.drive_unit)
    throw Error(where, "drive_unit is " + name_of(law.drive_unit()) + ", but " +
                           name_of(file.drive_unit) + " for the file");
  require_bounds(law, file.domain.current_min, where);
  require_bounds(law, file.domain.current_max, where);
}

}  // namespace

Dissipation dissipation_of(const ModelFile& file) {
  return file.dissipation ? *file.dissipation : dissipation(*file.model, file.domain);
}

std::string format_model(const ModelFile& file) {
  Value document = Value::object({{"format", kFormat.name},
                                  {"version", kFormat.version},
                                  {"kind", name_of(file.model->kind())},
                                  {"drive_unit", name_of(file.drive_unit)},
                                  {"sample_time", file.sample_time},
                                  {"domain", to_json(file.domain, file.drive_unit)},
                                  {"model", file.model->to_json()},
                                  {"quality", file.quality},
                                  {"provenance", to_json(file.provenance)}});
  if (file.moving_mass > 0) document.add("moving_mass_kg", file.moving_mass);
  if (file.interval) document.add("interval", to_json(*file.interval));
  if (file.dissipation) document.add("dissipation", to_json(*file.dissipation));
  if (!file.noise_found.empty()) document.add("noise_found", to_json(file.noise_found));
  return format_json(document);
}

ModelFile parse_model(std::string_view text, const std::string& source) {
  const Value document = parse_json_of(text, source, "a model file");
  ObjectReader reader(document, "a model file");
  require_format(reader, kFormat);

  // Read what the model is for.
  ModelFile file;
  const Value& kind = reader.required("kind");
  file.drive_unit = read_drive_unit(reader);
  file.sample_time = reader.number("sample_time");
  if (!(file.sample_time >= 0))
    throw Error(reader.required("sample_time").where(), "is negative",
                "seconds, or 0 when it varied");
  file.moving_mass = reader.number("moving_mass_kg", 0);
  if (!(file.moving_mass >= 0))
    throw Error(reader.required("moving_mass_kg").where(), "is negative", "kg, or 0");
  file.domain = read_domain(reader.required("domain"), file.drive_unit);

  // Read the model itself, which must serve that unit and domain.
  const Value& model = reader.required("model");
  file.model = read_model(parse_model_kind(kind.as_string(), kind.where()), model);
  if (const LawModel* law = file.model->law_inside()) require_law(*law, file, model.where());

  // Read what is said of it.
  if (const Value* quality = reader.optional("quality")) {
    ObjectReader(*quality, "the quality");  // any keys, but a mapping
    file.quality = *quality;
  }
  if (const Value* interval = reader.optional("interval"))
    file.interval = read_force_band(*interval);
  if (const Value* dissipation = reader.optional("dissipation"))
    file.dissipation = read_dissipation(*dissipation);
  if (const Value* found = reader.optional("noise_found"))
    file.noise_found = read_noise_found(*found);
  file.provenance = read_provenance(reader.required("provenance"));
  reader.finish();
  return file;
}

ModelFile load_model(const std::filesystem::path& path) {
  if (std::error_code none; std::filesystem::is_directory(path, none))
    throw Error(path.string(), "is a folder, not a file",
                "one of the model files in it, as 'dashpot identify' leaves them in its folder "
                "models");
  return parse_model(read_file(path), path.string());
}

void save_model(const ModelFile& file, const std::filesystem::path& path) {
  write_file(path, format_model(file));
}

}  // namespace dashpot
