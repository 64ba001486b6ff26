#include "dashpot/record/readers/line_source.h"

#include <cerrno>
#include <cstring>
#include <zlib.h>

#include "dashpot/error.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20;

using GzipFile = std::unique_ptr<gzFile_s, int (*)(gzFile_s*)>;

GzipFile open(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) throw Error(path.string(), "is a folder, not a file");
  GzipFile file(gzopen(path.c_str(), "rb"), gzclose);
  if (!file) throw Error(path.string(), std::string("cannot be read: ") + std::strerror(errno));
  gzbuffer(file.get(), 1 << 18);
  return file;
}

/// gzread passes plain files through unchanged. A truncated gzip ends with Z_BUF_ERROR.
std::size_t read_some(gzFile_s* file, char* to, std::size_t room, const std::string& path) {
  const int n = gzread(file, to, static_cast<unsigned>(room));
  int code = Z_OK;
  const char* message = n <= 0 ? gzerror(file, &code) : "";
  if (n < 0 || (n == 0 && code == Z_BUF_ERROR))
    throw Error(path, std::string("cannot be read: ") + message, "copy it again from its source");
  return static_cast<std::size_t>(n);
}

}  // namespace

LineSource::LineSource(const fs::path& path)
    : path_(path.string()), file_(open(path)), buffer_(kBlock) {
  std::error_code error;
  const auto size = fs::file_size(path, error);
  file_size_ = error ? 0 : static_cast<double>(size);
  fill();
  // A byte order mark is not part of the first name.
  if (end_ >= 3 && std::string_view(buffer_.data(), 3) == "\xEF\xBB\xBF") begin_ = 3;
  const std::string_view head(buffer_.data(), end_);
  if (head.find('\n') == std::string_view::npos && head.find('\r') != std::string_view::npos)
    line_end_ = '\r';
}

LineSource::~LineSource() = default;

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
  const std::size_t n = read_some(file_.get(), buffer_.data() + end_, buffer_.size() - end_, path_);
  end_ += n;
  at_end_ = n == 0;
  return n > 0;
}

std::string read_head(const fs::path& path, std::size_t bytes) {
  const GzipFile file = open(path);
  std::string head(bytes, '\0');
  head.resize(read_some(file.get(), head.data(), bytes, path.string()));
  return head;
}

}  // namespace dashpot
