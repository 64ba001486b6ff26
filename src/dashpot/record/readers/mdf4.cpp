#include "dashpot/record/readers/mdf4.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/record/channel_names.h"
#include "dashpot/record/readers/mdf4_blocks.h"
#include "dashpot/record/readers/mdf4_channel.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

constexpr std::uint64_t kIdentification = 64;       // bytes before the first block
constexpr std::size_t kMostGroupChannels = 64;      // more is a vehicle's bus, not a bench
constexpr std::uint32_t kLongestRecord = 16 << 20;  // bytes

/// A group of channels: records of one form, which become one table.
struct Group {
  std::string name;
  std::uint64_t record_id = 0, records = 0;
  std::uint32_t data_bytes = 0, invalid_bytes = 0;
  bool has_lengths = false;  ///< its records have a length each; they hold texts
  std::vector<Mdf4Channel> channels;
  std::vector<std::string> notes;
  RawTable table;

  std::size_t record_bytes() const { return data_bytes + invalid_bytes; }
};

/// The groups whose records lie in one stream of data.
struct DataGroup {
  std::uint64_t data_at = 0;
  unsigned id_bytes = 0;  ///< before each record
  std::vector<Group> groups;
};

bool is_recognised(const Mdf4Channel& channel, std::string_view wanted = {}) {
  const std::string found = recognise_channel(channel.name, channel.unit).channel;
  return wanted.empty() ? !found.empty() || channel.is_time : found == wanted;
}

/// What is read of a bus of hundreds of channels.
void keep_known_channels(Group& group) {
  const std::size_t all = group.channels.size();
  if (all <= kMostGroupChannels) return;
  std::erase_if(group.channels, [](const Mdf4Channel& c) { return !is_recognised(c); });
  if (group.channels.size() > kMostGroupChannels) group.channels.resize(kMostGroupChannels);
  group.notes.push_back("a group of " + std::to_string(all) + " channels: only those that are " +
                        "known by their names are read, " + std::to_string(group.channels.size()));
}

Group read_group(Mdf4Blocks& blocks, const Mdf4Block& block) {
  constexpr std::size_t kData = 32;
  const std::string data = blocks.data(block, kData);
  Group group;
  group.name = blocks.text(block.link(2));
  group.record_id = number_at<std::uint64_t>(data.data());
  group.records = number_at<std::uint64_t>(data.data() + 8);
  group.has_lengths = number_at<std::uint16_t>(data.data() + 16) & 1;
  group.data_bytes = number_at<std::uint32_t>(data.data() + 24);
  group.invalid_bytes = number_at<std::uint32_t>(data.data() + 28);
  if (group.has_lengths) return group;
  if (group.data_bytes > kLongestRecord || group.invalid_bytes > kLongestRecord)
    blocks.fail(block.at, "a record of " + std::to_string(group.data_bytes) + " bytes");

  // Its channels.
  for (std::uint64_t at = block.link(1); at != 0;) {
    const Mdf4Block next = blocks.block(at, "CN");
    Mdf4ChannelOrReason read = read_mdf4_channel(blocks, next, group.data_bytes);
    const auto invalid = read.channel.invalid_bit;
    if (invalid && *invalid / 8 >= group.invalid_bytes)
      blocks.fail(at, "an invalidation bit beyond the record,");
    if (!read.channel.texts.empty() && read.reason.empty())
      group.notes.push_back("channel '" + read.channel.name +
                            "': values that its conversion gives as texts are no numbers");
    if (read.reason.empty())
      group.channels.push_back(std::move(read.channel));
    else
      group.notes.push_back("channel '" + read.channel.name + "' passed over: " + read.reason);
    at = next.link(0);
  }
  keep_known_channels(group);
  return group;
}

std::vector<DataGroup> read_groups(Mdf4Blocks& blocks) {
  std::vector<DataGroup> all;
  const Mdf4Block head = blocks.block(kIdentification, "HD");
  for (std::uint64_t at = head.link(0); at != 0;) {
    const Mdf4Block block = blocks.block(at, "DG");
    DataGroup data;
    data.data_at = block.link(2);
    data.id_bytes = static_cast<unsigned char>(blocks.data(block, 8)[0]);
    if (data.id_bytes != 0 && data.id_bytes != 1 && data.id_bytes != 2 && data.id_bytes != 4 &&
        data.id_bytes != 8)
      blocks.fail(at, "a record number of " + std::to_string(data.id_bytes) + " bytes");
    for (std::uint64_t group = block.link(1); group != 0;) {
      const Mdf4Block next = blocks.block(group, "CG");
      data.groups.push_back(read_group(blocks, next));
      group = next.link(0);
    }
    all.push_back(std::move(data));
    at = block.link(0);
  }
  return all;
}

bool has_force(const Group& group) {
  return std::ranges::any_of(group.channels,
                             [](const Mdf4Channel& c) { return is_recognised(c, "force"); });
}

