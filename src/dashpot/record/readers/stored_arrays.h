#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace dashpot {

/// Of one matrix: more is an image, not a recording.
inline constexpr std::size_t kMostMatrixColumns = 64;

/// A matrix of numbers as a file of HDF5 or MATLAB holds it. Its longer side runs along time: a
/// column for each step of the shorter one. No columns where there would be more than
/// kMostMatrixColumns.
struct StoredArray {
  std::string group;  ///< "" or where in the file
  std::string name, unit;
  std::size_t height = 1, width = 1;  ///< as it is stored
  std::vector<std::vector<double>> columns;

  std::size_t length() const { return std::max(height, width); }
  bool is_wide() const { return std::min(height, width) > kMostMatrixColumns; }
};

/// What was passed over, and where.
struct StoredNote {
  std::string group, text;
};

struct StoredArrays {
  std::vector<StoredArray> arrays;
  std::vector<StoredNote> notes;
};

enum class StoredFormat { Hdf5, Mat };

/// Bytes that all arrays of a file of that size may have as numbers of double precision: more is
/// an attack on memory or time, no recording.
std::size_t most_stored_bytes(std::uintmax_t file_size);

/// Reads a file in a process of its own, dashpot-hdf5, since a damaged one ends HDF5, and whatever
/// process calls it. Throws Error on damage, also where it ended that process.
StoredArrays read_stored_arrays(const std::filesystem::path& path, StoredFormat format);

/// Takes up to `count` bytes, fewer only where they end.
using TakeBytes = std::function<std::size_t(void* to, std::size_t count)>;
using GiveBytes = std::function<void(const void* from, std::size_t count)>;

/// What that process hands over as it reads: arrays and notes in the order of the file, then the
/// end or why it cannot be read. Bytes stand as this machine has them.
class StoredWriter {
 public:
  explicit StoredWriter(GiveBytes give);

  /// `about` without its columns, then each of them by add_column, unless the array is wide.
  void begin_array(const StoredArray& about);
  /// The numbers of a column, `stride` apart.
  template <class Number>
  void add_column(const Number* from, std::size_t count, std::size_t stride);
  void note(const StoredNote& note);
  /// In place of all these, where a file was to be made: its bytes.
  void file(std::string_view bytes);
  void end();
  void fail(std::string_view message);

 private:
  void put(std::string_view text);

  GiveBytes give_;
};

/// The other end. False where it breaks off or is none of this, or more than `most_bytes`. Throws
/// the Error that the process met.
bool take_stored_arrays(const TakeBytes& take, std::size_t most_bytes, StoredArrays& to);
/// The same for a file that was made.
bool take_stored_file(const TakeBytes& take, std::string& to);

template <class Number>
void StoredWriter::add_column(const Number* from, std::size_t count, std::size_t stride) {
  if constexpr (std::is_same_v<Number, double>)
    if (stride == 1) return give_(from, count * sizeof(double));
  std::array<double, 4096> block;
  for (std::size_t done = 0; done < count;) {
    const std::size_t n = std::min(block.size(), count - done);
    for (std::size_t k = 0; k < n; ++k) block[k] = static_cast<double>(from[(done + k) * stride]);
    give_(block.data(), n * sizeof(double));
    done += n;
  }
}

}  // namespace dashpot
