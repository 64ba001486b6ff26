#include "dashpot/machine/bench_start.h"

#include <algorithm>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/identify.h"
#include "dashpot/machine/damper_drive.h"
#include "dashpot/machine/plant_start.h"

namespace dashpot {
namespace {

/// A dashpot in the damper's place.
LawModel dashpot_model(double damping) {
  const Law& law = find_law("tanh_kwok");
  std::vector<double> parameters(law.params.size(), 0.0);
  parameters[law.index_of("c")] = damping;
  parameters[law.index_of("beta")] = 1;
  return LawModel::constant(law, parameters);
}

/// strut: of several that in which the damper stands.
Record as_bench_record(const InPlantSetup& setup, const PlantRecording& recording,
                       const ObservedRecording& observed, const DamperQuantities& damper,
                       const DamperDrive& drive, const std::string& strut) {
  const std::string name = recording.name + (strut.empty() ? "" : ", " + strut);
  Record record{.name = name, .source = recording.name, .condition = name};
  record.sample_time = recording.sample_time;
  for (std::size_t k = 0; k < recording.samples; ++k)
    record.time.push_back(recording.sample_time * static_cast<double>(k));

  // What was observed, then the drive.
  for (const auto& [channel, place] : {std::pair{"force", damper.force},
                                       {"displacement", damper.deflection},
                                       {"velocity", damper.velocity}})
    record.channels.push_back({.name = channel,
                               .unit = observed.quantities[place].unit,
                               .samples = observed.quantities[place].value,
                               .origin = "observed"});
  if (setup.drive_unit != DriveUnit::None) {
    record.channels.push_back({.name = setup.drive_unit == DriveUnit::Volt ? "voltage" : "current",
                               .unit = to_string(setup.drive_unit),
                               .samples = drive_samples(drive, recording),
                               .origin = "as recorded"});
    const auto [low, high] = std::ranges::minmax(record.channels.back().samples);
    if (low == high) record.drive_level = low;
  }
  record.warm_up = static_cast<std::size_t>(kFilterSettles / recording.sample_time);
  return record;
}

}  // namespace

std::vector<Record> as_bench_records(const InPlantSetup& setup,
                                     const std::vector<PlantRecording>& fitted,
                                     const ObserveReport& observed) {
  std::vector<Record> records;
  const std::size_t dampers = observed.struts.size();
  for (std::size_t r = 0; r < fitted.size(); ++r)
    for (std::size_t d = 0; d < dampers; ++d)
      records.push_back(as_bench_record(setup, fitted[r], observed.recordings[r],
                                        damper_quantities(d, dampers), setup.drive_of(d),
                                        dampers > 1 ? observed.struts[d] : ""));
  return records;
}

std::vector<std::vector<DamperInput>> observed_motions(const InPlantSetup& setup,
                                                       const PlantRecording& recording,
                                                       const ObservedRecording& observed) {
  const std::size_t dampers = setup.dampers();
  std::vector<std::vector<DamperInput>> motions(dampers);
  for (std::size_t d = 0; d < dampers; ++d) {
    const auto [force, deflection, velocity] = damper_quantities(d, dampers);
    const std::vector<double> drive = drive_samples(setup.drive_of(d), recording);
    for (std::size_t k = 0; k < recording.samples; ++k)
      motions[d].push_back({observed.quantities[deflection].value[k],
                            observed.quantities[velocity].value[k], drive[k]});
  }
  return motions;
}

ObserveReport observe_without_law(InPlantSetup setup, const std::vector<double>& plant,
                                  const std::vector<PlantRecording>& fitted,
                                  const InPlantOptions& options) {
  // Nothing of the plant and its sensors is sought.
  for (std::size_t k = 0; k < plant.size(); ++k)
    setup.known.emplace_back(setup.unknown[k].name, plant[k]);
  setup.unknown.clear();
  for (PlantSensor& sensor : setup.sensors) {
    sensor.finds_delay = false;
    sensor.finds_cutoff.reset();
  }

  // A dashpot as usual stands for the damper, and errors of its force for all else.
  std::vector<PlantInputPlace> inputs;
  for (const PlantInputChannel& input : setup.inputs) inputs.push_back(input.place);
  const DrivenPlant equations(make_plant(*setup.model, setup.known), inputs);
  const auto dashpot = std::make_shared<LawModel>(dashpot_model(usual_dashpot(equations)));
  const Domain domain = usual_domain(0, 0);
  const double force = observer_scale(*dashpot, domain).force;
  return observe(dashpot, domain, setup, fitted,
                 {.force = {{force, 0.02}, {force, 0.3}},
                  .steps = 1,
                  .threads = options.threads,
                  .monitor = {.on_progress = {}, .stop = options.monitor.stop},
                  .is_straight = true,
                  .seeks_faults = false});
}

ObserveReport observe_beside_force(InPlantSetup setup, std::vector<PlantRecording> fitted,
                                   const std::vector<InPlantTrace>& along,
                                   const InPlantOptions& options) {
  std::vector<PlantInputPlace> inputs;
  for (const PlantInputChannel& input : setup.inputs) inputs.push_back(input.place);
  const Plant plant = make_plant(*setup.model, setup.known);
  const double damping = usual_dashpot(DrivenPlant(plant, inputs));
  const std::size_t dampers = plant.struts.size();

  // The models' forces without those of the dashpots that stand in their place.
  std::vector<std::vector<std::vector<double>>> force(fitted.size());  // of each damper
  for (std::size_t r = 0; r < fitted.size(); ++r)
    for (const DamperTrace& trace : along[r].dampers) {
      const auto first = static_cast<std::size_t>(setup.skip / fitted[r].sample_time);
      force[r].emplace_back();
      for (std::size_t k = first; k < first + fitted[r].samples; ++k)
        force[r].back().push_back(trace.force[k] - damping * trace.velocity[k]);
    }

  // Together they push each coordinate as a measured input does.
  for (std::size_t i = 0; i < plant.coordinates.size(); ++i) {
    const auto is_pushed = [i](const Strut& strut) { return strut.row[i] != 0; };
    if (std::ranges::none_of(plant.struts, is_pushed)) continue;
    const std::string channel = "force of models on " + plant.coordinates[i].name;
    setup.inputs.push_back({channel, {PlantInput::Force, i}});
    for (std::size_t r = 0; r < fitted.size(); ++r) {
      std::vector<double> pushes(fitted[r].samples);
      for (std::size_t d = 0; d < dampers; ++d)
        for (std::size_t k = 0; k < pushes.size(); ++k)
          pushes[k] -= plant.struts[d].row[i] * force[r][d][k];
      fitted[r].channels.push_back(
          {.name = channel, .unit = "", .samples = std::move(pushes), .origin = "modelled"});
    }
  }

  // What is told then lacks it.
  const auto dashpot = std::make_shared<LawModel>(dashpot_model(damping));
  Domain domain = usual_domain(0, 0);
  ObserveReport observed = observe(dashpot, domain, setup, fitted,
                                   {.force = {},
                                    .steps = 1,
                                    .threads = options.threads,
                                    .monitor = {.on_progress = {}, .stop = options.monitor.stop},
                                    .is_straight = true,
                                    .seeks_faults = false});
  for (std::size_t r = 0; r < fitted.size(); ++r)
    for (std::size_t d = 0; d < dampers; ++d) {
      std::vector<double>& told =
          observed.recordings[r].quantities[damper_quantities(d, dampers).force].value;
      for (std::size_t k = 0; k < told.size(); ++k) told[k] += force[r][d][k];
    }
  return observed;
}

std::shared_ptr<const DamperModel> fit_as_on_bench(const Law& law, const InPlantSetup& setup,
                                                   const std::vector<Record>& records,
                                                   const InPlantOptions& options) {
  if (!is_law(law.name)) return nullptr;
  const FitReport fit = identify(std::string(law.name), records, setup.drive_unit,
                                 {.choices = options.choices,
                                  .allow_active = true,
                                  .asymmetric = options.asymmetric,
                                  .seed = options.seed,
                                  .threads = options.threads,
                                  .monitor = {.on_progress = {}, .stop = options.monitor.stop}});
  return fit.model && fit.model->law_inside() ? fit.model : nullptr;
}

}  // namespace dashpot