void note_passed_over(const Group& group, std::vector<std::string>& notes) {
  std::vector<std::string> names;
  for (const Mdf4Channel& channel : group.channels) names.push_back("'" + channel.name + "'");
  if (names.size() > 8) names.resize(8), names.push_back("...");
  notes.push_back(
      "a group on a time base of its own passed over, since another holds the "
      "force: " +
      join(names, ", "));
}

/// Leaves the channels of groups empty that are no recording: where some group holds a force, those
/// without one, but for those that have as many records as one with a force, whose times they may
/// share.
void choose_groups(std::vector<DataGroup>& all, std::vector<std::string>& notes) {
  std::set<std::uint64_t> lengths;  // of those with a force
  for (const DataGroup& data : all)
    for (const Group& group : data.groups)
      if (has_force(group)) lengths.insert(group.records);
  if (lengths.empty()) return;

  for (DataGroup& data : all)
    for (Group& group : data.groups) {
      const bool is_kept = has_force(group) || lengths.contains(group.records);
      if (group.channels.empty() || is_kept) continue;
      note_passed_over(group, notes);
      group.channels.clear();
    }
}

/// Whether two groups that were read have a time base, and one.
bool share_times(const Group& a, const Group& b) {
  const auto time_of = [](const Group& group) {
    const auto at = std::ranges::find(group.channels, true, &Mdf4Channel::is_time);
    return at == group.channels.end()
               ? nullptr
               : &group.table.columns[static_cast<std::size_t>(at - group.channels.begin())];
  };
  const RawColumn *first = time_of(a), *second = time_of(b);
  return first && second && first->unit == second->unit && first->values == second->values;
}

/// Moves the columns of groups without a force to the one with a force that has the same times, as
/// loggers write one group per channel. Where none has, or several have, they are passed over.
void join_groups(std::vector<DataGroup>& all, std::vector<std::string>& notes) {
  std::vector<Group*> with, without;
  for (DataGroup& data : all)
    for (Group& group : data.groups)
      if (!group.channels.empty()) (has_force(group) ? with : without).push_back(&group);
  if (with.empty()) return;

  // All are found before any column moves.
  std::vector<Group*> fits(without.size(), nullptr);
  for (std::size_t k = 0; k < without.size(); ++k) {
    std::size_t count = 0;
    for (Group* group : with)
      if (share_times(*without[k], *group)) fits[k] = group, ++count;
    if (count != 1) fits[k] = nullptr;
  }

  for (std::size_t k = 0; k < without.size(); ++k) {
    Group& from = *without[k];
    if (!fits[k]) {
      note_passed_over(from, notes);
    } else {
      RawTable& to = fits[k]->table;
      for (std::size_t c = 0; c < from.channels.size(); ++c)
        if (!from.channels[c].is_time) {
          to.notes.push_back("'" + from.channels[c].name +
                             "' is of a group of its own with the same times");
          to.columns.push_back(std::move(from.table.columns[c]));
        }
      to.notes.insert(to.notes.end(), from.notes.begin(), from.notes.end());
    }
    from.channels.clear();
  }
}

/// Columns of a group, with room for what it states as far as the file can hold it.
void begin_table(Group& group, const ByteFile& file, unsigned id_bytes) {
  const std::uint64_t bytes = std::max<std::uint64_t>(group.record_bytes() + id_bytes, 1);
  const auto rows = std::min<std::uint64_t>(group.records, most_unpacked(file.size()) / bytes);
  group.table.file = file.path();
  group.table.notes = group.notes;
  for (const Mdf4Channel& channel : group.channels) {
    const bool named_time = recognise_channel(channel.name, channel.unit).channel == "time";
    RawColumn column;
    column.name = channel.is_time && !named_time ? "time" : channel.name;
    column.unit = channel.unit;
    column.values.reserve(rows);
    group.table.columns.push_back(std::move(column));
  }
}

/// Appends one record to the columns of its group.
void append_record(Group& group, const char* record) {
  const std::uint64_t row = group.table.rows();
  for (std::size_t k = 0; k < group.channels.size(); ++k) {
    const Mdf4Channel& channel = group.channels[k];
    RawColumn& column = group.table.columns[k];
    double value = channel.value(record, row);
    const bool invalid =
        channel.invalid_bit &&
        (record[group.data_bytes + *channel.invalid_bit / 8] >> (*channel.invalid_bit % 8)) & 1;
    if (invalid || !std::isfinite(value)) {
      if (!column.bad)
        column.bad = BadCell{row, invalid             ? "marked invalid"
                                  : std::isnan(value) ? "NaN"
                                                      : "infinite"};
      value = std::numeric_limits<double>::quiet_NaN();
    }
    column.values.push_back(value);
  }
}

/// Cuts the stream of a data group into records: a number of the group, where there are several,
/// then the record.
class RecordCutter {
 public:
  RecordCutter(DataGroup& data, Mdf4Blocks& blocks) : data_(data), blocks_(blocks) {
    for (Group& group : data.groups) by_id_[group.record_id] = &group;
  }

