#include "recordings.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "dashpot/base/units.h"
#include "dashpot/record/channel_names.h"
#include "dashpot/record/conditions.h"
#include "dashpot/record/doubts.h"
#include "dashpot/record/drive_levels.h"
#include "dashpot/record/stretches.h"
#include "dashpot/value.h"
#include "handles.h"
#include "status.h"
#include "words.h"

using namespace dashpot;
using namespace dashpot::capi;

namespace {

constexpr const char* kStatedIn = "the arrays";

RawColumn copy_column(const dashpot_named_column& named, std::size_t samples) {
  require(named.name, "a column's name");
  require(named.column.data, named.name);
  RawColumn column{.name = named.name, .unit = {}, .values = {}, .bad = {}};
  column.values.reserve(samples);
  for (std::size_t k = 0; k < samples; ++k) {
    const double value = named.column.data[static_cast<std::ptrdiff_t>(k) * named.column.stride];
    column.values.push_back(value);
    if (!column.bad && !std::isfinite(value))
      column.bad = BadCell{k, std::isnan(value) ? "nan" : "inf"};
  }
  return column;
}

/// The force is stated, so that its sign stays.
FileStatement statement_of(const RawTable& raw, const char* conditions) {
  FileStatement statement;
  statement.where = raw.file;
  statement.conditions = read_conditions(conditions);
  for (std::size_t k = 0; k < raw.columns.size(); ++k) {
    if (recognise_channel(raw.columns[k].name, "").channel != "force") continue;
    statement.channels.push_back({.channel = "force", .index = k + 1, .where = raw.file});
    break;
  }
  return statement;
}

void add(dashpot_recordings& recordings, const dashpot_table& table) {
  std::vector<Record>& records = recordings.dataset.records;

  // Reports and left-out folds know a recording by its name.
  const std::string name =
      table.name ? table.name : "recording " + std::to_string(records.size() + 1);
  if (std::ranges::find(records, name, &Record::name) != records.end())
    throw Error(name, "is there already", "a name of its own for every recording");

  // The arrays are read as a file is, the force's sign stated beforehand: a gap in time ends one
  // record and begins the next.
  RawTable raw = copy_table(table, name);
  const FileStatement statement = statement_of(raw, table.conditions);
  std::vector<RawTable> stretches = usable_stretches(std::move(raw), statement, kStatedIn);
  std::vector<BuildContext> contexts(stretches.size(), {.statement = &statement,
                                                        .stated_in = kStatedIn,
                                                        .name = name,
                                                        .level = {},
                                                        .as_given = true});
  if (stretches.size() > 1)
    for (std::size_t k = 0; k < contexts.size(); ++k)
      contexts[k].name += ", stretch " + std::to_string(k + 1);
  std::vector<BuiltRecord> all = build_records(std::move(stretches), contexts);
  if (!all.front().refusal.empty()) throw Error(name, all.front().refusal);

  // One model has one drive: all recordings are driven in the same unit.
  // Without current and voltage it is taken as of one constant, unknown drive.
  const DriveUnit drive_unit = all.front().record.find("current")   ? DriveUnit::Ampere
                               : all.front().record.find("voltage") ? DriveUnit::Volt
                                                                    : DriveUnit::None;
  const DriveUnit before = recordings.dataset.drive_unit;
  const auto words = [](DriveUnit unit) {
    return unit == DriveUnit::None ? "no current or voltage" : "a drive in " + to_string(unit);
  };
  if (!records.empty() && drive_unit != before)
    throw Error(name, "has " + words(drive_unit), "the recordings before it have " + words(before));
  recordings.dataset.drive_unit = drive_unit;

  // Only a recording that was accepted is kept; on an error nothing is added.
  for (BuiltRecord& built : all) {
    if (drive_unit == DriveUnit::None) built.record.drive_level = 0;
    recordings.name_rests.push_back(split_name(name).rest);
    std::ranges::move(built.readings, std::back_inserter(recordings.dataset.readings));
    for (std::string& why : doubts_about(built.record))
      recordings.dataset.suspects.push_back({built.record.name, std::move(why)});
    records.push_back(std::move(built.record));
  }
}

const Record& record_at(const dashpot_recordings* recordings, std::size_t place) {
  require(recordings, "recordings");
  const std::vector<Record>& records = recordings->dataset.records;
  if (place >= records.size())
    throw Error("record", "is " + std::to_string(place),
                "there are " + std::to_string(records.size()));
  return records[place];
}

}  // namespace

