#include "member_in_plant.h"

#include <utility>

#include "console.h"
#include "dashpot/dataset.h"
#include "dashpot/error.h"
#include "dashpot/identify/judge/extrapolation.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/observe.h"
#include "dashpot/machine/recording_parts.h"
#include "in_plant_document.h"

namespace dashpot::cli {
namespace {

/// Whether a file is a recording of a bench: it has a force and the damper's motion.
bool is_of_bench(const std::string& file) {
  try {
    return !load_dataset({file}).records.empty();
  } catch (const Error&) {
    return false;
  }
}

PlantRecording read_drive(const std::string& file, const InPlantSetup& setup) {
  try {
    return read_plant_recording(file, setup.channels());
  } catch (const Error& error) {
    if (!is_of_bench(file)) throw;
    throw Error(file,
                std::string("is a recording of a bench, not of the plant (") + error.what() + ")",
                "recordings of the plant, or leave --in out");
  }
}

}  // namespace

MemberInPlant build_from_drive(const FamilyModel& member, const ModelFile& family,
                               const MemberInPlantSettings& settings, Console& console) {
  // All that can be wrong is found before the work.
  const InPlantSetup setup = read_in_plant_setup(settings.plant);
  require_plant_drive(setup, family, settings.model);
  require_build_for_plant(member, setup, settings.plant);
  std::vector<PlantRecording> recordings;
  for (const std::string& file : settings.recordings) recordings.push_back(read_drive(file, setup));
  if (const std::string note = without_units(recordings); !note.empty()) console.note(note);

  MemberInPlant made{.build = identify_build_in_plant(member, setup, recordings,
                                                      {.grade = "", .monitor = console.monitor()}),
                     .document = {}};

  // What came out of it: the build first, the mean build of its drawing beside it.
  BuildInPlant& build = made.build;
  const std::vector<InPlantFit> fits{{.model = "this build", .report = build.found},
                                     {.model = "the drawing's mean build", .report = build.mean}};
  made.document = in_plant_document(fits, std::span(fits).first(1), still_parts(setup, recordings),
                                    setup, console);
  for (const std::string& warning : build.found.warnings) console.warn("this build: " + warning);
  Dataset motions;
  motions.drive_unit = setup.drive_unit;
  motions.records = build.records;
  for (const Extrapolation& beyond : extrapolations(family, motions))
    console.warn(describe(beyond));
  return made;
}

}  // namespace dashpot::cli
