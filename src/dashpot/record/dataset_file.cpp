#include "dashpot/record/dataset_file.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/data_folder.h"
#include "dashpot/base/file.h"
#include "dashpot/base/file_kind.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/error.h"
#include "dashpot/record/channel_names.h"
#include "dashpot/value.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

double finite_number(const Value& value, std::string_view what) {
  const double number = value.as_number();
  if (!std::isfinite(number))
    throw Error(value.where(), std::string(what) + " is not a finite number");
  return number;
}

std::optional<double> optional_number(ObjectReader& reader, std::string_view key) {
  const Value* value = reader.optional(key);
  if (!value) return std::nullopt;
  return finite_number(*value, "'" + std::string(key) + "'");
}

std::optional<double> positive_number(ObjectReader& reader, std::string_view key) {
  const auto number = optional_number(reader, key);
  if (number && !(*number > 0))
    throw Error(reader.required(key).where(), "'" + std::string(key) + "' must be positive");
  return number;
}

/// One text or a list of texts, as a list.
std::vector<std::string> texts(const Value& value) {
  if (value.kind() != Value::Kind::Array) return {value.as_string()};
  std::vector<std::string> out;
  for (const Value& item : value.items()) out.push_back(item.as_string());
  return out;
}

void read_column(const Value& value, ChannelStatement& statement) {
  if (value.kind() != Value::Kind::Number) {
    statement.column = value.as_string();
    return;
  }
  const double number = value.as_number();
  if (number < 1 || number > 10000 || number != std::floor(number))
    throw Error(value.where(), "column " + format_number(number) + " does not exist",
                "a name, or a number from 1");
  statement.index = static_cast<std::size_t>(number);
}

void require_unit_of(const ChannelStatement& statement, const std::string& where) {
  const Unit unit = require_unit(statement.unit, where);
  const std::string_view si = si_unit(statement.channel);
  if (!si.empty() && parse_unit(si)->dimension != unit.dimension)
    throw Error(where, "unit '" + statement.unit + "' does not fit " + statement.channel,
                "a unit that converts to " + std::string(si));
}

/// Reads one entry of 'channels': a column's name or number, or an object that states more.
ChannelStatement read_channel(const std::string& channel, const Value& value) {
  ChannelStatement statement;
  statement.channel = channel;
  statement.where = value.where();

  if (value.kind() != Value::Kind::Object) {
    read_column(value, statement);
    return statement;
  }

  // Column and unit, which must fit the channel.
  ObjectReader reader(value, "a channel");
  read_column(reader.required("column"), statement);
  statement.unit = reader.string("unit", "");
  if (!statement.unit.empty()) require_unit_of(statement, reader.required("unit").where());

  // The numbers of sample = sign * scale * (raw - offset): finite, and the scale not 0.
  statement.scale = reader.number("scale", 1);
  statement.offset = reader.number("offset", 0);
  statement.sign = reader.number("sign", 1);
  if (std::abs(statement.sign) != 1)
    throw Error(reader.required("sign").where(), "'sign' is neither 1 nor -1");
  if (!std::isfinite(statement.scale) || statement.scale == 0 || !std::isfinite(statement.offset))
    throw Error(statement.where, "'scale' or 'offset' is not a usable number");

  const std::string centre = reader.string("centre", "");
  if (!centre.empty() && centre != "mean" && centre != "none")
    throw Error(reader.required("centre").where(), "'centre' is '" + centre + "'",
                "it can be 'mean' or 'none'");
  statement.centre = centre == "mean";
  statement.placed = !centre.empty() || reader.optional("offset") != nullptr;
  statement.directed = reader.optional("sign") != nullptr;

  // The inertia of what moves between the load cell and the damper is no part of its force.
  statement.moving_mass = reader.number("moving_mass", 0);
  if (statement.moving_mass != 0 && statement.channel != "force")
    throw Error(reader.required("moving_mass").where(),
                "'moving_mass' is stated of " + statement.channel, "it belongs to force");
  if (!(statement.moving_mass >= 0 && std::isfinite(statement.moving_mass)))
    throw Error(reader.required("moving_mass").where(),
                "'moving_mass' is " + format_number(statement.moving_mass) + " kg",
                "0 or more: what moves between load cell and damper");

  // What the displacement may take off a velocity.
  const std::string noise = reader.string("noise", "");
  if (!noise.empty() && (noise != "keep" || statement.channel != "velocity"))
    throw Error(reader.required("noise").where(),
                "'noise' of " + statement.channel + " is '" + noise + "'",
                "it can be 'keep', of velocity");
  statement.keeps_noise = noise == "keep";
  reader.finish();
  return statement;
}

