#include <algorithm>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/suspension/ground/ground_sequences.h"
#include "dashpot/suspension/ride/domain_use.h"
#include "dashpot/suspension/ride/ride_measures.h"
#include "dashpot/suspension/ride/simulated_run.h"
#include "handles.h"
#include "status.h"
#include "words.h"
#include "work.h"

using namespace dashpot;
using namespace dashpot::capi;

namespace {

constexpr double kUsualDuration = 20;  // s, as the command line has it

/// Those of `dashpot simulate`; none of a trace with steps of the caller's, which may be too wide
/// for them.
Value measures_of(const Trace& trace, const Vehicle& vehicle, const GroundMotion& ground,
                  const SimulateOptions& options) {
  Value list = Value::array();
  if (options.output_step > 0) return list;
  const double discard = usual_discard(ground, options.duration);
  for (const RideMeasure& m : ride_measures(vehicle, ground, trace, discard))
    list.push_back(Value::object({{"name", m.name}, {"unit", m.unit}, {"value", m.value}}));
  return list;
}

std::string report_text(const Trace& trace, const Vehicle& vehicle, const GroundMotion& ground,
                        const SimulateOptions& options) {
  // The damper's own warnings, the integrator's, and those of a damper that left its data's range.
  std::vector<std::string> warnings = vehicle.warnings;
  std::ranges::copy(trace.warnings, std::back_inserter(warnings));
  std::ranges::move(domain_warnings(domain_use(vehicle, trace), RunOptions{}.allowed_outside),
                    std::back_inserter(warnings));
  std::vector<std::string> notes = vehicle.notes;
  if (std::string note = road_end_note(ground, options.duration); !note.empty())
    notes.push_back(std::move(note));
  const Value report =
      Value::object({{"plant", vehicle.set.name},
                     {"dampers", Value::array(vehicle.damper_names)},
                     {"controller", vehicle.controller_name},
                     {"road", ground.description()},
                     {"diverged_at", trace.diverged_at ? Value(*trace.diverged_at) : Value()},
                     {"contact_lost", trace.contact_lost},
                     {"steps", trace.steps},
                     {"evaluations", trace.evaluations},
                     {"measures", measures_of(trace, vehicle, ground, options)},
                     {"notes", Value::array(notes)},
                     {"warnings", Value::array(warnings)}});

  return format_json(presentable(report));
}

void run(const DriveOptions& asked, const dashpot_monitor* monitor, dashpot_recordings** recordings,
         char** report) {
  // The vehicle, its ground and how long it is driven.
  const Vehicle vehicle = make_vehicle(asked.vehicle);
  const GroundPointer ground = make_ground(asked.road, asked.seed, "options, road");
  SimulateOptions options = vehicle.options(
      asked.duration > 0 ? asked.duration : std::min(ground->duration(), kUsualDuration));
  options.output_step = asked.output_step;

  // The work runs beside the caller's thread, which may cancel it.
  Trace trace;
  run_watched(monitor, [&](const Monitor& watched) {
    options.monitor = watched;
    trace = simulate(vehicle.on(*ground), options);
  });

  // The report is made before the trace gives up its record.
  const std::optional<double> diverged_at = trace.diverged_at;
  if (report) *report = copy_text(report_text(trace, vehicle, *ground, options));

  // The trace is handed over even when it diverged: it shows how.
  auto made = std::make_unique<dashpot_recordings>();
  made->dataset.name = "simulation";
  made->dataset.drive_unit = vehicle.drive_unit;
  made->dataset.records.push_back(std::move(trace.record));
  *recordings = made.release();

  if (diverged_at)
    throw NotUsable(vehicle.set.name, "diverged at t = " + format_number(*diverged_at) + " s");
}

}  // namespace

dashpot_status dashpot_simulate(const char* options, const dashpot_monitor* monitor,
                                dashpot_recordings** trace, char** report) {
  return guarded([&] {
    if (report) *report = nullptr;
    require(trace, "trace");
    *trace = nullptr;
    run(read_drive_options(options), monitor, trace, report);
  });
}
