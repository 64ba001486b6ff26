#include "dashpot/record/sample_columns.h"

#include <bit>

#include "dashpot/base/file.h"
#include "dashpot/value.h"

namespace dashpot {
namespace {

static_assert(std::endian::native == std::endian::little, "samples.f64 is little-endian");

/// Columns of doubles, one after the other.
struct Columns {
  std::string bytes;
  std::size_t count = 0;

  /// Where the column begins.
  std::size_t add(const std::vector<double>& samples) {
    const std::size_t at = count;
    bytes.append(reinterpret_cast<const char*>(samples.data()), samples.size() * sizeof(double));
    count += samples.size();
    return at;
  }
};

}  // namespace

void write_sample_columns(const std::vector<Record>& records, const std::filesystem::path& folder,
                          const Dataset* dataset) {
  // The columns of each record, time first.
  Columns all;
  Value list = Value::array();
  for (const Record& record : records) {
    Value columns = Value::array();
    columns.push_back(
        Value::object({{"name", "time"}, {"unit", "s"}, {"at", all.add(record.time)}}));
    for (const Channel& channel : record.channels)
      columns.push_back(Value::object({{"name", channel.name},
                                       {"unit", channel.unit},
                                       {"origin", channel.origin},
                                       {"at", all.add(channel.samples)}}));
    list.push_back(Value::object({{"name", record.name},
                                  {"source", record.source},
                                  {"samples", record.size()},
                                  {"columns", std::move(columns)}}));
  }

  // What speaks against files and records.
  Value unread = Value::array(), suspects = Value::array();
  if (dataset) {
    for (const PassedOver& file : dataset->unread)
      unread.push_back(Value::object({{"file", file.file}, {"why", file.why}}));
    for (const Suspect& suspect : dataset->suspects)
      suspects.push_back(Value::object({{"record", suspect.record}, {"why", suspect.why}}));
  }

  make_folder(folder);
  write_file(folder / "samples.f64", all.bytes);
  write_file(folder / "samples.json",
             format_json(Value::object({{"records", std::move(list)},
                                        {"unread", std::move(unread)},
                                        {"suspects", std::move(suspects)}})));
}

}  // namespace dashpot
