#include "dashpot/machine/build_in_plant.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/family/build_law.h"
#include "dashpot/damper/kinds/family/physics_family.h"
#include "dashpot/error.h"
#include "dashpot/identify/fit/parameter_choice.h"
#include "dashpot/machine/found_noise.h"
#include "dashpot/machine/in_plant.h"
#include "dashpot/machine/model_in_plant.h"
#include "dashpot/machine/recording_parts.h"

namespace dashpot {
namespace {

/// The options with the coil's lag as the drawing has it, with one start, since all builds begin at
/// the mean one, and with this build held.
InPlantOptions options_for(const FamilyModel& member, const Law& law,
                           const std::optional<BuildLaw::Numbers>& held, InPlantOptions options) {
  const auto hold = [&](std::string_view name, double value) {
    options.choices.push_back({.law = {}, .parameter = std::string(name), .fixed = value});
  };
  const double lag = member.member().lag_rate;
  hold(kLagParameter.name,
       lag > 0 ? std::clamp(lag, kLagParameter.lower, kLagParameter.upper) : kLagParameter.upper);
  for (std::size_t k = 0; held && k < held->size(); ++k) hold(law.params[k].name, (*held)[k]);
  options.starts = 1;
  return options;
}

/// What the drive alone does not tell of a build, in words.
std::vector<std::string> untold(const InPlantReport& free, const BuildLaw::Numbers& spread) {
  constexpr double kInterval = 1.96;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < spread.size(); ++k) {
    const FittedParameter& p = free.damper[k];
    if (!(p.high - p.low < 2 * kInterval * spread[k])) names.push_back(p.name);
  }
  if (names.size() == spread.size())
    return {"the drive says nothing of this build: what was found is no better than the mean one"};
  std::vector<std::string> words;
  if (!names.empty())
    words.push_back("the drive tells " + join(names, " and ") +
                    " no better than the family does: there the build is as other builds are, "
                    "beside what the drive tells");
  return words;
}

/// The largest share of a sensor's rms that is left on the time held back.
double worst_held_back(const InPlantReport& report) {
  double worst = 0;
  for (const SensorFigures& s : report.sensors) worst = std::max(worst, s.held_back / s.rms);
  return worst;
}

}  // namespace

void require_build_for_plant(const FamilyModel& member, const InPlantSetup& setup,
                             const std::string& where) {
  require_builds(member);
  if (unmeasured_road(setup))
    throw Error(where, "a build is found on a road that is measured alone",
                "a channel with the road's height");
  require_one_damper(setup, "what finds a build");
  if (setup.drive_unit == DriveUnit::Volt)
    throw Error(where, "drives the damper by V, and families are of dampers that take A",
                "'current' of the plant");
}

BuildInPlant identify_build_in_plant(const FamilyModel& member, const InPlantSetup& setup,
                                     const std::vector<PlantRecording>& as_recorded,
                                     const InPlantOptions& options) {
  require_setup(setup);
  require_build_for_plant(member, setup, "plant");
  const std::vector<PlantRecording> recordings = moving_parts(setup, as_recorded);
  const BuildLaw builds(member);
  const auto identify = [&](const std::optional<BuildLaw::Numbers>& held, const char* what) {
    options.monitor.report(what, 0);
    return identify_in_plant(builds.law(), setup, recordings,
                             options_for(member, builds.law(), held, options));
  };

  // The plant beside the mean build, and beside any.
  BuildInPlant result;
  result.mean = identify(BuildLaw::Numbers{}, "the mean build");
  result.free = identify({}, "any build");
  if (result.mean.has_models())
    result.mean.kinds.front().model = std::make_shared<FamilyModel>(member);
  if (!result.free.has_models()) return result;

  // The build that the sensors tell, and the plant beside it.
  result.records = bench_records_along(result.free, setup, recordings, options);
  result.build = measure_build(member, result.records, setup.drive_unit, ForceZero::Anywhere);
  const auto& force = static_cast<const PhysicsFamily&>(*result.build.model->family().force);
  const FamilyPhysics::Deviation& deviation = force.physics().deviation;
  result.found = identify(builds.numbers_of(deviation), "this build");
  result.found.noise = found_noise(setup, result.found);
  if (result.found.has_models()) result.found.kinds.front().model = result.build.model;
  result.free.kinds.clear();  // it would outlive its law

  // What the drive alone tells of it, and what it does not.
  result.found.damper = result.free.damper;
  for (FittedParameter& p : result.found.damper) p.meaning = "ln, by the drive alone";
  std::ranges::move(untold(result.free, builds.spreads()),
                    std::back_inserter(result.found.warnings));
  if (worst_held_back(result.found) > worst_held_back(result.mean))
    result.found.warnings.push_back(
        "on the time held back it leaves more at the sensors than the mean build of the drawing");
  return result;
}

}  // namespace dashpot
