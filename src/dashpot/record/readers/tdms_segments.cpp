#include "dashpot/record/readers/tdms_segments.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr std::size_t kLead = 28;  // bytes
constexpr std::size_t kMostObjects = 2000, kMostMetadata = std::size_t{64} << 20;
constexpr std::uint64_t kNotClosed = ~std::uint64_t{0};

/// Bits of a segment's table of contents.
enum : std::uint32_t {
  kMetadata = 1 << 1,
  kNewList = 1 << 2,
  kRawData = 1 << 3,
  kInterleaved = 1 << 5,
  kBigEndian = 1 << 6
};
/// What stands in place of the length of an object's index.
enum : std::uint32_t {
  kNoData = 0xFFFFFFFF,
  kAsBefore = 0,
  kFormatChanging = 0x1269,
  kDigitalLine = 0x1369
};

struct TypeRow {
  std::uint32_t code;
  TdmsType type;
  std::size_t size;
};
constexpr std::array<TypeRow, 18> kTypes{{{1, TdmsType::I8, 1},
                                          {2, TdmsType::I16, 2},
                                          {3, TdmsType::I32, 4},
                                          {4, TdmsType::I64, 8},
                                          {5, TdmsType::U8, 1},
                                          {6, TdmsType::U16, 2},
                                          {7, TdmsType::U32, 4},
                                          {8, TdmsType::U64, 8},
                                          {9, TdmsType::F32, 4},
                                          {10, TdmsType::F64, 8},
                                          {0x19, TdmsType::F32, 4},
                                          {0x1A, TdmsType::F64, 8},
                                          {0x20, TdmsType::Text, 0},
                                          {0x21, TdmsType::U8, 1},
                                          {0x44, TdmsType::Time, 16},
                                          {0x08000c, TdmsType::Other, 8},
                                          {0x10000d, TdmsType::Other, 16},
                                          {0, TdmsType::Other, 0}}};
/// DAQmx numbers its types in a way of its own.
constexpr std::array<TdmsType, 10> kDaqmxTypes{
    TdmsType::U8,  TdmsType::I8,  TdmsType::U16, TdmsType::I16, TdmsType::U32,
    TdmsType::I32, TdmsType::U64, TdmsType::I64, TdmsType::F32, TdmsType::F64};

/// Takes what metadata hold off their front.
class Metadata {
 public:
  Metadata(const ByteFile& file, std::uint64_t at, std::string bytes, bool big_endian)
      : file_(file), at_(at), bytes_(std::move(bytes)), big_endian_(big_endian) {}

  template <class Number>
  Number take() {
    return number_at<Number>(take_bytes(sizeof(Number)), big_endian_);
  }
  const char* take_bytes(std::size_t count) {
    if (count > bytes_.size() - next_) fail("metadata that end too early");
    const char* from = bytes_.data() + next_;
    next_ += count;
    return from;
  }
  std::string take_text() {
    const auto size = take<std::uint32_t>();
    return {take_bytes(size), size};
  }
  bool big_endian() const { return big_endian_; }
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(file_.path(), "is damaged: " + what + " at byte " + std::to_string(at_ + next_),
                "copy it again from its source");
  }

 private:
  const ByteFile& file_;
  std::uint64_t at_;
  std::string bytes_;
  std::size_t next_ = 0;
  bool big_endian_;
};

const TypeRow& type_of(std::uint32_t code, const Metadata& metadata) {
  const auto row = std::ranges::find(kTypes, code, &TypeRow::code);
  if (row == kTypes.end()) metadata.fail("a type " + std::to_string(code) + " that is not known");
  return *row;
}

void take_properties(Metadata& metadata, TdmsProperties& properties) {
  const auto count = metadata.take<std::uint32_t>();
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::string name = metadata.take_text();
    const TypeRow& row = type_of(metadata.take<std::uint32_t>(), metadata);
    if (row.type == TdmsType::Text) {
      properties[name] = metadata.take_text();
    } else {
      const char* at = metadata.take_bytes(row.size);
      if (row.type != TdmsType::Other)
        properties[name] = tdms_number(row.type, at, metadata.big_endian());
    }
  }
}

