#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/record/readers/byte_file.h"

namespace dashpot {

/// A block of an MDF 4 file: its name ("CG"), its links to other blocks (0: to none) and where its
/// data lie.
struct Mdf4Block {
  std::string name;
  std::uint64_t at = 0;  ///< of the block in the file
  std::vector<std::uint64_t> links;
  std::uint64_t data_at = 0, data_size = 0;

  std::uint64_t link(std::size_t k) const { return k < links.size() ? links[k] : 0; }
};

/// The blocks of an MDF 4 file (ASAM MDF 4.0 to 4.2). Every length and place is compared with the
/// file before it is believed, and blocks that refer to each other in a circle are an Error.
class Mdf4Blocks {
 public:
  explicit Mdf4Blocks(const std::filesystem::path& path) : file_(path) {}

  /// The block at a place; it has to be of one of the names ("DT DZ DL"). Throws Error(file, ...)
  /// when it is none.
  Mdf4Block block(std::uint64_t at, std::string_view names);
  /// The first bytes of a block's data. Throws Error when it has fewer.
  std::string data(const Mdf4Block& block, std::size_t count);
  /// The text of a TX block, or the element TX of an MD block's XML; "" for no block.
  std::string text(std::uint64_t at);

  /// Gives the bytes behind the data link of a data group in order, in pieces of any size: of DT,
  /// DZ, DL and HL blocks. Throws Error on damage, on data in columns (DV, LD) and on far more
  /// bytes than a file of this size has.
  void stream(std::uint64_t at, const std::function<void(std::string_view)>& take);

  /// To be told of all values that are kept: channels that lie over each other make more of them
  /// than bytes. Throws Error on far more than a file of this size has.
  void count_values(std::uint64_t at, std::uint64_t values);

  const ByteFile& file() const { return file_; }
  [[noreturn]] void fail(std::uint64_t at, const std::string& what) const;

 private:
  void stream_block(const Mdf4Block& block, const std::function<void(std::string_view)>& take);
  void stream_plain(const Mdf4Block& block, const std::function<void(std::string_view)>& take);
  void stream_packed(const Mdf4Block& block, const std::function<void(std::string_view)>& take);
  void count(std::uint64_t at, std::uint64_t bytes);
  [[noreturn]] void fail_by_column() const;

  ByteFile file_;
  std::uint64_t blocks_ = 0, streamed_ = 0, values_ = 0;
};

}  // namespace dashpot
