#include "dashpot/record/what_varies.h"

namespace dashpot {

std::vector<std::string> conditions(const Dataset& dataset) {
  std::vector<std::string> all;
  for (const Record& record : dataset.records) add_new(all, record.condition);
  return all;
}

std::vector<double> levels(const Dataset& dataset) {
  std::vector<double> all;
  for (const Record& record : dataset.records)
    if (record.drive_level) add_new(all, *record.drive_level);
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace dashpot
