#include "dashpot/record/readers/mat_guard.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>
#include <zlib.h>

#include "dashpot/error.h"
#include "dashpot/record/readers/stored_arrays.h"

namespace dashpot {
namespace {

constexpr std::size_t kHeader = 128;
constexpr int kDeepestStructure = 8;
constexpr std::size_t kMostElements = std::size_t{1} << 40;  // so that no product overflows

// Types of elements and classes of arrays in the version 5 format.
enum Element : std::uint32_t { kInt8 = 1, kInt32 = 5, kUint32 = 6, kMatrix = 14, kCompressed = 15 };
enum Class : std::uint32_t {
  kCell = 1,
  kStruct = 2,
  kChar = 4,
  kFirstNumeric = 6,
  kLastNumeric = 15
};

[[noreturn]] void refuse_bomb(const std::string& file) {
  throw Error(file, "unpacks to far more than a recording of its size",
              "save it without compression (-v6), or its recordings one by one");
}

[[noreturn]] void damaged(const std::string& file, const std::string& what) {
  throw Error(file, "damaged or cut off MAT file: " + what, "copy it again from its source");
}

/// What holds for a whole file while its parts are looked at.
struct Walk {
  const std::string& file;
  bool swap;               ///< the bytes of a number stand the other way round
  std::size_t bytes_left;  ///< that variables may still unpack to
  std::size_t values_left = bytes_left / sizeof(double);

  void unpack(std::size_t bytes) {
    if (bytes > bytes_left) refuse_bomb(file);
    bytes_left -= bytes;
  }
  void hold(std::size_t values) {
    if (values > values_left) refuse_bomb(file);
    values_left -= values;
  }
};

/// Reads forward through bytes and never past their end.
class Cursor {
 public:
  Cursor(std::string_view bytes, Walk& walk) : bytes_(bytes), walk_(walk) {}

  bool at_end() const { return bytes_.empty(); }
  std::size_t left() const { return bytes_.size(); }
  Walk& walk() const { return walk_; }
  const std::string& file() const { return walk_.file; }

  std::string_view take(std::size_t n, const char* what) {
    if (n > bytes_.size())
      damaged(file(), std::string(what) + " should have " + std::to_string(n) + " bytes, " +
                          std::to_string(bytes_.size()) + " are left");
    const std::string_view part = bytes_.substr(0, n);
    bytes_.remove_prefix(n);
    return part;
  }
  std::uint32_t u32(const char* what) {
    std::uint32_t value;
    std::memcpy(&value, take(4, what).data(), 4);
    return walk_.swap ? __builtin_bswap32(value) : value;
  }

  struct Part {
    std::uint32_t type;
    std::string_view data;
  };
  /// One element; short ones hold their data in the tag, others are padded to 8 bytes.
  Part element(const char* what) {
    const std::uint32_t word = u32(what);
    if (const std::uint32_t size = word >> 16; size != 0) {
      const std::string_view data = take(4, what);
      if (size > 4) damaged(file(), std::string(what) + " has a short tag of more than 4 bytes");
      return {word & 0xffff, data.substr(0, size)};
    }
    const std::uint32_t size = u32(what);
    const Part part{word, take(size, what)};
    if (word != kMatrix && word != kCompressed)
      take(std::min<std::size_t>((8 - size % 8) % 8, left()), what);
    return part;
  }

