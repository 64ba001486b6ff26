#include "export_control.h"

#include <algorithm>
#include <array>
#include <memory>

#include "console.h"
#include "dashpot/damper/inverse/registry.h"
#include "dashpot/export/c/c_inverse.h"
#include "dashpot/export/c/c_source.h"
#include "dashpot/identify/judge/track.h"

namespace dashpot::cli {
namespace {

constexpr double kUsualStep = 1e-3;  // s

double sample_time(const ExportOptions& options) {
  return options.sample_time > 0 ? options.sample_time : kUsualStep;
}

}  // namespace

std::vector<Option> control_options(VehicleChoice& choice) {
  // These options belong to a ride, not to a controller; the sample time is the export's.
  constexpr std::array kOthers{"--current", "--sample-time", "--delay", "--seed"};
  std::vector<Option> options = controlled_vehicle_options(choice);
  std::erase_if(options, [&](const Option& option) {
    return std::ranges::find(kOthers, option.names) != kOthers.end();
  });
  for (Option& option : options) {
    if (option.names == "--controller") option.default_text = "none: the damper is exported";
    if (option.names == "--plant")
      option.help = "with --controller, its vehicle or building (see 'simulate')";
    if (option.names == "--damper") option.help += "; with --controller";
  }
  return options;
}

CBlockMaker controller_block(VehicleChoice choice, const DamperChoice& damper,
                             const ExportOptions& options, Console& console) {
  if (choice.damper.empty())
    choice.damper = damper.model.empty() ? damper.parameters : damper.model;
  else if (damper.is_made())
    throw UsageError("--damper", "there is another damper before it", "name one");

  // What is known against the vehicle holds for its controller too.
  choice.sample_time = 1000 * sample_time(options);
  auto vehicle = std::make_shared<const Vehicle>(make_vehicle(words_of(choice)));
  for (const std::string& note : vehicle->notes) console.note(note);
  for (const std::string& warning : vehicle->warnings) console.warn(warning);
  return dashpot::controller_block(vehicle);
}

CBlockMaker scheme_block(const VehicleChoice& choice, DamperChoice damper,
                         const ExportOptions& options, Console& console) {
  // The coil's limits were read as the vehicle's; here they belong to the damper.
  damper.current_max = choice.current_max;
  damper.lag_rate = choice.lag_rate;
  ModelFile file = load_damper_file(damper, "export", console);
  const ExportedModel known = exported_model(file);
  const std::string origin = damper_origin(known);
  if (const std::string text =
          beyond_known_text(damper.current_max, known.domain.current_max, known.drive_unit);
      !text.empty())
    console.note(text);
  const auto loaded = std::make_shared<const Damper>(damper_of(std::move(file), damper));
  const InverseLimits limits = limits_of(driver_of(*loaded, damper), sample_time(options));

  // The inverse refers to the damper, so the maker keeps both alive.
  const std::shared_ptr<const InverseModel> inverse =
      find_inverse(choice.inverse, "--inverse").make(*loaded->model, limits);

  return [loaded, inverse, limits, origin](const ExportOptions& own) {
    return c_inverse_block(
        {.model = *inverse,
         .title = "the inverse '" + inverse->name() + "' of " + loaded->name,
         .drive_unit = loaded->drive_unit,
         .domain = loaded->domain.value_or(usual_domain(limits.current_min, limits.current_max)),
         .origin = origin},
        own);
  };
}

}  // namespace dashpot::cli
