#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "dashpot/record/readers/byte_file.h"

namespace dashpot {

/// A type of numbers in TDMS; Text and Other have no numbers.
enum class TdmsType { I8, I16, I32, I64, U8, U16, U32, U64, F32, F64, Time, Text, Other };

/// Bytes of one value; 0 for Text and Other.
std::size_t size_of(TdmsType type);
/// A value's number; of Time, seconds since 1904, or since `zero` of these seconds.
double tdms_number(TdmsType type, const char* at, bool big_endian, std::int64_t zero = 0);

using TdmsProperties = std::map<std::string, std::variant<double, std::string>>;

/// A root, group or channel by its path, "/'group'/'channel'", and what all segments say of it.
struct TdmsObject {
  std::string path;
  TdmsProperties properties;

  // How its values lie in the raw data of a segment; the last statement holds on.
  TdmsType type = TdmsType::Other;
  std::uint64_t values = 0, bytes = 0;  ///< in a chunk; DAQmx has its bytes in buffers
  bool is_daqmx = false;
  std::uint32_t buffer = 0, offset = 0;  ///< of a DAQmx value: its buffer, its place in the row
  std::vector<std::uint32_t> widths;     ///< bytes of a row of each DAQmx buffer
  std::string unread;                    ///< why its values are not read, "" where they are
};

/// One stretch of raw data: chunks of the values of some objects.
struct TdmsSegment {
  std::uint64_t data_at = 0, data_bytes = 0;
  bool interleaved = false, big_endian = false;
  bool unfinished = false;           ///< its writer stated no length
  std::vector<std::size_t> objects;  ///< by number, in the order of their data
};

/// Reads the leads and metadata of all segments, and gives each that has raw data together with
/// the objects as they are in it. Returns the objects, with their last properties. Every length is
/// compared with the file before it is believed. Throws Error(file, ...) on damage.
using TakeTdmsSegment =
    std::function<void(const TdmsSegment& segment, const std::vector<TdmsObject>& objects)>;
std::vector<TdmsObject> read_tdms_segments(const ByteFile& file, const TakeTdmsSegment& take);

}  // namespace dashpot
