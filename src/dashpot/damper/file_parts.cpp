#include "dashpot/damper/file_parts.h"

#include <array>
#include <utility>

#include "dashpot/base/any_number.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

/// One axis of the domain: its key, its unit and where its ends are kept.
struct Axis {
  std::string_view key;
  std::string unit;
  double Domain::* min;
  double Domain::* max;
};

std::vector<Axis> axes(DriveUnit drive_unit) {
  return {{"displacement", "m", &Domain::displacement_min, &Domain::displacement_max},
          {"velocity", "m/s", &Domain::velocity_min, &Domain::velocity_max},
          {"drive", to_string(drive_unit), &Domain::current_min, &Domain::current_max}};
}

/// The numbers of a verdict, in the order of the file.
constexpr std::array<std::pair<std::string_view, double Dissipation::*>, 7> kVerdict{
    {{"frequency_Hz", &Dissipation::frequency},
     {"amplitude_m", &Dissipation::amplitude},
     {"position_m", &Dissipation::position},
     {"drive", &Dissipation::drive},
     {"damping_N_s_per_m", &Dissipation::damping},
     {"active_from_Hz", &Dissipation::active_from},
     {"active_to_Hz", &Dissipation::active_to}}};

}  // namespace

DriveUnit read_drive_unit(ObjectReader& reader) {
  const Value& unit = reader.required("drive_unit");
  return parse_drive_unit(unit.as_string(), unit.where());
}

Value to_json(const Domain& domain, DriveUnit drive_unit) {
  Value out = Value::object();
  for (const Axis& axis : axes(drive_unit))
    out.add(
        std::string(axis.key),
        Value::object({{"min", domain.*axis.min}, {"max", domain.*axis.max}, {"unit", axis.unit}}));
  return out;
}

Domain read_domain(const Value& value, DriveUnit drive_unit) {
  Domain domain;
  ObjectReader reader(value, "the domain");
  for (const Axis& axis : axes(drive_unit)) {
    const Value& range = reader.required(axis.key);
    ObjectReader ends(range, "the domain of " + std::string(axis.key));
    domain.*axis.min = ends.number("min");
    domain.*axis.max = ends.number("max");
    const std::string unit = ends.string("unit");
    ends.finish();

    if (unit != axis.unit)
      throw Error(range.where(), "unit is '" + unit + "'", "write " + axis.unit);
    if (domain.*axis.min > domain.*axis.max) throw Error(range.where(), "min is above max");
  }
  reader.finish();
  return domain;
}

Value to_json(const Dissipation& result) {
  if (!result.is_tested) return {};
  Value out = Value::object(
      {{"dissipates", result.dissipates()}, {"least_share", any_number(result.share)}});
  for (const auto& [key, member] : kVerdict) out.add(std::string(key), result.*member);
  return out;
}

Dissipation read_dissipation(const Value& value) {
  ObjectReader reader(value, "the dissipation");
  Dissipation result{.is_tested = true};
  reader.optional("dissipates");  // follows from the share
  result.share = read_any_number(reader.required("least_share"));
  for (const auto& [key, member] : kVerdict) result.*member = reader.number(key);
  reader.finish();
  return result;
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

  // The files that the records came from, and the records themselves.
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

void require_format(ObjectReader& reader, const FileFormat& format) {
  const Value& name = reader.required("format");
  if (name.as_string() != format.name)
    throw Error(name.where(), "is '" + name.as_string() + "', not " + std::string(format.what),
                "write " + std::string(format.name));
  const Value& version = reader.required("version");
  if (version.as_number() != format.version)
    throw Error(version.where(),
                "version " + format_number(version.as_number()) + " is not known here",
                "this Dashpot reads version " + std::to_string(format.version));
}

}  // namespace dashpot
