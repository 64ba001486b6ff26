#include "dashpot/record/readers/tdms.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/tdms_scale.h"
#include "dashpot/record/readers/tdms_segments.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 20;
constexpr std::size_t kMostTableColumns = 64;

/// The bytes of a segment's raw data, one after the other.
class RawBytes {
 public:
  RawBytes(const ByteFile& file, std::uint64_t at, std::uint64_t size)
      : file_(file), at_(at), left_(size) {}

  /// The next bytes, valid until the next call; no more than are left, and than a piece holds.
  const char* take(std::size_t count) {
    if (count > piece_.size() - next_) refill(count);
    const char* from = piece_.data() + next_;
    next_ += count;
    return from;
  }
  void skip(std::uint64_t count) {
    const std::uint64_t here = std::min<std::uint64_t>(count, piece_.size() - next_);
    next_ += static_cast<std::size_t>(here);
    at_ += count - here, left_ -= count - here;
  }

 private:
  void refill(std::size_t count) {
    piece_.erase(0, next_);
    next_ = 0;
    const std::size_t had = piece_.size();
    const auto more = static_cast<std::size_t>(
        std::min<std::uint64_t>(std::max(kPieceBytes, count) - had, left_));
    piece_.resize(had + more);
    file_.read(at_, piece_.data() + had, more);
    at_ += more, left_ -= more;
    if (piece_.size() < count)
      throw Error(file_.path(), "is damaged: raw data that end too early",
                  "copy it again from its source");
  }

  const ByteFile& file_;
  std::uint64_t at_, left_;
  std::string piece_;
  std::size_t next_ = 0;
};

/// The raw values of a channel.
struct Column {
  std::vector<double> values;
  std::int64_t zero = 0;  ///< of times: the whole seconds that they are counted from
};

/// Gathers the values of all segments.
class Gatherer {
 public:
  explicit Gatherer(const ByteFile& file) : file_(file) {}

  void take(const TdmsSegment& segment, const std::vector<TdmsObject>& objects) {
    columns_.resize(objects.size());
    if (segment.objects.empty()) fail(segment, "raw data of no channel");
    const bool is_daqmx = objects[segment.objects.front()].is_daqmx;
    for (const std::size_t number : segment.objects)
      if (objects[number].is_daqmx != is_daqmx) fail(segment, "channels of two kinds");
    cut_ = cut_ || segment.unfinished;

    RawBytes raw(file_, segment.data_at, segment.data_bytes);
    if (is_daqmx)
      take_daqmx(segment, objects, raw);
    else if (segment.interleaved)
      take_interleaved(segment, objects, raw);
    else
      take_contiguous(segment, objects, raw);
  }

  std::vector<Column> columns_;  ///< by number of the object
  bool cut_ = false;             ///< the last segment was never closed

 private:
  /// Chunks, in each the values of one channel after the other.
  void take_contiguous(const TdmsSegment& segment, const std::vector<TdmsObject>& objects,
                       RawBytes& raw) {
    std::uint64_t chunk = 0;
    for (const std::size_t number : segment.objects) {
      if (objects[number].bytes > segment.data_bytes - std::min(chunk, segment.data_bytes) &&
          !segment.unfinished)
        fail(segment, "more values than bytes");
      chunk += objects[number].bytes;
      if (chunk > (std::uint64_t{1} << 60)) fail(segment, "values without end");
    }
    if (chunk == 0) fail(segment, "raw data of no values");

    // What has no values in a chunk would cost time in each.
    std::vector<std::size_t> filled = segment.objects;
    std::erase_if(filled, [&](std::size_t number) { return objects[number].bytes == 0; });
    for (std::uint64_t left = segment.data_bytes; left > 0;) {
      for (const std::size_t number : filled) {
        const TdmsObject& object = objects[number];
        const std::uint64_t bytes = std::min(object.bytes, left);
        if (bytes < object.bytes && !segment.unfinished)
          fail(segment, "a chunk that ends too early");
        left -= bytes;
        if (!object.unread.empty()) {
          raw.skip(bytes);
          continue;
        }
        const std::size_t size = size_of(object.type);
        for (std::uint64_t k = 0; k < bytes / size; ++k)
          append(number, object, raw.take(size), segment.big_endian);
        raw.skip(bytes % size);
      }
    }
  }

