#include "dashpot/report/compare.h"

#include <cmath>
#include <numbers>

#include "dashpot/damper/virtual_bench.h"
#include "dashpot/error.h"
#include "dashpot/identify/judge/extrapolation.h"
#include "dashpot/rank.h"

namespace dashpot {
namespace {

/// Sines for models that are compared without recordings: the stroke of the first one's data, at
/// speeds up to its greatest, at the least, the middle and the greatest drive of its data.
Dataset sines_for(const ModelFile& file) {
  constexpr int kSpeeds = 12;
  constexpr double kSlowest = 0.02;
  const Domain& d = file.domain;
  const double amplitude = (d.displacement_max - d.displacement_min) / 2,
               fastest = std::max(std::abs(d.velocity_min), std::abs(d.velocity_max));
  if (!(amplitude > 0 && std::isfinite(amplitude) && fastest > 0 && std::isfinite(fastest)))
    throw Error("compare", "the first model does not say which motion it is for",
                "recordings before it, which it is then run over");

  // A bench without noise, at the drives of the data.
  BenchOptions bench{.motions = {},
                     .drive_levels = {d.current_min},
                     .force_noise = 0,
                     .displacement_noise = 0,
                     .velocity_sensor = true,
                     .force_resolution = 0,
                     .displacement_resolution = 0,
                     .force_offset = 0};
  if (d.current_max > d.current_min) {
    bench.drive_levels.push_back((d.current_min + d.current_max) / 2);
    bench.drive_levels.push_back(d.current_max);
  }

  // The amplitude stays, the frequency gives the speed.
  for (int k = 0; k < kSpeeds; ++k) {
    const double speed = fastest * std::pow(kSlowest, 1 - k / (kSpeeds - 1.0));
    bench.motions.push_back({amplitude, speed / (2 * std::numbers::pi * amplitude)});
  }

  bench.sample_rate = std::max(500.0, 200 * bench.motions.back().frequency);
  Dataset dataset = run_virtual_bench(*file.model, file.drive_unit, bench);
  dataset.name = "sines";
  return dataset;
}

/// The recordings with a model's force in place of the measured one.
ComparedThing run_model(const std::string& name, const ModelFile& file, const Dataset& dataset,
                        bool is_measured, int threads) {
  require_same_drive(file, dataset, name);

  // Recordings have an offset of the load cell each; sines of the bench have none.
  ComparedThing thing{.name = name, .dataset = dataset, .is_model = true};
  thing.beyond = extrapolations(file, dataset);
  Evaluation evaluation = evaluate(*file.model, dataset.records, dataset.drive_unit,
                                   {.offset = is_measured ? OffsetMode::Record : OffsetMode::None,
                                    .known_offsets = {},
                                    .threads = threads});

  for (std::size_t r = 0; r < dataset.records.size(); ++r) {
    Record& record = thing.dataset.records[r];
    const RecordResult& result = evaluation.records[r];
    if (result.diverged_at)
      throw Error(name, "diverged on record '" + result.record + "' and cannot be compared",
                  "a model that stays finite; dashpot physics shows where it does not");
    record.find("force")->samples = result.modelled;
  }

  if (is_measured) {
    thing.seen = seen_records(file.provenance, dataset);
    thing.evaluation = std::move(evaluation);
  }
  return thing;
}

}  // namespace

std::vector<ComparedThing> compared_things(const std::vector<ThingToCompare>& things,
                                           const std::vector<double>& speeds, int threads,
                                           const std::function<void()>& check) {
  if (things.size() < 2)
    throw Error("compare", "one thing cannot be compared", "two or more models and recordings");

  // Models follow the first recordings, and all have the same drive.
  const Dataset* motion = nullptr;
  for (const ThingToCompare& thing : things) {
    if (!thing.dataset) continue;
    if (!motion) motion = thing.dataset;
    if (thing.dataset->drive_unit != motion->drive_unit)
      throw Error(thing.name,
                  "is driven in " + name_of(thing.dataset->drive_unit) + ", the others in " +
                      name_of(motion->drive_unit),
                  "recordings with the same drive");
  }
  Dataset sines;
  const bool is_measured = motion != nullptr;
  if (!motion) {
    sines = sines_for(*things.front().model);
    motion = &sines;
  }

  // Then all are looked at alike.
  std::vector<ComparedThing> compared;
  for (const ThingToCompare& thing : things) {
    compared.push_back(thing.model
                           ? run_model(thing.name, *thing.model, *motion, is_measured, threads)
                           : ComparedThing{.name = thing.name, .dataset = *thing.dataset});
    compared.back().figures = characterise(compared.back().dataset, {speeds});
    if (check) check();
  }
  return compared;
}

}  // namespace dashpot