 private:
  std::string_view bytes_;
  Walk& walk_;
};

std::size_t element_size(std::uint32_t type) {
  switch (type) {
    case 1:
    case 2:
    case 16:
      return 1;
    case 3:
    case 4:
    case 17:
      return 2;
    case 5:
    case 6:
    case 7:
    case 18:
      return 4;
    case 9:
    case 12:
    case 13:
      return 8;
    default:
      return 0;
  }
}

void check_numbers(Cursor& cursor, std::size_t count, const char* what) {
  if (count == 0 && cursor.at_end()) return;
  const Cursor::Part part = cursor.element(what);
  const std::size_t size = element_size(part.type);
  if (size == 0) damaged(cursor.file(), std::string(what) + " is of no known number type");
  if (part.data.size() / size < count)
    damaged(cursor.file(), std::string(what) + " should hold " + std::to_string(count) +
                               " numbers, " + std::to_string(part.data.size() / size) +
                               " are there");
  cursor.walk().hold(count);
}

void check_matrix(std::string_view bytes, const Cursor& outer, int depth);

/// Checks the cells of a cell array or the fields of a structure.
void check_children(Cursor& cursor, std::size_t count, int depth) {
  for (std::size_t k = 0; k < count; ++k) {
    const Cursor::Part child = cursor.element("a part of a structure");
    if (child.type != kMatrix) damaged(cursor.file(), "a part of a structure is no array");
    if (!child.data.empty()) check_matrix(child.data, cursor, depth + 1);
  }
}

/// The number of elements; refuses a product that the bytes that are left cannot hold.
std::size_t count_elements(Cursor& cursor) {
  const Cursor::Part dimensions = cursor.element("the dimensions of an array");
  const std::size_t rank = dimensions.data.size() / 4;
  if (dimensions.type != kInt32 || rank < 2 || rank > 16)
    damaged(cursor.file(), "an array has impossible dimensions");
  Cursor sizes(dimensions.data, cursor.walk());

  // Multiply with care: the product of sizes that a damaged file states may overflow.
  std::size_t count = 1;
  bool empty = false;
  for (std::size_t k = 0; k < rank; ++k) {
    const std::uint32_t size = sizes.u32("a dimension");
    empty = empty || size == 0;
    if (size != 0 && count > kMostElements / size)
      damaged(cursor.file(), "an array states more elements than the file holds");
    if (size != 0) count *= size;
  }
  return empty ? 0 : count;
}

/// The field names, of one length each, and then count * fields arrays.
void check_structure(Cursor& cursor, std::size_t count, int depth) {
  const Cursor::Part length_part = cursor.element("the length of field names");
  if (length_part.type != kInt32 || length_part.data.size() < 4)
    damaged(cursor.file(), "a structure without the length of its field names");
  const std::uint32_t length = Cursor(length_part.data, cursor.walk()).u32("a length");

  const Cursor::Part names = cursor.element("the field names");
  if (length == 0 || length > 4096 || names.data.size() % length != 0)
    damaged(cursor.file(), "field names of impossible length");

  // Each field takes at least the 8 bytes of its tag.
  const std::size_t fields = names.data.size() / length;
  if (fields != 0 && count > cursor.left() / (8 * fields))
    damaged(cursor.file(), "a structure states more elements than the file holds");
  check_children(cursor, count * fields, depth);
}

void check_matrix(std::string_view bytes, const Cursor& outer, int depth) {
  if (depth > kDeepestStructure)
    damaged(outer.file(),
            "structures nested more than " + std::to_string(kDeepestStructure) + " deep");

  // The flags tell the class; classes that are never opened need no check.
  Cursor cursor(bytes, outer.walk());
  const Cursor::Part flags = cursor.element("the flags of an array");
  if (flags.type != kUint32 || flags.data.size() != 8)
    damaged(cursor.file(), "an array without flags");
  const std::uint32_t word = Cursor(flags.data, cursor.walk()).u32("flags");
  const std::uint32_t array_class = word & 0xff;
  const bool numeric =
      array_class == kChar || (array_class >= kFirstNumeric && array_class <= kLastNumeric);
  if (!numeric && array_class != kCell && array_class != kStruct) return;  // never opened

  // Dimensions and name, which all classes have.
  const std::size_t count = count_elements(cursor);
  const Cursor::Part name = cursor.element("the name of an array");
  if (name.type != kInt8 || name.data.size() > 4096)
    damaged(cursor.file(), "an array without a proper name");

  // Then what the class holds.
  if (array_class == kStruct) return check_structure(cursor, count, depth);
  if (array_class == kCell) {
    if (count > cursor.left() / 8)
      damaged(cursor.file(), "a cell array states more elements than the file holds");
    return check_children(cursor, count, depth);
  }
  check_numbers(cursor, count, "an array");
  if (word & 0x800) check_numbers(cursor, count, "the imaginary part of an array");
}

/// Unpacks a compressed variable, as far as the file may.
std::string inflate_bytes(std::string_view packed, Walk& walk) {
  const std::string& file = walk.file;
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) damaged(file, "it cannot be unpacked");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());

