#include "dashpot/model_file.h"

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/file_parts.h"
#include "dashpot/damper/force_band.h"
#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/damper/kinds/fuzzy/fuzzy_model.h"
#include "dashpot/damper/kinds/hybrid/hybrid_model.h"
#include "dashpot/damper/kinds/hysteresis_network/hysteresis_network.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/narx/narx_model.h"
#include "dashpot/damper/kinds/network/network_model.h"
#include "dashpot/damper/kinds/state_space/state_space_model.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr FileFormat kFormat{"dashpot-model", "a model file", 1};

void require_law(const LawModel& law, const ModelFile& file, const std::string& where) {
  if (law.drive_unit() != file.drive_unit)
    throw Error(where, "drive_unit is " + to_string(law.drive_unit()) + ", but " +
                           to_string(file.drive_unit) + " for the file");
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

std::unique_ptr<DamperModel> read_model(const Value& kind, const Value& value,
                                        const ModelFile& file) {
  if (kind.as_string() == "law") return read_law(value, file);
  if (kind.as_string() == "network") return network_model_from_json(value);
  if (kind.as_string() == "narx") return narx_model_from_json(value);
  if (kind.as_string() == "state_network") return hysteresis_network_from_json(value);
  if (kind.as_string() == "state_space") return state_space_model_from_json(value);
  if (kind.as_string() == "fuzzy") return fuzzy_model_from_json(value);
  if (kind.as_string() == "family") return family_model_from_json(value);
  if (kind.as_string() == "hybrid") return read_hybrid(value, file);
  throw Error(kind.where(), "unknown kind '" + kind.as_string() + "'",
              suggest(kind.as_string(), {"law", "network", "narx", "state_network", "state_space",
                                         "fuzzy", "hybrid", "family"}));
}

}  // namespace

std::string format_model(const ModelFile& file) {
  Value document = Value::object({{"format", kFormat.name},
                                  {"version", kFormat.version},
                                  {"kind", file.model->kind()},
                                  {"drive_unit", to_string(file.drive_unit)},
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
  require_format(reader, kFormat);
  ModelFile file;
  const Value& kind = reader.required("kind");
  file.drive_unit = read_drive_unit(reader);
  file.sample_time = reader.number("sample_time");
  if (!(file.sample_time >= 0))
    throw Error(reader.required("sample_time").where(), "is negative",
                "seconds, or 0 when it varied");
  file.domain = read_domain(reader.required("domain"), file.drive_unit);
  file.model = read_model(kind, reader.required("model"), file);
  if (const Value* quality = reader.optional("quality")) {
    ObjectReader(*quality, "the quality");  // any keys, but a mapping
    file.quality = *quality;
  }
  if (const Value* interval = reader.optional("interval"))
    file.interval = read_force_band(*interval);
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