  /// Rows of one value of each channel.
  void take_interleaved(const TdmsSegment& segment, const std::vector<TdmsObject>& objects,
                        RawBytes& raw) {
    std::size_t row = 0;
    for (const std::size_t number : segment.objects) {
      if (size_of(objects[number].type) == 0) fail(segment, "texts between numbers");
      row += size_of(objects[number].type);
    }
    if (segment.data_bytes % row != 0 && !segment.unfinished)
      fail(segment, "a row that ends too early");

    for (std::uint64_t k = 0; k < segment.data_bytes / row; ++k) {
      const char* at = raw.take(row);
      for (const std::size_t number : segment.objects) {
        append(number, objects[number], at, segment.big_endian);
        at += size_of(objects[number].type);
      }
    }
  }

  /// Chunks, in each one buffer after the other; a buffer has rows of bytes.
  void take_daqmx(const TdmsSegment& segment, const std::vector<TdmsObject>& objects,
                  RawBytes& raw) {
    // Each buffer's rows and the channels in it.
    struct Buffer {
      std::uint64_t rows = 0, width = 0;
      std::vector<std::size_t> channels;
    };
    std::vector<Buffer> buffers(objects[segment.objects.front()].widths.size());
    for (const std::size_t number : segment.objects) {
      const TdmsObject& object = objects[number];
      if (object.widths != objects[segment.objects.front()].widths)
        fail(segment, "channels that do not agree on their buffers");
      if (object.buffer >= buffers.size()) fail(segment, "a buffer that is not there");
      Buffer& buffer = buffers[object.buffer];
      buffer.rows = std::max(buffer.rows, object.values);
      buffer.width = object.widths[object.buffer];
      if (object.unread.empty()) buffer.channels.push_back(number);
    }
    std::uint64_t chunk = 0;
    for (const Buffer& buffer : buffers) {
      if (buffer.width > kPieceBytes || buffer.rows > (std::uint64_t{1} << 40) ||
          buffer.channels.size() > 2 * buffer.width)
        fail(segment, "rows of " + std::to_string(buffer.width) + " bytes");
      chunk += buffer.rows * buffer.width;
      if (chunk > (std::uint64_t{1} << 62)) fail(segment, "values without end");
    }
    std::erase_if(buffers, [](const Buffer& b) { return b.rows * b.width == 0; });
    if (chunk == 0) fail(segment, "raw data of no values");

    for (std::uint64_t left = segment.data_bytes; left > 0;) {
      for (const Buffer& buffer : buffers) {
        const std::uint64_t bytes = std::min(buffer.rows * buffer.width, left);
        if (bytes < buffer.rows * buffer.width && !segment.unfinished)
          fail(segment, "a buffer that ends too early");
        left -= bytes;
        for (std::uint64_t k = 0; k < bytes / buffer.width; ++k) {
          const char* row = raw.take(buffer.width);
          for (const std::size_t number : buffer.channels)
            append(number, objects[number], row + objects[number].offset, segment.big_endian);
        }
        raw.skip(bytes % buffer.width);
      }
    }
  }

  void append(std::size_t number, const TdmsObject& object, const char* at, bool big_endian) {
    if (!object.unread.empty()) return;
    Column& column = columns_[number];
    if (object.type == TdmsType::Time && column.values.empty())
      column.zero = number_at<std::int64_t>(at + (big_endian ? 0 : 8), big_endian);
    column.values.push_back(tdms_number(object.type, at, big_endian, column.zero));
  }

  [[noreturn]] void fail(const TdmsSegment& segment, const std::string& what) const {
    throw Error(file_.path(),
                "is damaged: " + what + " in the segment whose data begin at byte " +
                    std::to_string(segment.data_at),
                "copy it again from its source");
  }

  const ByteFile& file_;
};

/// The names in a path "/'group'/'channel'", in which '' stands for '.
std::vector<std::string> names_in(const std::string& path) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < path.size(); ++k) {
    if (path[k] != '\'') continue;
    std::string name;
    for (++k; k < path.size(); ++k) {
      if (path[k] == '\'' && (k + 1 >= path.size() || path[k + 1] != '\'')) break;
      if (path[k] == '\'') ++k;
      name += path[k];
    }
    names.push_back(name);
  }
  return names;
}

std::string text_of(const TdmsProperties& properties, const std::string& name) {
  const auto found = properties.find(name);
  const auto* text = found == properties.end() ? nullptr : std::get_if<std::string>(&found->second);
  return text ? std::string(trim(*text)) : "";
}