  std::string out;
  std::vector<char> block(1 << 16);
  int code = Z_OK;
  while (code == Z_OK && out.size() <= walk.bytes_left) {
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = static_cast<uInt>(block.size());
    code = inflate(&stream, Z_NO_FLUSH);
    out.append(block.data(), block.size() - stream.avail_out);
  }

  inflateEnd(&stream);
  if (code == Z_OK) refuse_bomb(file);
  if (code != Z_STREAM_END) damaged(file, "a packed variable cannot be unpacked");
  walk.unpack(out.size());
  return out;
}

void check_version5(std::string_view bytes, const std::string& file) {
  Walk walk{.file = file,
            .swap = bytes.substr(126, 2) == "MI",
            .bytes_left = most_stored_bytes(bytes.size())};
  Cursor cursor(bytes.substr(kHeader), walk);
  if (cursor.at_end()) damaged(file, "it holds no variables");
  while (!cursor.at_end()) {
    Cursor::Part part = cursor.element("a variable");
    std::string unpacked;
    if (part.type == kCompressed) {
      unpacked = inflate_bytes(part.data, walk);
      part = Cursor(unpacked, walk).element("a packed variable");
    }
    if (part.type != kMatrix) damaged(file, "a variable is no array");
    check_matrix(part.data, cursor, 0);
  }
}

/// Version 4: a header of five integers before each matrix, and no signature.
void check_version4(std::string_view bytes, const std::string& file) {
  if (bytes.size() < 20) damaged(file, "it ends inside its header");
  Walk walk{.file = file, .swap = false, .bytes_left = most_stored_bytes(bytes.size())};
  walk.swap = Cursor(bytes, walk).u32("the type") > 9999;
  Cursor cursor(bytes, walk);

  // Bytes of one number, by the precision's digit in the type.
  constexpr std::size_t kSizes[] = {8, 4, 4, 2, 2, 1};
  while (!cursor.at_end()) {
    const std::uint32_t type = cursor.u32("a header"), rows = cursor.u32("a header"),
                        columns = cursor.u32("a header");
    const std::uint32_t complex = cursor.u32("a header"), name = cursor.u32("a header");

    const std::uint32_t precision = type / 10 % 10;
    if (type > 4999 || precision > 5 || type % 10 > 2 || complex > 1 || name == 0 || name > 4096)
      throw Error(file, "is not a MAT file",
                  "it starts neither like version 4 nor like version 5 or 7.3");

    cursor.take(name, "a name");
    const std::size_t size = kSizes[precision] * (complex + 1);
    if (columns != 0 && rows > cursor.left() / size / columns)
      damaged(file, "a matrix states more elements than the file holds");
    walk.hold(std::size_t{rows} * columns);
    cursor.take(size * rows * columns, "a matrix");
  }
}

}  // namespace

void check_mat(std::string_view bytes, const std::string& file) {
  const bool signature =
      bytes.size() >= kHeader && (bytes.substr(126, 2) == "IM" || bytes.substr(126, 2) == "MI");
  if (signature) return check_version5(bytes, file);
  if (bytes.substr(0, 6) == "MATLAB") damaged(file, "it ends inside its header");
  check_version4(bytes, file);
}

void check_mat73(std::string_view head, std::uintmax_t file_size, const std::string& file) {
  constexpr std::size_t kSuperblock = 512,
                        kPlaces[] = {40, 44, 28, 28};  // of the length, by version
  if (head.size() < kMat73Head) damaged(file, "it ends inside its header");
  const std::string_view block = head.substr(kSuperblock);
  const auto version = static_cast<unsigned char>(block[8]);
  if (!block.starts_with("\x89HDF\r\n\x1a\n") || version > 3)
    damaged(file, "it says version 7.3 but is no HDF5");
  std::uint64_t length;
  std::memcpy(&length, block.data() + kPlaces[version], sizeof length);
  if (length > file_size)
    damaged(file, "it should have " + std::to_string(length) + " bytes and has " +
                      std::to_string(file_size));
}

}  // namespace dashpot
