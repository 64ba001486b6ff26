#include "dashpot/record/record_file.h"

#include "dashpot/base/escape.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/record/mat_bytes.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

constexpr int kTimeDigits = 12, kDigits = 9;

}  // namespace

void save_csv(const Record& record, const fs::path& path, const PrintUnits& units) {
  std::string text = "time [s]";
  std::vector<double> factors;
  for (const Channel& channel : record.channels) {
    const PrintUnit unit = units.of(channel.unit);
    factors.push_back(unit.factor);
    text += ',' + csv_field(channel.name + " [" + unit.name + ']');
  }
  text += '\n';
  for (std::size_t k = 0; k < record.size(); ++k) {
    text += format_number(record.time[k], kTimeDigits);
    for (std::size_t c = 0; c < factors.size(); ++c)
      text += ',' + format_number(factors[c] * record.channels[c].samples[k], kDigits);
    text += '\n';
  }
  write_file(path, text);
}

void save_mat(const Record& record, const fs::path& path) {
  std::vector<MatVariable> variables{
      {.name = "time", .rows = record.size(), .columns = 1, .values = record.time}};
  std::string units = "time s";
  for (const Channel& channel : record.channels) {
    variables.push_back(
        {.name = channel.name, .rows = record.size(), .columns = 1, .values = channel.samples});
    units += "; " + channel.name + ' ' + channel.unit;
  }
  variables.push_back({.name = "units", .text = units, .is_text = true});
  write_file(path, mat_bytes(variables));
}

}  // namespace dashpot