double number_of(const TdmsProperties& properties, const std::string& name) {
  const auto found = properties.find(name);
  const auto* number = found == properties.end() ? nullptr : std::get_if<double>(&found->second);
  return number ? *number : 0;
}

/// A channel of a group, with its values.
struct Channel {
  std::string name;
  const TdmsObject* object;
  Column* column;
};

/// The length that most channels share; of two, the longer.
std::size_t common_length(const std::vector<Channel>& channels) {
  std::map<std::size_t, std::size_t> counts;
  for (const Channel& channel : channels) ++counts[channel.column->values.size()];
  std::size_t best = 0, most = 0;
  for (const auto& [length, count] : counts)
    if (length > 0 && count >= most) best = length, most = count;
  return best;
}

/// The raw values as they are meant, where they lie; what is not finite becomes NaN.
RawColumn finished_column(const Channel& channel, const TdmsScale& scale, std::size_t length) {
  RawColumn column;
  column.name = channel.name;
  column.unit = text_of(channel.object->properties, "unit_string");
  column.values = std::move(channel.column->values);
  column.values.resize(length);
  if (channel.object->type == TdmsType::Time) column.unit = "s";
  for (std::size_t k = 0; k < length; ++k) {
    double& value = column.values[k];
    value = scale(value);
    if (std::isfinite(value)) continue;
    if (!column.bad) column.bad = BadCell{k, std::isnan(value) ? "NaN" : "infinite"};
    value = std::numeric_limits<double>::quiet_NaN();
  }
  return column;
}

/// The step in s that a waveform states in its wf_increment; nothing where it states none, or one
/// of frequencies, which is noted.
std::optional<double> stated_step(const Channel& channel, std::vector<std::string>& notes) {
  const TdmsProperties& properties = channel.object->properties;
  const double step = number_of(properties, "wf_increment");
  if (!(step > 0) || !std::isfinite(step)) return std::nullopt;
  const std::string x_unit = text_of(properties, "wf_xunit_string");
  const auto unit = parse_unit(x_unit.empty() ? "s" : x_unit);
  if (unit && unit->dimension == Dimension{0, 0, 1, 0, 0}) return step * unit->factor;
  notes.push_back("channel '" + channel.name + "': its wf_increment is in " + x_unit +
                  ", and not taken as time base");
  return std::nullopt;
}

/// The step that most channels state, of two the shorter, which is the table's sample time; those
/// of another are passed over, since sample by sample they do not belong together. One of 1 s that
/// stands beside others is what is there when nobody set it.
void keep_one_time_base(RawTable& table, std::vector<Channel>& channels) {
  constexpr double kUnset = 1, kAlike = 1e-9;
  std::vector<std::optional<double>> steps;
  for (const Channel& channel : channels) steps.push_back(stated_step(channel, table.notes));
  if (std::ranges::any_of(steps, [&](const auto& step) { return step && *step != kUnset; }))
    std::ranges::replace(steps, std::optional<double>(kUnset), std::optional<double>());

  std::map<double, std::size_t> counts;
  for (const auto& step : steps)
    if (step) ++counts[*step];
  if (counts.empty()) return;
  const double common =
      std::ranges::max_element(counts, {}, [](const auto& count) { return count.second; })->first;
  table.sample_time = common;

  std::vector<Channel> kept;
  for (std::size_t k = 0; k < channels.size(); ++k) {
    if (!steps[k] || std::abs(*steps[k] / common - 1) <= kAlike)
      kept.push_back(channels[k]);
    else
      table.notes.push_back("channel '" + channels[k].name + "' passed over: its wf_increment is " +
                            format_number(*steps[k], 6) + " s, that of the recording " +
                            format_number(common, 6) + " s");
  }
  channels = std::move(kept);
}

/// Notes waveforms that do not begin together.
void note_beginnings(RawTable& table, const std::vector<Channel>& channels) {
  std::set<double> offsets, starts;
  for (const Channel& channel : channels) {
    const TdmsProperties& properties = channel.object->properties;
    if (!(number_of(properties, "wf_increment") > 0)) continue;
    offsets.insert(number_of(properties, "wf_start_offset"));
    starts.insert(number_of(properties, "wf_start_time"));
  }
  if (offsets.size() > 1 || starts.size() > 1)
    table.notes.push_back("its channels begin at different times (" +
                          std::string(offsets.size() > 1 ? "wf_start_offset" : "wf_start_time") +
                          "): sample by sample they may not belong together");
}