/// A value of DAQmx: rows of bytes in one buffer or several, from which scalers take numbers.
void take_daqmx_index(Metadata& metadata, std::uint32_t kind, TdmsObject& object) {
  object.is_daqmx = true;
  metadata.take<std::uint32_t>();  // the type of what comes of it
  metadata.take<std::uint32_t>();  // the dimension
  object.values = metadata.take<std::uint64_t>();
  object.bytes = 0;

  // The scalers: of several, which take parts of one value, none is read.
  const auto scalers = metadata.take<std::uint32_t>();
  if (scalers != 1) object.unread = "it has " + std::to_string(scalers) + " scalers";
  if (kind == kDigitalLine) object.unread = "it is a digital line";
  for (std::uint32_t k = 0; k < scalers; ++k) {
    const auto type = metadata.take<std::uint32_t>();
    object.buffer = metadata.take<std::uint32_t>();
    object.offset = metadata.take<std::uint32_t>();
    metadata.take_bytes(kind == kDigitalLine ? 5 : 8);
    if (type < kDaqmxTypes.size())
      object.type = kDaqmxTypes[type];
    else
      object.unread = "its values are of type " + std::to_string(type);
  }
  const auto widths = metadata.take<std::uint32_t>();
  object.widths.clear();
  for (std::uint32_t k = 0; k < widths; ++k)
    object.widths.push_back(metadata.take<std::uint32_t>());

  // Where a value lies in the row of its buffer.
  if (!object.unread.empty()) return;
  const std::size_t size = size_of(object.type);
  if (object.buffer >= widths || object.widths[object.buffer] < size ||
      object.offset > object.widths[object.buffer] - size)
    metadata.fail("a value beyond its row");
}

/// How an object's values lie in the raw data; false when it has none here.
bool take_index(Metadata& metadata, TdmsObject& object) {
  const auto length = metadata.take<std::uint32_t>();
  if (length == kNoData) return false;
  if (length == kAsBefore) {
    if (object.type == TdmsType::Other && object.unread.empty())
      metadata.fail("values as before, and nothing was before");
    return true;
  }
  object.unread.clear();
  object.is_daqmx = false;
  if (length == kFormatChanging || length == kDigitalLine) {
    take_daqmx_index(metadata, length, object);
    return true;
  }

  const TypeRow& row = type_of(metadata.take<std::uint32_t>(), metadata);
  object.type = row.type;
  if (metadata.take<std::uint32_t>() != 1) metadata.fail("an array of more than one dimension");
  object.values = metadata.take<std::uint64_t>();
  if (row.type == TdmsType::Text) {
    object.bytes = metadata.take<std::uint64_t>();
    object.unread = "it holds texts";
    return true;
  }
  if (row.size == 0 || object.values > (std::uint64_t{1} << 48))
    metadata.fail("values that cannot be");
  if (row.type == TdmsType::Other) object.unread = "it holds complex numbers";
  object.bytes = object.values * row.size;
  return true;
}

/// Keeps what the segments before have said.
class IndexReader {
 public:
  IndexReader(const ByteFile& file, const TakeTdmsSegment& take) : file_(file), take_(take) {}

  std::vector<TdmsObject> read() {
    for (std::uint64_t at = 0; at + kLead <= file_.size();) at = read_segment(at);
    return std::move(objects_);
  }

