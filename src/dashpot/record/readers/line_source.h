#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/base/file.h"

namespace dashpot {

/// The lines of a table, one after the other.
class Lines {
 public:
  virtual ~Lines() = default;

  /// The next line without its end, or nothing behind the last. Valid until the next call. Throws
  /// Error on a damaged file.
  virtual std::optional<std::string_view> next() = 0;
  virtual std::size_t line() const = 0;       ///< number of the line that next() gave, from 1
  virtual double expected_lines() const = 0;  ///< in all, guessed from what has been read
};

enum class TextEncoding { Bytes, Utf16Little, Utf16Big };

/// UTF-16 where these first bytes of a file begin with its byte order mark, or where nearly every
/// second one is 0 and those between are letters, as in what programs write that leave it out.
TextEncoding encoding_of(std::string_view head);

/// The lines of a text file (plain or gzip), read block by block: memory does not grow with the
/// file. UTF-16 is given as UTF-8. Lines end with LF, CRLF or both mixed,
/// with CR in a file without LF; one too long for a table of numbers is an Error.
class LineSource final : public Lines {
 public:
  explicit LineSource(const std::filesystem::path& path);

  std::optional<std::string_view> next() override;
  std::size_t line() const override { return line_; }
  double expected_lines() const override;

 private:
  bool fill();
  bool fill_from_utf16();

  std::string path_;
  InputFile file_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;
  std::size_t line_ = 0, consumed_ = 0;
  char line_end_ = '\n';
  bool at_end_ = false;
  TextEncoding encoding_ = TextEncoding::Bytes;
  std::string undecoded_;  ///< bytes of UTF-16 that have been read and not been decoded
};

}  // namespace dashpot
