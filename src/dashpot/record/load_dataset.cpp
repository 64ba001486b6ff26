#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include <fmt/format.h>

#include "dashpot/base/file.h"
#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/dataset.h"
#include "dashpot/error.h"
#include "dashpot/record/build_record.h"
#include "dashpot/record/conditions.h"
#include "dashpot/record/dataset_file.h"
#include "dashpot/record/doubts.h"
#include "dashpot/record/drive_levels.h"
#include "dashpot/record/late_motion.h"
#include "dashpot/record/readers/reader.h"
#include "dashpot/record/repeats.h"
#include "dashpot/record/source_files.h"
#include "dashpot/record/sources.h"
#include "dashpot/record/stated_conditions.h"
#include "dashpot/record/stretches.h"
#include "dashpot/record/unit_doubts.h"
#include "dashpot/record/what_varies.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

/// "{cmd_amp_mm} mm" with the words in braces replaced.
std::string fill_template(const std::string& text, const std::map<std::string, std::string>& words,
                          const std::string& where) {
  std::string out;
  for (std::size_t k = 0; k < text.size();) {
    const std::size_t open = text.find('{', k), close = text.find('}', open);
    out += text.substr(k, open - k);
    if (open == std::string::npos) break;

    const std::string word =
        text.substr(open + 1, close == std::string::npos ? close : close - open - 1);

    const auto at = words.find(word);
    std::vector<std::string> known;
    for (const auto& entry : words) known.push_back(entry.first);
    if (close == std::string::npos || at == words.end())
      throw Error(where, "'{" + word + "}' in '" + text + "' is unknown", suggest(word, known));

    out += at->second;
    k = close + 1;
  }
  return out;
}

/// The name of the folder that was pointed at, or that holds the file which was.
std::string pointed_folder(const SourcePath& file) {
  fs::path folder = fs::absolute(file.path).lexically_normal().parent_path();
  const fs::path below = fs::path(file.relative).parent_path();
  for (auto part = below.begin(); part != below.end(); ++part) folder = folder.parent_path();
  return folder.filename().string();
}

/// Where a level stands in a list of them: the parts of a file, or the stretches of one with gaps.
struct Listed {
  std::size_t place = 0;
  std::optional<std::size_t> stretches;  ///< how many there are, where the list counts these
};

/// The file that a record is of, and what is stated about it.
struct Origin {
  const SourcePath* file = nullptr;
  const FileStatement* statement = nullptr;
};

/// Loads file after file into one dataset.
class Loader {
 public:
  explicit Loader(const LoadOptions& options) : options_(options) {}

  /// In the order of the files; what needs all records at once comes after the last.
  Dataset load(std::vector<Sources> all) {
    for (const Sources& sources : all) file_count_ += sources.files.size();
    std::size_t done = 0;
    for (Sources& sources : all) {
      enter(std::move(sources));
      for (const SourcePath& file : sources_.files) {
        options_.monitor.report("read " + file.relative,
                                static_cast<double>(done++) / static_cast<double>(file_count_));
        load_file(file);
      }
      leave();
    }

    if (dataset_.records.empty()) refuse_nothing();
    infer_conditions(dataset_.records, name_rests_);
    sort_by_level();
    make_names_unique();
    settle_drive();
    note_drives();
    note_suspects();
    note_unread();
    if (!centred_.empty()) note_centres();
    note_displacements();
    return std::move(dataset_);
  }

 private:
  /// Goes on to the next folder: its files, and what is stated about them.
  void enter(Sources sources) {
    const bool first = sources_.files.empty() && sources_.pointed_at.empty();
    sources_ = std::move(sources);
    manifest_ = find_manifest(sources_);
    refuse_ambiguous_names();
    const DatasetFile& stated = sources_.stated;
    stated_in_ = stated.path.empty() ? "" : fs::path(stated.path).filename().string();

    dataset_.name += (first ? "" : " + ") + stated.name;
    if (!dataset_.citation.empty() && !stated.citation.empty()) dataset_.citation += "; ";
    dataset_.citation += stated.citation;
    dataset_.notes.insert(dataset_.notes.end(), stated.notes.begin(), stated.notes.end());
    conditions_ = StatedConditions(manifest_, fs::path(stated.path).parent_path());
    dataset_.notes.insert(dataset_.notes.end(), conditions_.notes().begin(),
                          conditions_.notes().end());

    note_manifest();

    // What holds for all records together may be stated once.
    if (drive_unit_ && stated.drive_unit && *drive_unit_ != *stated.drive_unit)
      throw Error(stated.path, "'drive' differs from that of the folders before",
                  "records that are judged together have one kind of drive");
    if (!drive_unit_) drive_unit_ = stated.drive_unit;
    const bool differs =
        dataset_.leave_out && stated.leave_out &&
        format_leave_out(*dataset_.leave_out) != format_leave_out(*stated.leave_out);
    if (differs)
      dataset_.notes.push_back("'leave_out: " + format_leave_out(*stated.leave_out) + "' of " +
                               stated.path + " is not used: the folder before states '" +
                               format_leave_out(*dataset_.leave_out) + "'");
    if (!dataset_.leave_out) dataset_.leave_out = stated.leave_out;
  }

