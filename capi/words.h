#pragma once
#include <optional>
#include <string>

#include "dashpot/export.h"
#include "dashpot/identify/fit/fit_words.h"
#include "dashpot/machine/evaluate_in_plant.h"
#include "dashpot/machine/observe.h"
#include "dashpot/machine/watch.h"
#include "dashpot/vehicle.h"

namespace dashpot::capi {

/// The options of dashpot_fit and dashpot_identify.
struct FitOptions {
  FitWords words;
  std::optional<LeaveOut> leave_out;
  bool keep_inertia = false;
  std::string command;
};
/// Throws Error naming the key on anything unknown. Null stands for {}.
FitOptions read_fit_options(const char* text);

LoadOptions read_load_options(const char* text);
/// How recordings are looked at without a fit.
struct LookOptions {
  std::vector<double> speeds;  ///< m/s
  std::string format = "json", command;
};
LookOptions read_look_options(const char* text);

/// The options of dashpot_evaluate and dashpot_traces.
struct EvaluateWords {
  EvaluateOptions options;
  bool keep_inertia = false;
};
EvaluateWords read_evaluate_options(const char* text);

/// The options of dashpot_export.
struct ExportWords {
  std::vector<std::string> formats;
  std::string folder = "dashpot-export";
  ExportOptions options;
};
ExportWords read_export_options(const char* text);

/// The options of dashpot_simulate.
struct DriveOptions {
  VehicleWords vehicle;
  std::string road = "iso8608,class=C";
  double duration = 0;     ///< s; 0: the road's, kUsualDuration at most
  double output_step = 0;  ///< s; 0: as simulate() has it
  std::uint64_t seed = 1;
};
DriveOptions read_drive_options(const char* text);

/// The options of dashpot_identify_in_plant: the words of a fit, and what a plant has beside them.
struct InPlantWords {
  FitOptions fit;
  std::string grade;
  std::vector<std::string> profiles;
};
InPlantWords read_in_plant_options(const char* text);
ObserveOptions read_observe_options(const char* text);
PlantEvaluationOptions read_plant_evaluation_options(const char* text);

/// The options of dashpot_watch.
struct WatchWords {
  WatchOptions options;
  std::optional<Value> state;  ///< of an earlier report
};
WatchWords read_watch_options(const char* text);

/// {"gap": 0.001}
std::vector<std::pair<std::string, double>> read_conditions(const char* text);

}  // namespace dashpot::capi