/// The table of one group; without columns when it has no numbers.
RawTable table_of_group(std::vector<Channel> channels, const TdmsProperties& group,
                        const TdmsProperties& root, const std::string& file, bool cut) {
  RawTable table;
  table.file = file;
  const auto pass_over = [&](const Channel& channel, const std::string& why) {
    table.notes.push_back("channel '" + channel.name + "' passed over: " + why);
  };

  // Channels of numbers; where the file was cut, those that lack their last values are as long.
  std::erase_if(channels, [&](const Channel& channel) {
    if (channel.object->unread.empty()) return channel.column->values.empty();
    pass_over(channel, channel.object->unread);
    return true;
  });
  keep_one_time_base(table, channels);
  std::size_t length = common_length(channels);
  if (cut)
    for (const Channel& channel : channels)
      length = std::min(length, channel.column->values.size());

  std::vector<Channel> used;
  for (const Channel& channel : channels) {
    const TdmsScale scale = TdmsScale::of({&channel.object->properties, &group, &root}, file);
    if (!scale.unread().empty()) {
      pass_over(channel, scale.unread());
    } else if (!cut && channel.column->values.size() != length) {
      pass_over(channel, std::to_string(channel.column->values.size()) +
                             " values, the recording has " + std::to_string(length));
    } else if (used.size() == kMostTableColumns) {
      pass_over(channel, "more than " + std::to_string(kMostTableColumns) + " are no recording");
    } else {
      if (channel.object->is_daqmx && scale.empty())
        table.notes.push_back("channel '" + channel.name +
                              "': counts of a converter as they are, since no scale is stated");
      table.columns.push_back(finished_column(channel, scale, length));
      used.push_back(channel);
    }
  }
  note_beginnings(table, used);
  return table;
}

}  // namespace

bool is_tdms(const fs::path&, std::string_view, std::string_view head) {
  return head.starts_with("TDSm");
}

std::vector<RawTable> read_tdms(const fs::path& path) {
  if (lower(path.extension().string()) == ".gz")
    throw Error(path.string(), "is a packed measurement", "unpack it with gunzip first");
  const ByteFile file(path);
  Gatherer gatherer(file);
  const std::vector<TdmsObject> objects =
      read_tdms_segments(file, [&](const TdmsSegment& segment, const std::vector<TdmsObject>& all) {
        gatherer.take(segment, all);
      });
  gatherer.columns_.resize(objects.size());

  // Groups with their channels, in the order of the file.
  struct Group {
    std::string name;
    TdmsProperties properties;
    std::vector<Channel> channels;
  };
  std::vector<Group> groups;
  TdmsProperties root;
  std::map<std::string, std::size_t> by_name;
  for (std::size_t k = 0; k < objects.size(); ++k) {
    const auto names = names_in(objects[k].path);
    if (names.empty()) {
      root = objects[k].properties;
      continue;
    }
    const auto [group, is_new] = by_name.try_emplace(names[0], groups.size());
    if (is_new) groups.push_back({names[0], {}, {}});
    if (names.size() == 1)
      groups[group->second].properties = objects[k].properties;
    else
      groups[group->second].channels.push_back({names[1], &objects[k], &gatherer.columns_[k]});
  }

  std::vector<RawTable> tables;
  std::vector<std::string> notes;
  for (Group& group : groups) {
    RawTable table = table_of_group(std::move(group.channels), group.properties, root,
                                    path.string(), gatherer.cut_);
    if (table.columns.empty() || table.rows() == 0) {
      notes.insert(notes.end(), table.notes.begin(), table.notes.end());
      continue;
    }
    table.part = "group '" + group.name + "'";
    table.part_name = group.name;
    table.part_index = tables.size();
    tables.push_back(std::move(table));
  }
  if (tables.empty())
    throw NoTable(path.string(), "no group of channels holds numbers",
                  "a recording has one channel per signal");
  if (tables.size() == 1) tables.front().part.clear();
  if (gatherer.cut_)
    notes.push_back("its writer never closed it: read as far as all channels go, " +
                    std::to_string(tables.front().rows()) + " samples");
  auto& first = tables.front().notes;
  first.insert(first.end(), notes.begin(), notes.end());
  return tables;
}

}  // namespace dashpot