  /// What a manifest states in vain: files that are not there, and columns that nothing uses.
  void note_manifest() {
    const bool is_folder = std::ranges::none_of(sources_.files, &SourcePath::named);
    if (manifest_.empty() || !is_folder) return;
    const std::string name = fs::path(manifest_.path()).filename().string();
    constexpr std::size_t kShown = 3;
    if (std::vector<std::string> missing = manifest_.missing_files(sources_.files);
        !missing.empty()) {
      const std::size_t more = missing.size() - std::min(missing.size(), kShown);
      missing.resize(missing.size() - more);
      dataset_.notes.push_back(name + " names files that are not there: " + join(missing, ", ") +
                               (more > 0 ? " and " + std::to_string(more) + " more" : ""));
    }

    // A dataset file may use columns in many ways; without one there are few.
    if (!stated_in_.empty()) return;
    const auto level = manifest_.level_column();
    std::vector<std::string> unused;
    for (const std::string& column : manifest_.columns())
      if (column != "file" && !(level && level->first == column) && !conditions_.knows(column))
        unused.push_back("'" + column + "'");
    if (!unused.empty())
      dataset_.notes.push_back(name + ": not used without a dataset file: " + join(unused, ", "));
  }

  /// What needs all records of the folder: levels that only samples tell, then what depends on
  /// them.
  void leave() {
    const std::span<Record> records = std::span(dataset_.records).last(origins_.size());
    find_drive_levels(records);
    for (std::size_t k = 0; k < records.size(); ++k)
      conditions_.add(records[k], *origins_[k].file, *origins_[k].statement);
    origins_.clear();
  }

  /// A bare name of the manifest may not stand for two files.
  void refuse_ambiguous_names() const {
    std::map<std::size_t, const SourcePath*> seen;
    for (const SourcePath& file : sources_.files) {
      const auto row = manifest_.row_of(file);
      if (!row) continue;
      const auto [at, is_new] = seen.emplace(*row, &file);
      if (!is_new)
        throw Error(manifest_.path(),
                    "one row may be " + at->second->relative + " or " + file.relative,
                    "write the path in the column 'file', as " + file.relative);
    }
  }

  /// Reads one file. One of a folder that cannot be used is remembered with its error and leaves
  /// nothing behind; a file that was named, or a statement that is wrong, stops everything.
  void load_file(const SourcePath& file) {
    const std::size_t records = dataset_.records.size(), readings = dataset_.readings.size(),
                      centred = centred_.size(), drives = drive_notes_.size(),
                      origins = origins_.size(), passed_over = dataset_.passed_over.size();
    try {
      load_sound_file(file);
    } catch (const Error& error) {
      // What is stated wrongly is no fault of the file.
      const std::string why = error.what();
      const bool of_statement =
          (!sources_.stated.path.empty() && why.starts_with(sources_.stated.path + ":")) ||
          (!manifest_.empty() && why.starts_with(manifest_.path()));
      if (file.named || of_statement) throw;

      // As if it had not been begun.
      dataset_.records.resize(records);
      origins_.resize(origins);
      name_rests_.resize(records);
      dataset_.readings.resize(readings);
      centred_.resize(centred);
      drive_notes_.resize(drives);
      dataset_.passed_over.resize(passed_over);
      dataset_.unread.push_back({file.relative, why});
    }
  }

