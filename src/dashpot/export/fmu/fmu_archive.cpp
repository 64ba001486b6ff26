#include <memory>
#include <zip.h>

#include "dashpot/error.h"
#include "dashpot/export/fmu/fmu.h"

namespace dashpot {
namespace {

struct Close {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_source_t* source) const { zip_source_free(source); }
};
using Archive = std::unique_ptr<zip_t, Close>;
using Source = std::unique_ptr<zip_source_t, Close>;

[[noreturn]] void fail(const std::string& what) { throw Error("zip archive", what); }

void add(zip_t* archive, const ExportedFile& file, std::time_t time) {
  Source content(zip_source_buffer(archive, file.content.data(), file.content.size(), 0));
  if (!content) fail(zip_strerror(archive));
  const zip_int64_t index =
      zip_file_add(archive, file.name.c_str(), content.get(), ZIP_FL_ENC_UTF_8);
  if (index < 0) fail(zip_strerror(archive));
  (void)content.release();  // the archive's now
  const auto place = static_cast<zip_uint64_t>(index);
  if (zip_set_file_compression(archive, place, ZIP_CM_DEFLATE, 9) != 0 ||
      zip_file_set_mtime(archive, place, time, 0) != 0)
    fail(zip_strerror(archive));
}

std::string content_of(zip_source_t* buffer) {
  zip_stat_t about;
  if (zip_source_stat(buffer, &about) != 0 || zip_source_open(buffer) != 0)
    fail("cannot be read back");
  std::string bytes(about.size, '\0');
  const zip_int64_t got = zip_source_read(buffer, bytes.data(), bytes.size());
  zip_source_close(buffer);
  if (got != static_cast<zip_int64_t>(bytes.size())) fail("cannot be read back");
  return bytes;
}

}  // namespace

std::string zip_archive(const std::vector<ExportedFile>& files, std::time_t time) {
  zip_error_t error;
  zip_error_init(&error);
  Source buffer(zip_source_buffer_create(nullptr, 0, 0, &error));
  if (!buffer) fail(zip_error_strerror(&error));

  // The archive is written to the buffer when it is closed; the second reference keeps that for
  // reading it back.
  zip_source_keep(buffer.get());
  Archive archive(zip_open_from_source(buffer.get(), ZIP_TRUNCATE, &error));
  if (!archive) {
    zip_source_free(buffer.get());
    fail(zip_error_strerror(&error));
  }

  for (const ExportedFile& file : files) add(archive.get(), file, time);
  if (zip_close(archive.get()) != 0) fail(zip_strerror(archive.get()));
  (void)archive.release();
  return content_of(buffer.get());
}

}  // namespace dashpot
