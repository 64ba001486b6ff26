#include "dashpot/record/record_file.h"

#include <matio.h>
#include <memory>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

constexpr int kTimeDigits = 12, kDigits = 9;

struct Close {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct Free {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, Free>;

void write(mat_t* file, const Variable& variable, const fs::path& path) {
  if (!variable || Mat_VarWrite(file, variable.get(), MAT_COMPRESSION_NONE) != 0)
    throw Error(path.string(), "cannot be written");
}

void write_vector(mat_t* file, const std::string& name, const std::vector<double>& values,
                  const fs::path& path) {
  size_t size[2] = {values.size(), 1};
  write(file,
        Variable(Mat_VarCreate(name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size,
                               const_cast<double*>(values.data()), MAT_F_DONT_COPY_DATA)),
        path);
}

void write_text(mat_t* file, const std::string& name, const std::string& text,
                const fs::path& path) {
  size_t size[2] = {1, text.size()};
  write(file,
        Variable(Mat_VarCreate(name.c_str(), MAT_C_CHAR, MAT_T_UTF8, 2, size,
                               const_cast<char*>(text.data()), MAT_F_DONT_COPY_DATA)),
        path);
}

}  // namespace

void save_csv(const Record& record, const fs::path& path) {
  std::string text = "time [s]";
  for (const Channel& channel : record.channels)
    text += ',' + channel.name + " [" + channel.unit + ']';
  text += '\n';
  for (std::size_t k = 0; k < record.size(); ++k) {
    text += format_number(record.time[k], kTimeDigits);
    for (const Channel& channel : record.channels)
      text += ',' + format_number(channel.samples[k], kDigits);
    text += '\n';
  }
  write_file(path, text);
}

void save_mat(const Record& record, const fs::path& path) {
  if (path.has_parent_path()) make_folder(path.parent_path());
  const fs::path unfinished = path.string() + ".part";
  {
    const std::unique_ptr<mat_t, Close> file(
        Mat_CreateVer(unfinished.c_str(), nullptr, MAT_FT_MAT5));
    if (!file) throw Error(path.string(), "cannot be written");

    std::string units = "time s";
    write_vector(file.get(), "time", record.time, path);
    for (const Channel& channel : record.channels) {
      write_vector(file.get(), channel.name, channel.samples, path);
      units += "; " + channel.name + ' ' + channel.unit;
    }
    write_text(file.get(), "units", units, path);
  }
  fs::rename(unfinished, path);
}

}  // namespace dashpot