  /// Reads one file into records, or passes it over with a reason. A file that the caller named
  /// itself may not be passed over: pass_over() throws for it.
  void load_sound_file(const SourcePath& file) {
    const FileStatement* statement = statement_for(sources_.stated, file);
    // Files beside the recordings that are none.
    const bool is_manifest = !manifest_.empty() && fs::equivalent(file.path, manifest_.path());
    if (is_manifest) return dataset_.notes.push_back(file.relative + ": the manifest");
    if (is_dataset_file(file.path)) return;
    if (!fs::is_regular_file(file.path))
      return pass_over(file, "is not a regular file; save what it gives as a file first");

    // Recordings that the dataset file or the manifest leaves out, and files of another format in a
    // folder.
    if (!statement) return pass_over(file, "no 'match' in " + stated_in_ + " fits it");
    const bool stated = !stated_in_.empty() && !statement->states_nothing;
    if (!stated && !file.named && !manifest_.empty() && !manifest_.lists(file))
      return pass_over(file, "not in manifest.csv");
    if (!stated && !file.named && fs::file_size(file.path) > 0 && !find_reader(file.path))
      return pass_over(file, "not a recording by its format");

    std::vector<RawTable> tables;
    try {
      tables = read_tables(file.path);
    } catch (const NoTable&) {
      if (file.named || stated) throw;
      return pass_over(file, "it holds no table of numbers");
    }

    // The checksum of a large file is taken beside the rest of the work.
    constexpr std::uintmax_t kLarge = std::uintmax_t{1} << 24;  // bytes
    const std::size_t parts = tables.size();
    std::vector<PassedOver> refused;
    std::string checksum;
    parallel_for(2, fs::file_size(file.path) < kLarge ? 1 : 0, [&](std::size_t k) {
      if (k == 0)
        refused = load_parts(file, *statement, std::move(tables));
      else
        checksum = sha256_of_file(file.path);
    });

    const bool used = refused.size() < parts;
    if (!used && !refused.empty() && (file.named || stated))
      throw Error(file.path.string() + refused.front().file, refused.front().why);
    for (const auto& [part, why] : refused)
      dataset_.passed_over.push_back({file.relative + part, why});
    if (used) dataset_.files.push_back({file.path.string(), checksum});
  }

  /// Of several parts of a file (sheets, groups) those that are no recordings are passed over:
  /// returns them.
  std::vector<PassedOver> load_parts(const SourcePath& file, const FileStatement& statement,
                                     std::vector<RawTable> tables) {
    const std::size_t parts = tables.size();
    std::vector<PassedOver> refused;
    for (RawTable& table : tables) {
      const std::string part = part_text(table, parts);
      std::string why = load_stretches(
          file, statement, usable_stretches(std::move(table), statement, stated_in_), parts);
      if (!why.empty()) refused.push_back({part, std::move(why)});
    }
    return refused;
  }

  /// What tells a part of a file from the others, behind the file's name: ", sheet 'notes'".
  static std::string part_text(const RawTable& table, std::size_t parts) {
    if (parts == 1) return {};
    return ", " +
           (table.part.empty() ? "part " + std::to_string(table.part_index + 1) : table.part);
  }

  /// Makes a record of each stretch of one table, which is one in a table whose time has no gap.
  /// Returns why the table is no recording; "" where it is one.
  std::string load_stretches(const SourcePath& file, const FileStatement& statement,
                             std::vector<RawTable> stretches, std::size_t parts) {
    const bool is_split = stretches.size() > 1;
    const std::string stem = without_gz(fs::path(file.relative)).replace_extension().string();
    const RawTable& first = stretches.front();
    const bool has_name = parts > 1 && !first.part_name.empty();
    const NameParts name = has_name ? split_part_name(stem, first.part_name) : split_name(stem);

    // Of each: the drive level as the statement, the manifest or the name has it, and the record's
    // name. Levels that are listed count the stretches where the file has no other parts.
    const std::string part = std::to_string(first.part_index + 1), group = first.group;
    const std::string part_name = has_name ? first.part_name : "part " + part;
    std::vector<BuildContext> contexts;
    std::vector<std::string> conditions;
    for (std::size_t k = 0; k < stretches.size(); ++k) {
      const Listed listed = is_split && parts == 1 ? Listed{k, stretches.size()}
                                                   : Listed{first.part_index, std::nullopt};
      BuildContext context{&statement, stated_in_,
                           !group.empty() ? first.part
                           : parts > 1    ? stem + ", " + part_name
                                          : stem,
                           known_level(file, statement, listed, name, first),
                           options_.velocity_cutoff_hz};
      const auto words = template_words(file, stem, part, group, context.level);
      if (!statement.name.empty())
        context.name = fill_template(statement.name, words, statement.where);
      if (is_split) context.name += ", stretch " + std::to_string(k + 1);
      conditions.push_back(fill_template(statement.condition, words, statement.where));
      contexts.push_back(std::move(context));
    }

    std::vector<BuiltRecord> all = build_records(std::move(stretches), contexts);
    if (!all.front().refusal.empty()) return std::move(all.front().refusal);

    for (std::size_t k = 0; k < all.size(); ++k) {
      BuiltRecord& built = all[k];
      if (built.centred) centred_.push_back(*built.centred);
      if (!built.drive_note.empty())
        drive_notes_.push_back(file.relative + ": " + built.drive_note);
      built.record.condition = conditions[k].empty() ? group : conditions[k];
      dataset_.readings.insert(dataset_.readings.end(), built.readings.begin(),
                               built.readings.end());
      add_records(std::move(built.record), {&file, &statement}, name.rest, is_split);
    }
    return {};
  }

