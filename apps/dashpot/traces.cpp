#include "traces.h"

#include <cctype>

#include <fmt/core.h>

#include "dashpot/identify/judge/traces.h"
#include "dashpot/record/record_file.h"
#include "dashpot/record/sample_columns.h"

namespace dashpot::cli {
namespace {

/// A record's name as that of a file.
std::string trace_name(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-') c = '_';
  return name;
}

}  // namespace

Option traces_option(std::string& format) {
  return {.names = "--traces",
          .target = &format,
          .help =
              "also write measured, modelled and residual force of every record; raw: plain "
              "doubles, for programs that draw",
          .value = "FORMAT",
          .choices = {"csv", "mat", "raw"}};
}

void write_records(const std::vector<Record>& records, const std::string& format,
                   const PrintUnits& units, const std::filesystem::path& folder) {
  if (format == "raw") {
    write_sample_columns(records, folder);
    return;
  }

  // The place among the records keeps names apart that files cannot tell apart.
  for (std::size_t k = 0; k < records.size(); ++k) {
    const std::filesystem::path file =
        folder / fmt::format("{:03}_{}.{}", k + 1, trace_name(records[k].name), format);
    if (format == "mat")
      save_mat(records[k], file);
    else
      save_csv(records[k], file, units);
  }
}

std::size_t write_traces(const std::vector<RecordResult>& results, DriveUnit drive_unit,
                         const std::string& format, const PrintUnits& units,
                         const std::filesystem::path& folder) {
  const std::vector<Record> records = traces(results, drive_unit);
  write_records(records, format, units, folder);
  return records.size();
}

}  // namespace dashpot::cli
