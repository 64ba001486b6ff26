#include "studies/family/family_samples.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <set>

#include <fmt/format.h>

#include "dashpot/base/random.h"
#include "dashpot/error.h"
#include "dashpot/record/cycles.h"

namespace dashpot {
namespace {

double condition_of(const Record& record, std::string_view name) {
  for (const auto& [known, value] : record.conditions)
    if (known == name) return value;
  throw Error(
      "record '" + record.name + "'", "has no condition '" + std::string(name) + "'",
      "geometry, fluid and field of a family of dampers, as the data set family-dnn states them");
}

void add_cycle(const Record& cycle, TrainingSamples& samples) {
  std::array<double, kFamilyInputs.size()> row{};
  for (std::size_t k = 0; k < kFamilyConditions; ++k)
    row[k] = condition_of(cycle, kFamilyInputs[k]);
  for (std::size_t i = 0; i < cycle.size(); ++i) {
    for (std::size_t k = kFamilyConditions; k < row.size(); ++k)
      row[k] = cycle.channel(kFamilyInputs[k]).samples[i];
    samples.inputs.insert(samples.inputs.end(), row.begin(), row.end());
  }
  const std::vector<double>& force = cycle.channel("force").samples;
  samples.targets.insert(samples.targets.end(), force.begin(), force.end());
}

/// The record from its start to the end of its cycle; only the cycle is scored.
Record run_up_to(const Record& record, const Record& cycle) {
  const auto first = static_cast<std::size_t>(
      std::ranges::lower_bound(record.time, cycle.time.front()) - record.time.begin());
  Record run = record.slice(0, first + cycle.size());
  run.warm_up = first;
  return run;
}

using NameOf = std::function<std::string(std::size_t cycle)>;

/// Indices of the samples of each group of cycles, in the order of their first cycles.
std::vector<FamilyDivision> groups(const FamilySamples& family, const NameOf& name_of) {
  std::vector<FamilyDivision> found;
  for (std::size_t c = 0; c < family.cycles.size(); ++c) {
    const std::string name = name_of(c);
    auto group = std::ranges::find(found, name, &FamilyDivision::name);
    if (group == found.end()) group = found.insert(found.end(), FamilyDivision{name, {}, {}});
    for (std::size_t s = family.first[c]; s < family.first[c + 1]; ++s) group->judged.push_back(s);
  }
  return found;
}

std::vector<FamilyDivision> left_out_in_turn(const FamilySamples& family, const NameOf& name_of) {
  std::vector<FamilyDivision> divisions = groups(family, name_of);
  if (divisions.size() < 2)
    throw Error("the family", "has one group of dampers only", "two or more");
  for (FamilyDivision& division : divisions) {
    std::vector<bool> is_judged(family.size());
    for (const std::size_t s : division.judged) is_judged[s] = true;
    for (std::size_t s = 0; s < family.size(); ++s)
      if (!is_judged[s]) division.training.push_back(s);
  }
  return divisions;
}

}  // namespace

double FamilySamples::condition(std::size_t cycle, std::string_view name) const {
  return condition_of(cycles[cycle], name);
}

FamilySamples family_samples(const Dataset& dataset) {
  FamilySamples family;
  family.drive_unit = dataset.drive_unit;
  for (const Record& record : dataset.records) {
    family.first.push_back(family.size());
    const Record& cycle = family.cycles.emplace_back(last_cycle(record));
    add_cycle(cycle, family.samples);
    family.runs.push_back(run_up_to(record, cycle));
  }
  family.first.push_back(family.size());
  return family;
}

FamilyDivision all_samples(const FamilySamples& family) {
  FamilyDivision division{"all", std::vector<std::size_t>(family.size()), {}};
  std::iota(division.training.begin(), division.training.end(), 0U);
  division.judged = division.training;
  return division;
}

std::vector<FamilyDivision> single_dampers(const FamilySamples& family) {
  std::vector<FamilyDivision> dampers =
      groups(family, [&](std::size_t c) { return family.cycles[c].condition; });
  for (FamilyDivision& damper : dampers) damper.training = damper.judged;
  return dampers;
}

std::vector<FamilyDivision> without_geometries(const FamilySamples& family) {
  return left_out_in_turn(family, [&](std::size_t c) {
    return fmt::format("L {:g} mm, h {:g} mm", 1000 * family.condition(c, "pole_length"),
                       1000 * family.condition(c, "gap"));
  });
}

std::vector<FamilyDivision> without_fluids(const FamilySamples& family) {
  return left_out_in_turn(family, [&](std::size_t c) {
    return fmt::format("{:g} Pa*s", family.condition(c, "viscosity"));
  });
}

FamilyDivision random_samples(const FamilySamples& family, double share, std::uint64_t seed) {
  FamilyDivision division{"random samples", {}, {}};
  Random random(seed);
  for (std::size_t s = 0; s < family.size(); ++s)
    (random.uniform() < share ? division.judged : division.training).push_back(s);
  return division;
}

TrainingSamples chosen(const TrainingSamples& samples, const std::vector<std::size_t>& indices) {
  TrainingSamples some;
  const std::size_t inputs = samples.inputs.size() / samples.targets.size();
  for (const std::size_t s : indices) {
    const auto row = samples.inputs.begin() + static_cast<std::ptrdiff_t>(s * inputs);
    some.inputs.insert(some.inputs.end(), row, row + static_cast<std::ptrdiff_t>(inputs));
    some.targets.push_back(samples.targets[s]);
  }
  return some;
}

}  // namespace dashpot
