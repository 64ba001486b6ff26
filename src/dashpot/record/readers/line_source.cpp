#include "dashpot/record/readers/line_source.h"

#include <algorithm>
#include <cstring>

#include "dashpot/error.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 16, kLongestLine = std::size_t{1} << 20;
constexpr std::size_t kLongestCharacter = 4;  // bytes of UTF-8
constexpr std::string_view kLittleMark = "\xFF\xFE", kBigMark = "\xFE\xFF";

/// Whether nearly all pairs of bytes are a letter and a 0, the letter at this place of the pair.
bool pairs_with_zeros(std::string_view head, std::size_t letter) {
  constexpr std::size_t kFewest = 8;
  std::size_t pairs = 0, letters = 0;
  for (std::size_t k = 0; k + 1 < head.size(); k += 2, ++pairs) {
    const auto first = static_cast<unsigned char>(head[k + letter]);
    const bool is_letter = first >= ' ' || first == '\t' || first == '\r' || first == '\n';
    if (first == 0) return false;
    letters += is_letter && head[k + 1 - letter] == '\0';
  }
  return pairs >= kFewest && 8 * letters >= 7 * pairs;
}

}  // namespace

TextEncoding encoding_of(std::string_view head) {
  constexpr std::size_t kLooked = 4096;
  head = head.substr(0, kLooked);
  if (head.starts_with(kLittleMark) || pairs_with_zeros(head, 0)) return TextEncoding::Utf16Little;
  if (head.starts_with(kBigMark) || pairs_with_zeros(head, 1)) return TextEncoding::Utf16Big;
  return TextEncoding::Bytes;
}

LineSource::LineSource(const fs::path& path) : path_(path.string()), file_(path), buffer_(kBlock) {
  fill();
  // In UTF-16 what was read is decoded, and all that follows.
  const std::string_view first(buffer_.data(), end_);
  encoding_ = encoding_of(first);
  if (encoding_ != TextEncoding::Bytes) {
    const bool is_marked = first.starts_with(kLittleMark) || first.starts_with(kBigMark);
    undecoded_ = first.substr(is_marked ? 2 : 0);
    end_ = 0;
    fill();
  }
  // A byte order mark is not part of the first name.
  if (end_ >= 3 && std::string_view(buffer_.data(), 3) == "\xEF\xBB\xBF") begin_ = 3;
  const std::string_view head(buffer_.data(), end_);
  if (head.find('\n') == std::string_view::npos && head.find('\r') != std::string_view::npos)
    line_end_ = '\r';
}

std::optional<std::string_view> LineSource::next() {
  for (;;) {
    const char* from = buffer_.data() + begin_;
    const auto* end_of_line = static_cast<const char*>(std::memchr(from, line_end_, end_ - begin_));

    // No end of line in the buffer: read on; at the end of the file the last line needs none.
    if (!end_of_line && fill()) continue;
    if (!end_of_line && begin_ == end_) return std::nullopt;

    std::string_view text(
        buffer_.data() + begin_,
        end_of_line ? static_cast<std::size_t>(end_of_line - from) : end_ - begin_);

    begin_ += text.size() + (end_of_line ? 1 : 0);
    consumed_ += text.size() + 1;
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
    ++line_;
    return text;
  }
}

double LineSource::expected_lines() const {
  const double per_line =
      static_cast<double>(consumed_) / static_cast<double>(std::max<std::size_t>(line_, 1));
  return static_cast<double>(file_.size()) / std::max(per_line, 1.0);
}

/// Moves the unfinished line to the front, makes room behind it and reads on; false at the end of
/// the file.
bool LineSource::fill() {
  if (at_end_) return false;
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  if (buffer_.size() - end_ < kLongestCharacter) {
    if (buffer_.size() >= kLongestLine)
      throw Error(path_ + ":" + std::to_string(line_ + 1),
                  "a line of more than 1 MiB is not a table of numbers",
                  "give a text file with one sample per line");
    buffer_.resize(2 * buffer_.size());
  }
  if (encoding_ != TextEncoding::Bytes) return fill_from_utf16();
  const std::size_t n = file_.read(buffer_.data() + end_, buffer_.size() - end_);
  end_ += n;
  at_end_ = n == 0;
  return n > 0;
}

/// Decodes as much as there is room for, and reads on where nothing is left to decode.
bool LineSource::fill_from_utf16() {
  const std::size_t before = end_;
  const auto unit_at = [&](std::size_t k) {
    const auto first = static_cast<unsigned char>(undecoded_[k]),
               second = static_cast<unsigned char>(undecoded_[k + 1]);
    return encoding_ == TextEncoding::Utf16Little ? first | second << 8 : first << 8 | second;
  };

  // A surrogate needs two units, so fewer than four bytes may have to wait for more.
  if (undecoded_.size() < 4) {
    std::string more(kBlock, '\0');
    more.resize(file_.read(more.data(), more.size()));
    at_end_ = more.empty();
    undecoded_ += more;
  }

  std::size_t k = 0;
  while (k + 1 < undecoded_.size() && end_ + kLongestCharacter <= buffer_.size()) {
    unsigned code = static_cast<unsigned>(unit_at(k));
    const bool high = code >= 0xD800 && code < 0xDC00;
    if (high && k + 3 >= undecoded_.size() && !at_end_) break;
    k += 2;
    if (high && k + 1 < undecoded_.size()) {
      code = 0x10000 + ((code - 0xD800) << 10) +
             ((static_cast<unsigned>(unit_at(k)) - 0xDC00) & 0x3FF);
      k += 2;
    }
    const auto put = [&](unsigned byte) { buffer_[end_++] = static_cast<char>(byte); };
    if (code < 0x80) {
      put(code);
    } else if (code < 0x800) {
      put(0xC0 | code >> 6), put(0x80 | (code & 0x3F));
    } else if (code < 0x10000) {
      put(0xE0 | code >> 12), put(0x80 | (code >> 6 & 0x3F)), put(0x80 | (code & 0x3F));
    } else {
      put(0xF0 | (code >> 18 & 0x07)), put(0x80 | (code >> 12 & 0x3F));
      put(0x80 | (code >> 6 & 0x3F)), put(0x80 | (code & 0x3F));
    }
  }
  undecoded_.erase(0, k);
  if (end_ == before && !at_end_) return fill_from_utf16();
  return end_ > before;
}

}  // namespace dashpot
