#include "dashpot/record/readers/line_source.h"

#include <cstring>

#include "dashpot/error.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20;

}  // namespace

LineSource::LineSource(const fs::path& path) : path_(path.string()), file_(path), buffer_(kBlock) {
  fill();
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

double LineSource::bytes_per_line() const {
  return line_ == 0 ? 0 : static_cast<double>(consumed_) / static_cast<double>(line_);
}

/// Moves the unfinished line to the front and reads on; false at the end of the file.
bool LineSource::fill() {
  if (at_end_) return false;
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  if (end_ == buffer_.size())
    throw Error(path_ + ":" + std::to_string(line_ + 1),
                "a line of more than 1 MiB is not a table of numbers",
                "give a text file with one sample per line");
  const std::size_t n = file_.read(buffer_.data() + end_, buffer_.size() - end_);
  end_ += n;
  at_end_ = n == 0;
  return n > 0;
}

std::string read_head(const fs::path& path, std::size_t bytes) {
  InputFile file(path);
  std::string head(bytes, '\0');
  std::size_t at = 0;
  while (at < bytes) {
    const std::size_t n = file.read(head.data() + at, bytes - at);
    if (n == 0) break;
    at += n;
  }
  head.resize(at);
  return head;
}

}  // namespace dashpot