  /// One record, or one per role that the statement gives to a part of it. A stretch of a recording
  /// with gaps has the roles that reach it.
  void add_records(Record record, const Origin& origin, const std::string& rest, bool is_stretch) {
    const FileStatement& statement = *origin.statement;
    const auto at_time = [&](const std::optional<double>& t, std::size_t otherwise) {
      if (!t) return otherwise;
      return static_cast<std::size_t>(std::lower_bound(record.time.begin(), record.time.end(), *t) -
                                      record.time.begin());
    };

    if (statement.roles.empty()) {
      add_record(std::move(record), origin, rest);
      return;
    }

    // Each role cuts its own part; what lies before `score_from` is simulated, not scored.
    for (const RoleStatement& role : statement.roles) {
      const std::size_t first = at_time(role.from, 0), last = at_time(role.to, record.size());
      const std::size_t scored = std::max(first, at_time(role.score_from, first));
      if (last < scored + 2 && is_stretch) continue;
      if (last < scored + 2)
        throw Error(statement.where, "a role leaves nothing of " + record.name,
                    "the record runs to " + format_number(record.time.back()) + " s");

      Record part = record.slice(first, last);
      part.warm_up = scored - first;
      part.role = role.role;
      if (statement.roles.size() > 1)
        part.name += role.role == Role::Training ? ", training" : ", left out";
      if (part.warm_up > 0)
        part.notes.push_back("scored from " + format_number(part.time[part.warm_up], 6) + " s");
      add_record(std::move(part), origin, rest);
    }
  }

  void add_record(Record record, const Origin& origin, const std::string& rest) {
    dataset_.records.push_back(std::move(record));
    name_rests_.push_back(rest);
    origins_.push_back(origin);
  }

  /// The words that templates of names and conditions may use, the manifest's columns among them.
  std::map<std::string, std::string> template_words(const SourcePath& file, const std::string& stem,
                                                    const std::string& part,
                                                    const std::string& group,
                                                    const std::optional<KnownLevel>& level) const {
    std::map<std::string, std::string> words{{"stem", fs::path(stem).filename().string()},
                                             {"folder", fs::path(stem).parent_path().string()},
                                             {"part", part},
                                             {"group", group},
                                             {"level", level ? format_number(level->value) : ""}};
    for (const std::string& column : manifest_.columns())
      if (const auto cell = manifest_.cell(file, column)) words[column] = *cell;
    return words;
  }

