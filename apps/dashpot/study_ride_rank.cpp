#include <memory>

#include "console.h"
#include "dashpot/base/text.h"
#include "dashpot/identify/rank/fit_store.h"
#include "results.h"
#include "studies.h"
#include "studies/ride_rank/ride_rank_document.h"
#include "study_results.h"
#include "vehicle_options.h"

namespace dashpot::cli {
namespace {

struct StudyRideRankSettings {
  StudyResults results = {.folder = "dashpot-ride-rank"};
  RideRankStudyOptions options;
  std::string roads = join(RideRankStudyOptions{}.roads, ";"),
              controllers = join(RideRankStudyOptions{}.controllers, ";");
};

constexpr std::string_view kStudyRideRankExample =
    "# Eleven dampers, four roads, three controllers:\n"
    "dashpot study ride-rank --output ride-rank\n"
    "\n"
    "# One damper in one ride, quickly:\n"
    "dashpot study ride-rank --truths asymmetric_valves --models bingham,tanh_kwok,viscous_dahl "
    "\\\n"
    "    --roads iso8608,class=C --controllers skyhook";

int run_study_ride_rank(const StudyRideRankSettings& settings, Console& console) {
  prepare_study(settings.results);
  RideRankStudyOptions options = settings.options;
  options.roads = words_between(settings.roads);
  options.controllers = words_between(settings.controllers);
  options.monitor = console.monitor();
  std::unique_ptr<FitStore> store;
  if (!settings.results.fresh) store = kept_fits(settings.results.folder, console);
  const std::vector<RideRankCase> cases = study_ride_rank(options, store.get());
  write_study(ride_rank_document(cases, options), ride_rank_json(cases), settings.results, console);
  return kDone;
}

}  // namespace

Command ride_rank_study() {
  auto settings = std::make_shared<StudyRideRankSettings>();
  RideRankStudyOptions& options = settings->options;
  Command command{
      .name = "study ride-rank",
      .title = "Does the error that 'rank --plant' predicts tell the true one?",
      .description =
          "Records dampers that are built otherwise than any model (series springs, lopsided "
          "valves, friction, lag, gas, fading) on the virtual bench, ranks models as 'rank "
          "--plant' does, and then rides the true damper, which no user can. Says how well the "
          "predicted order of the models tells that of their true errors, and how well ESR does.",
      .options = {{.names = "--truths",
                   .target = &options.truths,
                   .help = "the true dampers, separated by commas, as the page names them",
                   .value = "NAMES",
                   .default_text = "all"},
                  {.names = "--models",
                   .target = &options.models,
                   .help = "the models that are ranked",
                   .value = "NAMES"},
                  {.names = "--plant",
                   .target = &options.plant,
                   .help = "the vehicle (dashpot ride --list plants)",
                   .value = "NAME"},

                  // Every road is driven under every controller.
                  {.names = "--roads",
                   .target = &settings->roads,
                   .help = "roads with their settings, ';' between",
                   .value = "LIST"},
                  {.names = "--controllers",
                   .target = &settings->controllers,
                   .help = "control laws, ';' between; none: 1 A throughout",
                   .value = "LIST"},
                  {.names = "--duration",
                   .target = &options.duration,
                   .help = "duration of each ride, s",
                   .value = "S",
                   .minimum = 1},
                  {.names = "--draws",
                   .target = &options.draws,
                   .help = "dampers that the recordings allow, beside which models are ridden",
                   .value = "N",
                   .minimum = 2},
                  seed_option(options.seed),
                  threads_option(options.threads)},
      .example = std::string(kStudyRideRankExample),
      .run = [settings](Console& console) { return run_study_ride_rank(*settings, console); }};
  append(command.options, study_result_options(settings->results, "fits"));
  return command;
}

}  // namespace dashpot::cli
