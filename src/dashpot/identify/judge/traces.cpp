#include "dashpot/identify/judge/traces.h"

namespace dashpot {

std::vector<Record> traces(const std::vector<RecordResult>& results, DriveUnit drive_unit) {
  std::vector<Record> records;
  for (const RecordResult& r : results) {
    if (r.time.empty()) continue;
    Record& trace = records.emplace_back();
    trace.name = r.record;
    trace.condition = r.condition;
    trace.time = r.time;
    trace.drive_level = r.drive_level;
    trace.warm_up = r.warm_up;

    // What a record lacks is left out.
    const auto add = [&](const std::string& name, const std::string& unit,
                         std::vector<double> samples) {
      if (samples.size() == r.time.size())
        trace.channels.push_back({name, unit, std::move(samples), ""});
    };
    add("displacement", "m", r.displacement);
    add("velocity", "m/s", r.velocity);
    add(drive_channel(drive_unit), unit_of(drive_unit), r.drive);
    add("measured", "N", r.measured);
    add("modelled", "N", r.modelled);
    std::vector<double> residual;
    for (std::size_t i = 0; i < r.measured.size(); ++i)
      residual.push_back(r.measured[i] - r.modelled[i]);
    add("residual", "N", std::move(residual));
  }
  return records;
}

}  // namespace dashpot