  void take(std::string_view piece) {
    // The beginning of a record that the last piece ended with, and what is whole of this one.
    if (!rest_.empty()) {
      rest_ += piece;
      const std::size_t used = cut(rest_);
      rest_.erase(0, used);
    } else {
      rest_ = piece.substr(cut(piece));
    }
  }
  /// Bytes that are no whole record.
  std::size_t left() const { return rest_.size(); }

 private:
  /// Takes whole records off the front; returns how many bytes they were.
  std::size_t cut(std::string_view bytes) {
    // Records that are all alike are counted at once, others one by one.
    const Group& first = data_.groups.front();
    const bool alike = data_.id_bytes == 0 && !first.has_lengths;
    if (alike)
      blocks_.count_values(data_.data_at,
                           bytes.size() / first.record_bytes() * first.channels.size());

    std::size_t at = 0;
    for (;;) {
      const std::string_view rest = bytes.substr(at);
      if (rest.size() < data_.id_bytes || rest.empty()) return at;
      Group& group = group_of(rest);
      std::size_t size = group.record_bytes();
      std::size_t begin = data_.id_bytes;
      if (group.has_lengths) {
        if (rest.size() < begin + 4) return at;
        size = number_at<std::uint32_t>(rest.data() + begin), begin += 4;
        if (size > kLongestRecord) blocks_.fail(data_.data_at, "a text without end in the data");
      }
      if (rest.size() < begin + size) return at;
      if (!alike) blocks_.count_values(data_.data_at, group.channels.size());
      if (!group.channels.empty()) append_record(group, rest.data() + begin);
      at += begin + size;
    }
  }

  Group& group_of(std::string_view rest) {
    if (data_.id_bytes == 0) return data_.groups.front();
    std::uint64_t id = 0;
    for (unsigned k = data_.id_bytes; k-- > 0;)
      id = (id << 8) | static_cast<unsigned char>(rest[k]);
    const auto found = by_id_.find(id);
    if (found == by_id_.end())
      blocks_.fail(data_.data_at, "a record of a group that is not there, in the data");
    return *found->second;
  }

  DataGroup& data_;
  Mdf4Blocks& blocks_;
  std::map<std::uint64_t, Group*> by_id_;
  std::string rest_;
};

void read_data(Mdf4Blocks& blocks, DataGroup& data) {
  const bool wanted =
      std::ranges::any_of(data.groups, [](const Group& g) { return !g.channels.empty(); });
  if (!wanted) return;
  if (data.id_bytes == 0 && (data.groups.size() != 1 || data.groups.front().record_bytes() == 0))
    blocks.fail(data.data_at, "records that nothing tells apart, in the data");

  for (Group& group : data.groups) begin_table(group, blocks.file(), data.id_bytes);
  RecordCutter cutter(data, blocks);
  blocks.stream(data.data_at, [&](std::string_view piece) { cutter.take(piece); });

  // What is stated and what is there.
  for (Group& group : data.groups)
    if (!group.channels.empty() && group.table.rows() != group.records)
      throw Error(blocks.file().path(),
                  "is cut off or was not finished: it states " + std::to_string(group.records) +
                      " samples and holds " + std::to_string(group.table.rows()),
                  "copy it again from its source, or have it finished by the program that wrote "
                  "it");
  if (cutter.left() != 0) blocks.fail(data.data_at, "a record that is cut off, in the data");
}

void require_readable(const ByteFile& file) {
  const std::string head = file.bytes(0, kIdentification);
  const auto version = number_at<std::uint16_t>(head.data() + 28);
  if (head.starts_with("UnFinMF"))
    throw Error(file.path(), "is a measurement that was not finished",
                "open it with the program that wrote it, and save it");
  if (version < 400 || version >= 500)
    throw Error(file.path(), "is MDF of version " + format_number(version / 100.0),
                "save it as MDF 4, which is read");
}

}  // namespace

bool is_mdf4(const fs::path&, std::string_view, std::string_view head) {
  return head.starts_with("MDF     ") || head.starts_with("UnFinMF ");
}

std::vector<RawTable> read_mdf4(const fs::path& path) {
  if (lower(path.extension().string()) == ".gz")
    throw Error(path.string(), "is a packed measurement", "unpack it with gunzip first");
  Mdf4Blocks blocks(path);
  require_readable(blocks.file());
  std::vector<DataGroup> all = read_groups(blocks);
  std::vector<std::string> notes;
  choose_groups(all, notes);

  // A table of each group that is left.
  std::vector<RawTable> tables;
  for (DataGroup& data : all) read_data(blocks, data);
  join_groups(all, notes);
  for (DataGroup& data : all)
    for (Group& group : data.groups)
      if (!group.channels.empty() && group.table.rows() > 0) {
        group.table.part_index = tables.size();
        if (!group.name.empty()) group.table.part = "group '" + group.name + "'";
        group.table.part_name = group.name;
        tables.push_back(std::move(group.table));
      }
  if (tables.empty())
    throw NoTable(path.string(), "no group of channels holds numbers",
                  "a recording has one channel per signal and a time base");
  if (tables.size() == 1) tables.front().part.clear();
  tables.front().notes.insert(tables.front().notes.end(), notes.begin(), notes.end());
  return tables;
}

}  // namespace dashpot
