#include "dashpot/record/readers/mdf4_blocks.h"

#include <algorithm>
#include <zlib.h>

#include <pugixml.hpp>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr std::size_t kHead = 24;                         // name, length, number of links
constexpr std::uint64_t kMostLinks = 1'000'000;           // of a list of data blocks
constexpr std::uint64_t kMostTextBytes = 1 << 20;         // of a comment
constexpr std::uint64_t kMostPackedBlock = 256ull << 20;  // unpacked; the standard has 4 MiB
constexpr std::uint64_t kMostDeflated = 1032;             // bytes that one can stand for
constexpr std::size_t kPiece = std::size_t{1} << 20;

/// What was stored column by column, so that it packs better, row by row again; bytes that fill no
/// row stand at the end as they were.
std::string transposed(const std::string& columns, std::size_t width) {
  if (width < 2 || columns.size() < width) return columns;
  const std::size_t rows = columns.size() / width;
  std::string out(columns);
  for (std::size_t c = 0; c < width; ++c)
    for (std::size_t r = 0; r < rows; ++r) out[r * width + c] = columns[c * rows + r];
  return out;
}

}  // namespace

void Mdf4Blocks::fail(std::uint64_t at, const std::string& what) const {
  throw Error(file_.path(), "is damaged: " + what + " at byte " + std::to_string(at),
              "copy it again from its source");
}

void Mdf4Blocks::fail_by_column() const {
  throw Error(file_.path(),
              "stores its samples column by column, in blocks DV or LD, as MDF 4.2 may",
              "save it as MDF 4.1, or without column-oriented storage");
}

Mdf4Block Mdf4Blocks::block(std::uint64_t at, std::string_view names) {
  // No file has more blocks than their heads have room for, read each a few times.
  if (++blocks_ > 16 + file_.size() / 4) fail(at, "its blocks refer to each other in a circle");
  const std::string head = file_.bytes(at, kHead);
  Mdf4Block block;
  block.at = at;
  block.name = head.substr(2, 2);
  if (!head.starts_with("##") || names.find(block.name) == std::string_view::npos)
    fail(at, "no block of " + std::string(names));

  const auto length = number_at<std::uint64_t>(head.data() + 8);
  const auto links = number_at<std::uint64_t>(head.data() + 16);
  if (length < kHead || length > file_.size() - at || links > kMostLinks ||
      8 * links > length - kHead)
    fail(at, "a length that the file does not have, in the block " + block.name);

  const std::string bytes = file_.bytes(at + kHead, 8 * links);
  for (std::size_t k = 0; k < links; ++k)
    block.links.push_back(number_at<std::uint64_t>(bytes.data() + 8 * k));
  block.data_at = at + kHead + 8 * links;
  block.data_size = length - kHead - 8 * links;
  return block;
}

std::string Mdf4Blocks::data(const Mdf4Block& block, std::size_t count) {
  if (block.data_size < count) fail(block.at, "too short a block " + block.name);
  return file_.bytes(block.data_at, count);
}

std::string Mdf4Blocks::text(std::uint64_t at) {
  if (at == 0) return {};
  const Mdf4Block found = block(at, "TX MD");
  std::string text = data(found, std::min(found.data_size, kMostTextBytes));
  text.resize(std::min(text.find('\0'), text.size()));
  if (found.name == "TX") return std::string(trim(text));

  pugi::xml_document document;
  if (!document.load_buffer(text.data(), text.size())) return {};
  return std::string(trim(document.document_element().child("TX").text().get()));
}

void Mdf4Blocks::stream(std::uint64_t at, const std::function<void(std::string_view)>& take) {
  if (at == 0) return;
  Mdf4Block first = block(at, "DT DZ DL HL DV LD");
  if (first.name == "DV" || first.name == "LD") fail_by_column();
  if (first.name == "HL") {
    if (first.link(0) == 0) return;
    first = block(first.link(0), "DL");
  }
  if (first.name != "DL") return stream_block(first, take);

  // A list of blocks, and lists behind it.
  for (Mdf4Block list = std::move(first);;) {
    for (std::size_t k = 1; k < list.links.size(); ++k)
      if (list.links[k] != 0) stream_block(block(list.links[k], "DT DZ"), take);
    if (list.link(0) == 0) return;
    list = block(list.link(0), "DL");
  }
}

void Mdf4Blocks::stream_block(const Mdf4Block& block,
                              const std::function<void(std::string_view)>& take) {
  block.name == "DT" ? stream_plain(block, take) : stream_packed(block, take);
}

void Mdf4Blocks::stream_plain(const Mdf4Block& block,
                              const std::function<void(std::string_view)>& take) {
  count(block.at, block.data_size);
  std::string piece;
  for (std::uint64_t done = 0; done < block.data_size; done += piece.size()) {
    piece.resize(static_cast<std::size_t>(std::min<std::uint64_t>(kPiece, block.data_size - done)));
    file_.read(block.data_at + done, piece.data(), piece.size());
    take(piece);
  }
}

void Mdf4Blocks::stream_packed(const Mdf4Block& block,
                               const std::function<void(std::string_view)>& take) {
  // What was packed, how, and how long it was.
  constexpr std::size_t kPackedHead = 24;
  const std::string head = data(block, kPackedHead);
  const auto way = static_cast<unsigned char>(head[2]);
  const auto width = number_at<std::uint32_t>(head.data() + 4);
  const auto whole = number_at<std::uint64_t>(head.data() + 8);
  const auto packed = number_at<std::uint64_t>(head.data() + 16);
  if (head.substr(0, 2) == "DV" || head.substr(0, 2) == "DI") fail_by_column();
  if (head.substr(0, 2) != "DT") fail(block.at, "packed data of another kind than DT");
  if (way > 1)
    throw Error(file_.path(), "is packed in way " + std::to_string(way) + ", newer than MDF 4.2",
                "save it with deflate, or unpacked");
  if (packed > block.data_size - kPackedHead || whole > kMostPackedBlock ||
      whole / kMostDeflated > packed)
    fail(block.at, "a length that cannot be, in the block DZ");
  count(block.at, whole);

  const std::string input = file_.bytes(block.data_at + kPackedHead, packed);
  std::string output(whole, '\0');
  uLongf got = whole;
  const int code = uncompress(reinterpret_cast<Bytef*>(output.data()), &got,
                              reinterpret_cast<const Bytef*>(input.data()), input.size());
  if (code != Z_OK || got != whole) fail(block.at, "a block DZ that cannot be unpacked");
  take(way == 1 ? transposed(output, width) : output);
}

/// A few blocks that are listed again and again, or packed, are more data than the file has.
void Mdf4Blocks::count(std::uint64_t at, std::uint64_t bytes) {
  streamed_ += bytes;
  if (streamed_ > most_unpacked(file_.size()))
    fail(at, "far more data than a recording of its size has");
}

void Mdf4Blocks::count_values(std::uint64_t at, std::uint64_t values) {
  values_ += values;
  if (values_ > most_unpacked(file_.size()))
    fail(at, "far more values than a recording of its size has");
}

}  // namespace dashpot