namespace dashpot::capi {

RawTable copy_table(const dashpot_table& table, const std::string& name) {
  RawTable raw;
  raw.file = name;
  for (std::size_t k = 0; k < table.column_count; ++k)
    raw.columns.push_back(copy_column(table.columns[k], table.samples));
  if (table.sample_time == 0) return raw;
  if (!(table.sample_time > 0) || !std::isfinite(table.sample_time))
    throw Error("sample_time", "is not a number of s above 0");
  raw.sample_time = table.sample_time;
  return raw;
}

Dataset usable_dataset(const dashpot_recordings* recordings) {
  require(recordings, "recordings");
  Dataset dataset = recordings->dataset;
  if (dataset.records.empty()) throw Error("recordings", "there are none", "add one at least");
  if (!recordings->takes_arrays) return dataset;
  find_drive_levels(dataset.records);
  infer_conditions(dataset.records, recordings->name_rests);
  return dataset;
}

}  // namespace dashpot::capi

dashpot_status dashpot_recordings_load(const char* const* paths, size_t count, const char* options,
                                       dashpot_recordings** recordings) {
  return guarded([&] {
    require(recordings, "recordings");
    *recordings = nullptr;
    require(paths, "paths");
    std::vector<std::filesystem::path> all;
    for (std::size_t k = 0; k < count; ++k) {
      require(paths[k], "a path");
      all.emplace_back(paths[k]);
    }
    if (all.empty()) throw Error("paths", "there are none", "a file or folder at least");
    *recordings = new dashpot_recordings{load_dataset(all, read_load_options(options))};
  });
}

dashpot_status dashpot_recordings_new(dashpot_recordings** recordings) {
  return guarded([&] {
    require(recordings, "recordings");
    *recordings = nullptr;
    *recordings = new dashpot_recordings{.dataset = {}, .takes_arrays = true};
    (*recordings)->dataset.name = "recordings in memory";
  });
}

dashpot_status dashpot_recordings_add(dashpot_recordings* recordings, const dashpot_table* table) {
  return guarded([&] {
    require(recordings, "recordings");
    require(table, "table");
    require(table->columns, "columns");
    if (!recordings->takes_arrays)
      throw Error("recordings", "were not made empty",
                  "dashpot_recordings_new makes those that arrays can be added to");
    add(*recordings, *table);
  });
}

size_t dashpot_recordings_count(const dashpot_recordings* recordings) {
  return recordings ? recordings->dataset.records.size() : 0;
}

dashpot_status dashpot_recordings_describe(const dashpot_recordings* recordings, char** text) {
  return guarded([&] {
    require(text, "text");
    *text = nullptr;
    *text = copy_text(describe(usable_dataset(recordings)));
  });
}

dashpot_status dashpot_recordings_unread(const dashpot_recordings* recordings, char** json) {
  return guarded([&] {
    require(json, "json");
    *json = nullptr;
    require(recordings, "recordings");
    Value files = Value::array();
    for (const PassedOver& file : recordings->dataset.unread)
      files.push_back(Value::object({{"file", file.file}, {"why", file.why}}));
    *json = copy_text(format_json(files, false));
  });
}

dashpot_status dashpot_recordings_suspects(const dashpot_recordings* recordings, char** json) {
  return guarded([&] {
    require(json, "json");
    *json = nullptr;
    require(recordings, "recordings");
    Value suspects = Value::array();
    for (const Suspect& suspect : recordings->dataset.suspects)
      suspects.push_back(Value::object({{"record", suspect.record}, {"why", suspect.why}}));
    *json = copy_text(format_json(suspects, false));
  });
}

dashpot_status dashpot_recordings_get_info(const dashpot_recordings* recordings, size_t record,
                                           dashpot_record_info* info) {
  return guarded([&] {
    require(info, "info");
    const Record& found = record_at(recordings, record);
    *info = {.name = found.name.c_str(),
             .condition = found.condition.c_str(),
             .time = found.time.data(),
             .samples = found.size(),
             .channel_count = found.channels.size(),
             .sample_time = found.sample_time};
  });
}

dashpot_status dashpot_recordings_channel(const dashpot_recordings* recordings, size_t record,
                                          size_t channel, dashpot_channel* view) {
  return guarded([&] {
    require(view, "view");
    const Record& found = record_at(recordings, record);
    if (channel >= found.channels.size())
      throw Error("channel", "is " + std::to_string(channel),
                  found.name + " has " + std::to_string(found.channels.size()));
    const Channel& of = found.channels[channel];
    *view = {of.name.c_str(), of.unit.c_str(), of.samples.data()};
  });
}

void dashpot_recordings_free(dashpot_recordings** recordings) { give_back(recordings); }

dashpot_status dashpot_understand_column(const char* name, dashpot_column_meaning* meaning) {
  return guarded([&] {
    require(meaning, "meaning");
    *meaning = {{}, 1, 0};
    require(name, "name");
    const NamedChannel named = recognise_channel(name, "");
    if (!named.problem.empty()) throw Error(name, "has " + named.problem);
    std::strncpy(meaning->channel, named.channel.c_str(), sizeof meaning->channel - 1);
    if (named.unit.empty()) return;
    const Unit unit = require_unit(named.unit, name);
    meaning->factor = unit.factor;
    meaning->shift = unit.offset;
  });
}