  /// The drive level from beside the columns, the surest source first: the statement, the manifest,
  /// a single number of the file, its name. A stated drive column makes all of them silent but the
  /// first.
  std::optional<KnownLevel> known_level(const SourcePath& file, const FileStatement& statement,
                                        const Listed& listed, const NameParts& name,
                                        const RawTable& table) const {
    const DriveUnit unit = sources_.stated.drive_unit.value_or(DriveUnit::Ampere);
    if (const auto* level = std::get_if<double>(&statement.level))
      return KnownLevel{*level, unit, stated_in_};
    if (const auto* column = std::get_if<std::string>(&statement.level))
      return KnownLevel{manifest_.level(file, *column), unit, "manifest, " + *column};
    if (const auto* levels = std::get_if<std::vector<double>>(&statement.level)) {
      if (levels->size() == 1 && listed.stretches)
        return KnownLevel{levels->front(), unit, stated_in_};
      if (listed.stretches && *listed.stretches != levels->size())
        throw Error(statement.where,
                    "'level' lists " + std::to_string(levels->size()) +
                        " levels, and gaps in the "
                        "time of " +
                        file.relative + " leave " + std::to_string(*listed.stretches) +
                        " stretches",
                    "one level for all, or one per stretch as 'dashpot inspect' lists them");
      if (listed.place < levels->size())
        return KnownLevel{(*levels)[listed.place], unit, stated_in_};
      throw Error(statement.where,
                  "'level' lists " + std::to_string(levels->size()) + " parts, " + file.relative +
                      " has more",
                  "one level per part");
    }

    const bool drive_stated = std::any_of(
        statement.channels.begin(), statement.channels.end(),
        [](const ChannelStatement& c) { return c.channel == "current" || c.channel == "voltage"; });
    if (drive_stated) return std::nullopt;
    if (const auto column = manifest_.level_column(); column && manifest_.lists(file))
      return KnownLevel{manifest_.level(file, column->first), column->second,
                        "manifest.csv, " + column->first};

    if (std::optional<KnownLevel> level = level_of_scalars(table)) {
      if (level->doubt.empty() && name.level && name.level->value != level->value)
        level->note = "the " + level->basis + " counts, " + format_number(level->value) + " " +
                      to_string(level->unit) + ", not the " + name.level->basis;
      return level;
    }

    // The names: the file's and those of its folders, then that of the folder that was pointed at.
    std::optional<KnownLevel> level = name.level;
    if (!level) level = level_of_folder(pointed_folder(file));
    if (level && sources_.stated.drive_unit == DriveUnit::None) level->doubt.clear();
    return level;
  }

  void pass_over(const SourcePath& file, const std::string& why) {
    if (file.named) throw Error(file.path.string(), why);
    dataset_.passed_over.push_back({file.relative, why});
  }

  [[noreturn]] void refuse_nothing() const {
    const std::string where = sources_.files.empty()
                                  ? sources_.pointed_at
                                  : sources_.files.front().path.parent_path().string();

    std::string what = sources_.files.empty()
                           ? "the folder holds no files"
                           : "no recording among " + counted(file_count_, "file");
    // The reasons, the errors first.
    constexpr std::size_t kReasons = 3;
    std::vector<std::string> reasons;
    for (const PassedOver& file : dataset_.unread) reasons.push_back(file.why);
    for (const PassedOver& file : dataset_.passed_over)
      reasons.push_back(file.file + ": " + file.why);
    for (std::size_t k = 0; k < std::min(reasons.size(), kReasons); ++k)
      what += "\n  " + reasons[k];
    if (reasons.size() > kReasons)
      what += "\n  and " + std::to_string(reasons.size() - kReasons) + " more";

    throw Error(where, what,
                "Dashpot looks for " + known_formats() +
                    (stated_in_.empty() ? ""
                                        : "; " + stated_in_ +
                                              " says which files: give the folder that holds them, "
                                              "or state 'root:' in it"));
  }

  /// Within a condition by drive level; conditions stay in the order of their files.
  void sort_by_level() {
    std::map<std::string, std::size_t> order;
    for (const Record& record : dataset_.records) order.emplace(record.condition, order.size());
    std::stable_sort(dataset_.records.begin(), dataset_.records.end(),
                     [&](const Record& a, const Record& b) {
                       return std::pair(order[a.condition], a.drive_level) <
                              std::pair(order[b.condition], b.drive_level);
                     });
  }

  void make_names_unique() {
    std::map<std::string, int> seen;
    for (Record& record : dataset_.records)
      if (const int times = ++seen[record.name]; times > 1)
        record.name += " (" + std::to_string(times) + ")";
  }

