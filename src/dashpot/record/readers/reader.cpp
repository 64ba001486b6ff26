#include "dashpot/record/readers/reader.h"

#include "dashpot/base/file.h"
#include "dashpot/base/file_kind.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/csv.h"
#include "dashpot/record/readers/daq_text.h"
#include "dashpot/record/readers/family_json.h"
#include "dashpot/record/readers/hdf5.h"
#include "dashpot/record/readers/lvm.h"
#include "dashpot/record/readers/mat.h"
#include "dashpot/record/readers/mdf4.h"
#include "dashpot/record/readers/tdms.h"
#include "dashpot/record/readers/xlsx.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

// The most telling content first: CSV takes any text that is left.
constexpr Reader kReaders[] = {
    {"MAT", ".mat", is_mat, read_mat},
    {"HDF5", ".h5 .hdf5", is_hdf5, read_hdf5},
    {"MDF 4", ".mf4 .mdf", is_mdf4, read_mdf4},
    {"TDMS", ".tdms", is_tdms, read_tdms},
    {"XLSX", ".xlsx .xlsm", is_xlsx, read_xlsx},
    {"family JSON", ".json of dampers and levels, or with its inp_*.json", is_family_json,
     read_family_json},
    {"LVM", ".lvm", is_lvm, read_lvm},
    {"DAQ text log", ".txt", is_daq_text, read_daq_text},
    {"CSV", ".csv .txt .tsv .dat .asc", is_csv, read_csv},
};

constexpr std::size_t kHead = 4096;  // bytes that tell a format

const Reader* reader_of(const fs::path& path, std::string_view head) {
  const std::string extension = lower(without_gz(path).extension().string());
  for (const Reader& reader : kReaders)
    if (reader.recognises(path, extension, head)) return &reader;
  return nullptr;
}

/// "is a model file, no recording", or that it cannot be read.
std::string no_recording(const fs::path& path) {
  try {
    const std::string text = read_file(path);
    const std::string kind =
        file_kind(trim(text).starts_with('{') ? parse_json(text, path.string())
                                              : parse_yaml(text, path.string()));
    if (!kind.empty()) return "is " + kind + ", no recording";
  } catch (const Error&) {  // whatever else it is
  }
  return "is not a recording that Dashpot can read";
}

}  // namespace

std::span<const Reader> readers() { return kReaders; }

fs::path without_gz(const fs::path& path) {
  return lower(path.extension().string()) == ".gz" ? path.parent_path() / path.stem() : path;
}

const Reader* find_reader(const fs::path& path) { return reader_of(path, read_head(path, kHead)); }

std::vector<RawTable> read_tables(const fs::path& path) {
  const std::string head = read_head(path, kHead);
  if (head.empty())
    throw Error(path.string(), "is empty (0 bytes)", "copy it again from its source");
  const Reader* reader = reader_of(path, head);
  if (!reader) throw Error(path.string(), no_recording(path), "it reads " + known_formats());
  return reader->read(path);
}

std::string known_formats() {
  std::vector<std::string> formats;
  for (const Reader& reader : kReaders)
    formats.push_back(std::string(reader.name) + " (" + std::string(reader.extensions) + ")");
  return join(formats, ", ") + ", those of text also as .gz";
}

}  // namespace dashpot
