#pragma once
#include <cmath>
#include <vector>

#include "dashpot/damper/nets/free_run_record.h"
#include "dashpot/damper_model.h"

namespace dashpot {

/// Records of `truth` under two-tone motions of three sizes, one each, at a current that is
/// switched; with an offset of -100, 0, 100 N. The first `warm_up` samples do not count.
inline std::vector<FreeRunRecord> measured(const DamperModel& truth, std::size_t samples,
                                           std::size_t warm_up) {
  std::vector<FreeRunRecord> records(3);
  for (std::size_t r = 0; r < records.size(); ++r) {
    FreeRunRecord& record = records[r];
    record.first = warm_up;
    std::vector<double> state(truth.state_size());
    for (std::size_t k = 0; k < samples; ++k) {
      const double t = 0.004 * static_cast<double>(k), size = 0.1 * static_cast<double>(r + 1);
      const DamperInput input{0, size * std::sin(12 * t) + 0.05 * std::sin(31 * t),
                              k / 40 % 2 ? 1.8 : 0.2};

      if (k == 0)
        truth.rest(input, state);
      else
        truth.advance(record.inputs.back(), input, t - record.time.back(), state);

      record.inputs.push_back(input);
      record.time.push_back(t);
      record.force.push_back(truth.force(input, state) + 100.0 * (static_cast<double>(r) - 1));
    }
  }
  return records;
}

inline std::vector<const FreeRunRecord*> all_of(const std::vector<FreeRunRecord>& records) {
  std::vector<const FreeRunRecord*> all;
  for (const FreeRunRecord& record : records) all.push_back(&record);
  return all;
}

}  // namespace dashpot
