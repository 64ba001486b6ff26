#include "dashpot/identify/judge/left_out_parts.h"

namespace dashpot {

std::vector<LeftOutPart> left_out_parts(const std::vector<RecordResult>& left_out) {
  if (left_out.empty()) return {};
  const std::size_t of_each = (kLeastUnits + left_out.size() - 1) / left_out.size();

  std::vector<LeftOutPart> parts;
  for (const RecordResult& record : left_out) {
    const std::size_t scored = record.measured.size() - record.warm_up;
    const auto begin_of = [&](std::size_t part) {
      return record.warm_up + (part * scored + of_each - 1) / of_each;
    };
    for (std::size_t part = 0; part < of_each; ++part)
      parts.push_back({&record, begin_of(part), begin_of(part + 1)});
  }
  return parts;
}

}  // namespace dashpot
