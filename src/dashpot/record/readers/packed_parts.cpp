#include "dashpot/record/readers/packed_parts.h"

#include <zip.h>

#include "dashpot/base/file.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr std::size_t kWholePart = std::size_t{16} << 20;  // of a part that is read as a whole

}  // namespace

PackedPart::PackedPart(zip_file* file, std::string place, std::size_t size, std::size_t packed)
    : file_(file, zip_fclose), place_(std::move(place)), size_(size), packed_(packed) {}

std::size_t PackedPart::read(char* to, std::size_t room) {
  const zip_int64_t got = zip_fread(file_.get(), to, room);
  if (got < 0)
    throw Error(place_, std::string("is damaged: ") + zip_file_strerror(file_.get()),
                "copy the file again from its source");

  unpacked_ += static_cast<std::size_t>(got);
  if (unpacked_ > most_unpacked(packed_))
    throw Error(place_, "unpacks to far more than a recording of its size",
                "save the table as CSV, if it is what it should be");
  return static_cast<std::size_t>(got);
}

PackedParts::PackedParts(const std::filesystem::path& path)
    : path_(path.string()), zip_(nullptr, zip_discard) {
  int code = 0;
  zip_.reset(zip_open(path.c_str(), ZIP_RDONLY | ZIP_CHECKCONS, &code));
  if (!zip_)
    throw Error(path_, "is damaged or cut off: no whole zip file, which it is by its beginning",
                "copy it again from its source");
}

bool PackedParts::has(const std::string& name) const {
  return zip_name_locate(zip_.get(), name.c_str(), ZIP_FL_NOCASE) >= 0;
}

PackedPart PackedParts::open(const std::string& name) const {
  const std::string place = path_ + ", " + name;
  const zip_int64_t index = zip_name_locate(zip_.get(), name.c_str(), ZIP_FL_NOCASE);
  if (index < 0)
    throw Error(path_, "has no part " + name, "copy it again from its source, or save it anew");

  // A part whose sizes are not stated, or that is encrypted, cannot be read within bounds.
  zip_stat_t about;
  zip_stat_init(&about);
  const auto at = static_cast<zip_uint64_t>(index);
  if (zip_stat_index(zip_.get(), at, 0, &about) != 0 || !(about.valid & ZIP_STAT_SIZE) ||
      !(about.valid & ZIP_STAT_COMP_SIZE))
    throw Error(place, "states no size", "save the file anew");
  if ((about.valid & ZIP_STAT_ENCRYPTION_METHOD) && about.encryption_method != ZIP_EM_NONE)
    throw Error(place, "is encrypted", "save the file without a password");

  zip_file_t* file = zip_fopen_index(zip_.get(), at, 0);
  if (!file)
    throw Error(place, std::string("cannot be unpacked: ") + zip_strerror(zip_.get()),
                "copy the file again from its source");
  return {file, place, about.size, about.comp_size};
}

std::string PackedParts::text(const std::string& name) const {
  if (!has(name)) return {};
  PackedPart part = open(name);
  std::string text;
  std::string block(std::size_t{1} << 16, '\0');
  while (const std::size_t got = part.read(block.data(), block.size())) {
    text.append(block, 0, got);
    if (text.size() > kWholePart)
      throw Error(path_ + ", " + name, "is too large", "save the table as CSV");
  }
  return text;
}

}  // namespace dashpot
