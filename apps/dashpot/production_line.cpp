#include "production_line.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string_view>

#include <fmt/core.h>

#include "console.h"
#include "dashpot/base/file.h"
#include "dashpot/base/parallel.h"
#include "dashpot/base/random.h"
#include "dashpot/base/text.h"
#include "dashpot/identify/search/search_space.h"

namespace dashpot::cli {
namespace {

namespace fs = std::filesystem;

/// What can be wrong with a damper of the line, and by how much.
enum class Fault { None, WeakCoil, Leak, Friction, GasLoss };
constexpr std::string_view kFaultNames[] = {"", "weak coil", "leak", "friction", "gas loss"};
constexpr double kCoil = 0.8;            // of the current does a field
constexpr double kLeak = 0.8;            // of the compression force is left
constexpr double kFriction = 0.06;       // of half the force span, beside the damper's own
constexpr double kFrictionSpeed = 5e-3;  // m/s, within which friction turns over
constexpr double kGas = 0.12;  // of half the force span, by which the rod is pushed out less

/// A damper like this one, as its parameters scatter and its coil works.
LawModel one_of(const LawModel& model, double scatter, double coil, Random& random) {
  Dependence parameters = model.parameters();
  for (std::size_t p = 0; p < parameters.forms.size(); ++p) {
    const double size = 1 + scatter * random.normal();
    const bool scatters = is_estimated(model.law().params[p].fit);
    std::vector<double>& c = parameters.coefficients[p];
    for (std::size_t k = 0; k < c.size(); ++k) {
      // The parameter at a part of the current: powers of it, or the rate of an exponential.
      const bool is_rate = parameters.forms[p] == Form::Exponential && k == 2;
      if (is_polynomial(parameters.forms[p]))
        c[k] *= std::pow(coil, static_cast<double>(k));
      else if (is_rate)
        c[k] *= coil;
      if (scatters && !is_rate) c[k] *= size;
    }
  }
  return {model.law(), std::move(parameters), model.drive_unit(), model.lag_rate()};
}

/// What the bench sees of a fault that is not in the coil, and of the line's trend.
void spoil(Record& record, Fault fault, double growth, double half_span) {
  const std::vector<double>& velocity = record.channel("velocity").samples;
  std::vector<double>& force = record.find("force")->samples;
  for (std::size_t k = 0; k < force.size(); ++k) {
    force[k] *= growth;
    if (fault == Fault::Leak && velocity[k] < 0) force[k] *= kLeak;
    if (fault == Fault::Friction)
      force[k] += kFriction * half_span * std::tanh(velocity[k] / kFrictionSpeed);
    if (fault == Fault::GasLoss) force[k] += kGas * half_span;
  }
}

double half_force_span(const Dataset& campaign) {
  double low = INFINITY, high = -INFINITY;
  for (const Record& record : campaign.records)
    for (const double force : record.channel("force").samples)
      low = std::min(low, force), high = std::max(high, force);
  return (high - low) / 2;
}

}  // namespace

std::vector<Option> line_options(LineSettings& settings) {
  return {
      {.names = "--dampers",
       .target = &settings.dampers,
       .help = "record a production line of so many dampers, each in a folder of its own, that "
               "scatter about this one; faults.csv names the faulty ones",
       .value = "N",
       .minimum = 1,
       .default_text = "this damper alone"},
      {.names = "--faults",
       .target = &settings.faults,
       .help = "share of the line's dampers with a weak coil, a leak, friction or a loss of gas",
       .value = "SHARE",
       .minimum = 0,
       .needs = "--dampers"},
      {.names = "--trend",
       .target = &settings.trend,
       .help = "share by which forces grow from the first damper of the line to the last",
       .value = "SHARE",
       .minimum = 0,
       .needs = "--dampers"}};
}

int record_line(const LineSettings& line, const CampaignSettings& campaign, const fs::path& folder,
                Console& console) {
  const ParameterSet damper = load_parameter_set(campaign.damper);
  const double half_span = half_force_span(run_campaign(campaign, damper));
  const Monitor monitor = console.monitor();

  // Each damper has random numbers of its own, so that their order does not matter.
  std::vector<Fault> faults(line.dampers, Fault::None);
  std::atomic<std::size_t> done = 0;
  parallel_for(line.dampers, 0, [&](std::size_t k) {
    monitor.report("recording", static_cast<double>(done++) / static_cast<double>(line.dampers));
    Random random(seed_for(campaign.bench.seed, "damper " + std::to_string(k)));
    const bool is_faulty = random.uniform() < line.faults;
    const std::size_t which = 1 + random.index(std::size(kFaultNames) - 1);
    if (is_faulty) faults[k] = static_cast<Fault>(which);

    // The damper as it is built, on the bench as it is set up that time.
    ParameterSet built = damper;
    built.model =
        one_of(damper.model, line.scatter, faults[k] == Fault::WeakCoil ? kCoil : 1, random);
    CampaignSettings settings = campaign;
    settings.bench.seed = random.next();
    Dataset recorded = run_campaign(settings, built);
    const double growth =
        1 + line.trend * static_cast<double>(k) / static_cast<double>(line.dampers);
    for (Record& record : recorded.records) spoil(record, faults[k], growth, half_span);
    write_campaign(recorded, built, folder / fmt::format("unit-{:06}", k + 1),
                   console.command_line(), campaign.units);
  });

  // The truth that nobody has of a real line.
  std::string text = "damper,fault\n";
  std::size_t faulty = 0;
  for (std::size_t k = 0; k < faults.size(); ++k) {
    if (faults[k] == Fault::None) continue;
    ++faulty;
    text += fmt::format("unit-{:06},{}\n", k + 1, kFaultNames[static_cast<std::size_t>(faults[k])]);
  }
  write_file(folder / "faults.csv", text);
  console.print(
      fmt::format("{}, {} of them faulty\n\nDampers  {}/unit-*/\nFaults   {}\n"
                  "Next     dashpot identify-many {}\n",
                  counted(faults.size(), "damper"), faulty, folder.string(),
                  (folder / "faults.csv").string(), shell_quoted(folder.string())));
  if (console.json)
    console.print_json(Value::object(
        {{"folder", folder.string()}, {"dampers", faults.size()}, {"faulty", faulty}}));
  return kDone;
}

}  // namespace dashpot::cli