  /// The unit of the drive, which all records of a dataset share: stated, else that of most
  /// records, current where both are as many, and none where no record tells its drive.
  void settle_drive() {
    std::size_t current = 0, voltage = 0;
    for (const Record& record : dataset_.records) {
      current += record.find("current") != nullptr;
      voltage += record.find("voltage") != nullptr;
    }
    const DriveUnit told = current == 0 && voltage == 0 ? DriveUnit::None
                           : current >= voltage         ? DriveUnit::Ampere
                                                        : DriveUnit::Volt;
    dataset_.drive_unit = drive_unit_.value_or(told);
    if (dataset_.drive_unit == DriveUnit::None) return take_as_one_drive(current + voltage > 0);

    const std::size_t count = dataset_.records.size();
    const std::size_t driven = dataset_.drive_unit == DriveUnit::Ampere ? current : voltage;
    if (driven < count)
      dataset_.notes.push_back(
          std::to_string(count - driven) + " of " + std::to_string(count) +
          " records have no known current or voltage: give it as a column, in the file "
          "name (run_0.5A.csv), in manifest.csv or in a dataset file");
  }

  /// Nothing tells the drive, or the dataset file says that nothing counts as it: all records are
  /// at one level without a unit.
  void take_as_one_drive(bool had_one) {
    for (Record& record : dataset_.records) {
      record.drive_level = 0;
      std::erase_if(record.channels,
                    [](const Channel& c) { return c.name == "current" || c.name == "voltage"; });
    }
    if (!had_one) note_unlike_fields();
    dataset_.notes.push_back(
        had_one ? "'drive: none' in " + stated_in_ +
                      ": currents and voltages are not used, the drive is taken as one constant"
                : std::string(
                      "no drive channel: taken as one constant, unknown drive, as of a passive "
                      "damper; if the current differs between records, give it in the file names "
                      "(run_0.5A.csv), in manifest.csv or in a dataset file") +
                      level_in_names() + unused_columns());
  }

  /// "; 'I=0.5' in the names tells one only with its unit"; "" where no name has such a word.
  std::string level_in_names() const {
    for (const Record& record : dataset_.records)
      if (const std::string word = level_without_unit(record.name); !word.empty()) {
        const std::string unit =
            std::string_view("UVv").find(word.front()) != std::string::npos ? "V" : "A";
        return "; '" + word + "' in the name of " + record.name +
               " is taken as one only with its unit, '" + word + unit + "' or '" + word + "m" +
               unit + "'";
      }
    return {};
  }

  /// "; if it is in a column that is not used ('I set [A]'), state that there"; "" where all are.
  std::string unused_columns() const {
    constexpr std::size_t kShown = 4;
    std::vector<std::string> unused;
    for (const ColumnReading& reading : dataset_.readings)
      if (reading.channel.empty()) add_new(unused, "'" + reading.column + "'");
    if (unused.empty()) return {};
    const bool are_many = unused.size() > kShown;
    if (are_many) unused.resize(kShown);
    return "; if it is a column that is not used (" + join(unused, ", ") +
           (are_many ? " ..." : "") + "), state that there";
  }

  /// Yield stresses that differ while all else that is stated of a damper does not are levels of a
  /// field that nobody named: they are no one drive.
  void note_unlike_fields() {
    std::map<std::vector<std::pair<std::string, double>>, std::vector<double>> fields;
    for (const Record& record : dataset_.records) {
      auto damper = record.conditions;
      std::erase_if(damper, [](const auto& named) { return named.first == "yield_stress"; });
      for (const auto& [name, value] : record.conditions)
        if (name == "yield_stress") add_new(fields[damper], value);
    }
    const auto most = std::ranges::max_element(
        fields, {}, [](const auto& damper) { return damper.second.size(); });
    if (most == fields.end() || most->second.size() < 2) return;
    const auto [least, greatest] = std::ranges::minmax(most->second);
    drive_notes_.push_back(fmt::format(
        "one damper was recorded at {} fields, its yield stress is {} ... {} Pa, but no "
        "current is stated: only models of a family tell them apart, all else takes "
        "the records as of one drive; give the currents as 'level: [0, 0.5, ...]' in a "
        "dataset file",
        most->second.size(), format_number(least), format_number(greatest)));
  }

  /// How drives were read where names and columns left a choice: first among the notes, since a
  /// wrong current is the costliest mistake.
  void note_drives() {
    constexpr std::size_t kShown = 2;
    std::vector<std::string> shown(
        drive_notes_.begin(),
        drive_notes_.begin() + static_cast<std::ptrdiff_t>(std::min(kShown, drive_notes_.size())));
    if (drive_notes_.size() > kShown)
      shown.back() += "; likewise " + std::to_string(drive_notes_.size() - kShown) +
                      " more ('dashpot inspect' lists them)";
    dataset_.notes.insert(dataset_.notes.begin(), shown.begin(), shown.end());
  }