 private:
  /// Returns where the next one begins.
  std::uint64_t read_segment(std::uint64_t at) {
    const std::string lead = file_.bytes(at, kLead);
    if (!lead.starts_with("TDSm")) fail(at, "no segment of TDMS");
    const auto contents = number_at<std::uint32_t>(lead.data() + 4);
    const bool big_endian = contents & kBigEndian;
    const auto stated = number_at<std::uint64_t>(lead.data() + 12, big_endian);
    const auto metadata_bytes = number_at<std::uint64_t>(lead.data() + 20, big_endian);

    // Where it ends; what a writer never closed goes on to the end of the file.
    const std::uint64_t room = file_.size() - at - kLead;
    const bool unfinished = stated == kNotClosed;
    const std::uint64_t length = unfinished ? room : stated;
    if (length > room)
      fail(at, "a segment of " + std::to_string(length) + " bytes, of which " +
                   std::to_string(room) + " are there,");
    if (unfinished && metadata_bytes > room) return file_.size();
    if (metadata_bytes > length) fail(at, "metadata beyond their segment");
    if (metadata_bytes > kMostMetadata) fail(at, "metadata of more than 64 MiB");

    if (contents & kNewList) listed_.clear();
    if (contents & kMetadata)
      read_objects(
          Metadata(file_, at + kLead, file_.bytes(at + kLead, metadata_bytes), big_endian));
    if ((contents & kRawData) && length > metadata_bytes)
      take_({.data_at = at + kLead + metadata_bytes,
             .data_bytes = length - metadata_bytes,
             .interleaved = (contents & kInterleaved) != 0,
             .big_endian = big_endian,
             .unfinished = unfinished,
             .objects = listed_},
            objects_);
    return at + kLead + length;
  }

  void read_objects(Metadata metadata) {
    const auto count = metadata.take<std::uint32_t>();
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::size_t number = number_of(metadata.take_text());
      const bool has_data = take_index(metadata, objects_[number]);
      const auto listed = std::ranges::find(listed_, number);
      if (has_data && listed == listed_.end()) listed_.push_back(number);
      if (!has_data && listed != listed_.end()) listed_.erase(listed);
      take_properties(metadata, objects_[number].properties);
    }
  }

  std::size_t number_of(const std::string& path) {
    const auto [known, is_new] = numbers_.try_emplace(path, objects_.size());
    if (is_new) {
      if (objects_.size() == kMostObjects)
        throw Error(file_.path(), "has more than " + std::to_string(kMostObjects) + " channels",
                    "save the recording's alone");
      objects_.push_back({.path = path, .properties = {}, .widths = {}, .unread = {}});
    }
    return known->second;
  }

  [[noreturn]] void fail(std::uint64_t at, const std::string& what) const {
    throw Error(file_.path(), "is cut off or damaged: " + what + " at byte " + std::to_string(at),
                "copy it again from its source");
  }

  const ByteFile& file_;
  const TakeTdmsSegment& take_;
  std::vector<TdmsObject> objects_;
  std::map<std::string, std::size_t> numbers_;
  std::vector<std::size_t> listed_;
};

}  // namespace

std::size_t size_of(TdmsType type) {
  if (type == TdmsType::Text || type == TdmsType::Other) return 0;
  return std::ranges::find(kTypes, type, &TypeRow::type)->size;
}

double tdms_number(TdmsType type, const char* at, bool big_endian, std::int64_t zero) {
  switch (type) {
    case TdmsType::I8:
      return number_at<std::int8_t>(at, big_endian);
    case TdmsType::I16:
      return number_at<std::int16_t>(at, big_endian);
    case TdmsType::I32:
      return number_at<std::int32_t>(at, big_endian);
    case TdmsType::I64:
      return static_cast<double>(number_at<std::int64_t>(at, big_endian));
    case TdmsType::U8:
      return number_at<std::uint8_t>(at, big_endian);
    case TdmsType::U16:
      return number_at<std::uint16_t>(at, big_endian);
    case TdmsType::U32:
      return number_at<std::uint32_t>(at, big_endian);
    case TdmsType::U64:
      return static_cast<double>(number_at<std::uint64_t>(at, big_endian));
    case TdmsType::F32:
      return number_at<float>(at, big_endian);
    case TdmsType::F64:
      return number_at<double>(at, big_endian);
    case TdmsType::Time: {
      // Whole seconds and 2^-64 parts, the more significant first where bytes are, too.
      const auto whole = number_at<std::int64_t>(at + (big_endian ? 0 : 8), big_endian);
      const auto parts = number_at<std::uint64_t>(at + (big_endian ? 8 : 0), big_endian);
      const double seconds = static_cast<double>(whole) - static_cast<double>(zero);
      return seconds + std::ldexp(static_cast<double>(parts), -64);
    }
    default:
      return 0;
  }
}

std::vector<TdmsObject> read_tdms_segments(const ByteFile& file, const TakeTdmsSegment& take) {
  return IndexReader(file, take).read();
}

}  // namespace dashpot