/// Reads 'time': one of a sample rate, a sample time or a column.
void read_time(const Value& value, FileStatement& out) {
  ObjectReader reader(value, "a time base");
  const Value* column = reader.optional("column");
  const auto rate = positive_number(reader, "sample_rate");
  out.sample_time = positive_number(reader, "sample_time");
  if ((column != nullptr) + rate.has_value() + out.sample_time.has_value() != 1)
    throw Error(value.where(),
                "a time base is stated by one of 'column', 'sample_rate' (Hz), 'sample_time' (s)");

  if (rate) out.sample_time = 1 / *rate;
  if (column) {
    ChannelStatement statement;
    statement.channel = "time";
    statement.where = value.where();
    read_column(*column, statement);
    statement.unit = reader.string("unit", "");
    if (!statement.unit.empty()) require_unit_of(statement, reader.required("unit").where());
    out.channels.push_back(std::move(statement));
  }

  reader.finish();
}

void read_cut(const Value& value, FileStatement& out) {
  ObjectReader reader(value, "a cut");
  out.cut_from = optional_number(reader, "from");
  out.cut_to = optional_number(reader, "to");
  out.cut_rest = reader.boolean("rest", false);
  reader.finish();
}

LevelStatement read_level(const Value& value) {
  if (value.kind() == Value::Kind::Number) return finite_number(value, "the drive level");
  if (value.kind() == Value::Kind::Array) {
    std::vector<double> levels;
    for (const Value& item : value.items()) levels.push_back(finite_number(item, "a drive level"));
    return levels;
  }
  ObjectReader reader(value, "a drive level");
  LevelStatement level = reader.string("manifest");
  reader.finish();
  return level;
}

/// "1.0 mm", "25 degC" or a plain number in SI.
double read_condition(const Value& value) {
  if (value.kind() == Value::Kind::Number) return finite_number(value, "the condition");
  const std::string& text = value.as_string();
  const std::size_t space = text.find(' ');
  const auto number = parse_number(text.substr(0, space));
  if (!number || space == std::string::npos)
    throw Error(value.where(), "'" + text + "' is not a number with a unit",
                "as '25 degC' or '1 mm'");
  const Unit unit = require_unit(trim(std::string_view(text).substr(space)), value.where());
  return unit.factor * *number + unit.offset;
}

/// A condition in a column of the manifest: {manifest: gap}, {manifest: gap, unit: mm}.
ManifestCondition read_manifest_condition(const std::string& name, const Value& value) {
  ObjectReader reader(value, "a condition");
  ManifestCondition condition{name, reader.string("manifest"), reader.string("unit", ""),
                              value.where()};
  if (!condition.unit.empty()) require_unit(condition.unit, reader.required("unit").where());
  reader.finish();
  return condition;
}

DrawingStatement read_drawing(const Value& value) {
  if (value.kind() != Value::Kind::Object) return {value.as_string(), "", value.where()};
  ObjectReader reader(value, "a drawing");
  DrawingStatement drawing{"", reader.string("manifest"), value.where()};
  reader.finish();
  return drawing;
}

RoleStatement read_role(const Value& value) {
  ObjectReader reader(value, "a role");
  RoleStatement role;
  const std::string name = reader.string("role");
  if (name != "training" && name != "left_out")
    throw Error(reader.required("role").where(), "role '" + name + "' is unknown",
                "'training' or 'left_out'");
  role.role = name == "training" ? Role::Training : Role::LeftOut;
  role.from = optional_number(reader, "from");
  role.to = optional_number(reader, "to");
  role.score_from = optional_number(reader, "score_from");
  reader.finish();
  return role;
}

std::vector<RoleStatement> read_roles(const Value& value) {
  std::vector<RoleStatement> roles;
  for (const Value& item : value.items()) roles.push_back(read_role(item));
  return roles;
}