  /// Which records look damaged, and how.
  void note_suspects() {
    for (const Record& record : dataset_.records)
      for (const std::string& why : doubts_about(record))
        dataset_.suspects.push_back({record.name, why});
    if (auto currents = doubt_about_currents(dataset_.records))
      dataset_.suspects.push_back(std::move(*currents));
    for (Suspect& repeat : doubts_about_repeats(dataset_.records))
      dataset_.suspects.push_back(std::move(repeat));
    if (auto timing = doubt_about_timing(dataset_.records))
      dataset_.suspects.push_back(std::move(*timing));

    constexpr std::size_t kShown = 2;
    std::vector<std::string> notes;
    for (const auto& [record, why] : dataset_.suspects)
      if (notes.size() < kShown) notes.push_back(std::string(kSuspectNote) + record + ": " + why);
    if (dataset_.suspects.size() > kShown)
      notes.back() += "; " + std::to_string(dataset_.suspects.size() - kShown) +
                      " more doubts ('dashpot inspect' lists them)";
    dataset_.notes.insert(dataset_.notes.begin(), notes.begin(), notes.end());
  }

  /// Which files could not be used, and why, before all other notes.
  void note_unread() {
    constexpr std::size_t kShown = 3;
    std::vector<std::string> notes;
    for (const PassedOver& file : dataset_.unread)
      if (notes.size() < kShown) notes.push_back("not read: " + file.why);
    if (dataset_.unread.size() > kShown)
      notes.push_back("not read: " + std::to_string(dataset_.unread.size() - kShown) +
                      " more files, " + std::to_string(dataset_.unread.size()) + " of " +
                      std::to_string(file_count_) + " in all");
    dataset_.notes.insert(dataset_.notes.begin(), notes.begin(), notes.end());
  }

  /// By how much absolute strokes were centred. Different centres lose where the records lie to
  /// each other.
  void note_centres() {
    constexpr double kMillimetres = 1e3, kSame = 1;  // mm
    const auto [low, high] = std::ranges::minmax(centred_);
    const std::string least = format_number(kMillimetres * low, 4),
                      most = format_number(kMillimetres * high, 4);
    const bool alike = kMillimetres * (high - low) <= kSame;
    dataset_.notes.push_back(
        "absolute stroke centred in " + std::to_string(centred_.size()) + " of " +
        std::to_string(dataset_.records.size()) + " records, by " +
        (alike ? least + " mm"
               : least + " ... " + most +
                     " mm, each by its own mean; where the force depends on the place, state one "
                     "'offset' for all of them in a dataset file"));
  }

  /// How many records have a displacement that nobody measured, and how many have none.
  void note_displacements() {
    std::size_t integrated = 0, missing = 0;
    for (const Record& record : dataset_.records) {
      const Channel* displacement = record.find("displacement");
      missing += displacement == nullptr;
      integrated += displacement && displacement->origin.starts_with("integrated");
    }
    const std::string all = " of " + std::to_string(dataset_.records.size()) + " records";
    if (integrated > 0)
      dataset_.notes.push_back("displacement integrated from velocity in " +
                               std::to_string(integrated) + all +
                               ", drift removed; 'dashpot inspect' says how much");
    if (missing > 0)
      dataset_.notes.push_back(std::to_string(missing) + all +
                               " have no displacement, and none could be integrated from the "
                               "velocity; 'dashpot inspect' says why");
  }

  const LoadOptions& options_;
  Sources sources_;  ///< of the folder that is being read
  Manifest manifest_;
  StatedConditions conditions_;
  std::string stated_in_;
  Dataset dataset_;
  std::size_t file_count_ = 0;           ///< of all folders
  std::optional<DriveUnit> drive_unit_;  ///< as stated by any folder
  std::vector<double> centred_;          ///< m, by which absolute strokes were moved
  std::vector<std::string> drive_notes_;
  std::vector<std::string> name_rests_;  ///< of each record: its name without the drive level
  std::vector<Origin> origins_;          ///< of each record of the folder that is being read
};

}  // namespace

Dataset load_dataset(const std::vector<fs::path>& paths, const LoadOptions& options) {
  return Loader(options).load(find_all_sources(paths, options));
}

}  // namespace dashpot