/// Reads one entry of 'files'. Stating channels means that only these columns are used.
FileStatement read_files(const Value& value) {
  ObjectReader reader(value, "an entry of 'files'");
  FileStatement out;
  out.where = value.where();
  out.match = texts(reader.required("match"));
  out.states_nothing = value.members().size() == 1;

  // Time and channels.
  if (const Value* time = reader.optional("time")) read_time(*time, out);
  if (const Value* channels = reader.optional("channels")) {
    for (const auto& [channel, statement] : channels->members())
      out.channels.push_back(read_channel(channel, statement));
    out.only_stated = true;
  }

  // Rows that hold no numbers, cuts and filters of the samples.
  const std::string bad_row = reader.string("on_bad_row", "error");
  if (bad_row != "error" && bad_row != "drop")
    throw Error(reader.required("on_bad_row").where(), "'on_bad_row' is '" + bad_row + "'",
                "it can be 'error' or 'drop'");
  out.drop_bad_rows = bad_row == "drop";
  if (const Value* cut = reader.optional("cut")) read_cut(*cut, out);
  out.resample_hz = positive_number(reader, "resample");
  out.velocity_cutoff_hz = positive_number(reader, "velocity_cutoff").value_or(0);

  // Name, condition, drive level and roles of the records.
  out.name = reader.string("name", "");
  out.condition = reader.string("condition", "");
  if (const Value* level = reader.optional("level")) out.level = read_level(*level);
  if (const Value* conditions = reader.optional("conditions")) {
    for (const auto& [name, condition] : conditions->members()) {
      if (condition.kind() == Value::Kind::Object)
        out.manifest_conditions.push_back(read_manifest_condition(name, condition));
      else
        out.conditions.emplace_back(name, read_condition(condition));
    }
  }
  if (const Value* drawing = reader.optional("damper")) out.drawing = read_drawing(*drawing);
  if (const Value* roles = reader.optional("roles")) out.roles = read_roles(*roles);
  reader.finish();
  return out;
}

void read_recognise(const Value& value, DatasetFile& out) {
  ObjectReader reader(value, "a recognised file");
  out.recognise_file = reader.string("file");
  out.recognise_sha256 = lower(reader.string("sha256"));
  reader.finish();
}

}  // namespace

DatasetFile load_dataset_file(const fs::path& path) {
  const Value value = parse_yaml(read_file(path), path.string());
  refuse_other_kind(value, "a dataset file");
  ObjectReader reader(value, "a dataset file");
  DatasetFile out;

  out.path = path.string();
  out.name = reader.string("name", path.stem().string());
  out.citation = reader.string("citation", "");
  out.root = path.parent_path() / reader.string("root", ".");
  if (const Value* drive = reader.optional("drive"); drive && !drive->as_string().empty())
    out.drive_unit = parse_drive_unit(drive->as_string(), drive->where());
  out.manifest = reader.string("manifest", "");

  // The default way to leave records out: its errors get the place in this file.
  if (const Value* leave_out = reader.optional("leave_out")) {
    try {
      out.leave_out = parse_leave_out(leave_out->as_string());
    } catch (const Error& error) {
      throw Error(leave_out->where(), error.what());
    }
  }

  if (const Value* recognise = reader.optional("recognise")) read_recognise(*recognise, out);
  for (const Value& files : reader.required("files").items())
    out.files.push_back(read_files(files));

  // Roles are themselves a way to leave out: where no other is stated it is theirs.
  const bool roles = std::any_of(out.files.begin(), out.files.end(), [](const FileStatement& f) {
    return std::any_of(f.roles.begin(), f.roles.end(),
                       [](const RoleStatement& r) { return r.role == Role::LeftOut; });
  });
  if (roles && !out.leave_out) out.leave_out = LeaveOut{.by = LeaveOut::By::Roles, .values = {}};
  if (const Value* notes = reader.optional("notes")) out.notes = texts(*notes);
  reader.finish();
  return out;
}

std::vector<fs::path> shipped_dataset_files() {
  std::vector<fs::path> files;
  for (const std::string& name : data_names("datasets", ".yaml"))
    files.push_back(data_folder("datasets") / (name + ".yaml"));
  return files;
}

}  // namespace dashpot
