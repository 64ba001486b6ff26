#include "dashpot/machine/damper_unknowns.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "dashpot/machine/damper_drive.h"

namespace dashpot {
namespace {

void append(std::vector<double>& all, const std::vector<double>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

DamperUnknowns::DamperUnknowns(const LawUnknowns& each, DamperKinds kinds)
    : kinds_(std::move(kinds)) {
  for (std::size_t kind = 0; kind < kinds_.size(); ++kind) add(each);
}

DamperUnknowns::DamperUnknowns(const Law& law, const DataScale& scale, const InPlantSetup& setup,
                               const std::vector<ParameterChoice>& choices)
    : kinds_(setup.kinds) {
  for (const std::optional<double>& level : held_levels(setup)) {
    DataScale own = scale;
    if (level) own.drive = {*level, *level, false, 1};
    add({law, own, setup.drive_unit, OffsetMode::Record, choices});
  }
}

void DamperUnknowns::add(LawUnknowns law) {
  first_.push_back(lower_.size());
  append(lower_, law.lower());
  append(upper_, law.upper());
  laws_.push_back(std::move(law));
}

std::vector<std::string> DamperUnknowns::warnings() const {
  std::vector<std::string> all;
  for (const LawUnknowns& law : laws_)
    for (const std::string& warning : law.warnings())
      if (std::ranges::find(all, warning) == all.end()) all.push_back(warning);
  return all;
}

std::vector<double> DamperUnknowns::alike(const std::vector<double>& one) const {
  std::vector<double> all;
  for (std::size_t kind = 0; kind < kinds(); ++kind) append(all, one);
  return all;
}

std::vector<double> DamperUnknowns::start(Random* random) const {
  std::vector<double> all;
  for (std::size_t kind = 0; kind < kinds(); ++kind) append(all, laws_[kind].start(random));
  return all;
}

std::vector<double> DamperUnknowns::off_bounds(const std::vector<double>& unknowns) const {
  std::vector<double> all;
  for (std::size_t kind = 0; kind < kinds(); ++kind) {
    const std::span<const double> own = of_kind(unknowns, kind);
    append(all, laws_[kind].off_bounds({own.begin(), own.end()}));
  }
  return all;
}

std::vector<LawModel> DamperUnknowns::models(std::span<const double> unknowns) const {
  std::vector<LawModel> all;
  for (std::size_t kind = 0; kind < kinds(); ++kind)
    all.push_back(laws_[kind].model(of_kind(unknowns, kind)));
  return all;
}

std::vector<double> DamperUnknowns::of(std::span<const LawModel> models) const {
  assert(models.size() == kinds());
  std::vector<double> all;
  for (std::size_t kind = 0; kind < kinds(); ++kind) append(all, laws_[kind].of(models[kind]));
  return all;
}

std::vector<LawUnknowns::Coefficient> DamperUnknowns::coefficients(
    std::span<const double> unknowns) const {
  std::vector<LawUnknowns::Coefficient> all;
  for (std::size_t kind = 0; kind < kinds(); ++kind)
    for (LawUnknowns::Coefficient& one : laws_[kind].coefficients(of_kind(unknowns, kind))) {
      one.name = kinds_.named(kind, one.name);
      one.first += first_[kind];
      all.push_back(std::move(one));
    }
  return all;
}

std::vector<DamperUnknowns::Group> DamperUnknowns::groups() const {
  std::vector<Group> all;
  for (std::size_t kind = 0; kind < kinds(); ++kind)
    for (const LawUnknowns::Group& one : laws_[kind].groups()) all.push_back(group_of(kind, one));
  return all;
}

std::vector<DamperUnknowns::Flattened> DamperUnknowns::flattened(
    std::span<const double> unknowns) const {
  std::vector<Flattened> all;
  for (std::size_t kind = 0; kind < kinds(); ++kind)
    for (const LawUnknowns::Flattened& one : laws_[kind].flattened(of_kind(unknowns, kind))) {
      all.push_back({group_of(kind, one.group), {unknowns.begin(), unknowns.end()}});
      std::ranges::copy(one.unknowns,
                        all.back().unknowns.begin() + static_cast<std::ptrdiff_t>(first_[kind]));
    }
  return all;
}

double DamperUnknowns::step(std::span<const double> unknowns, const Group& group) const {
  return laws_[group.kind].step(of_kind(unknowns, group.kind), group.in_law);
}

std::vector<LawModel> DamperUnknowns::moved(std::span<const double> unknowns, const Group& group,
                                            double step) const {
  std::vector<LawModel> all = models(unknowns);
  all[group.kind] = laws_[group.kind].moved(of_kind(unknowns, group.kind), group.in_law, step);
  return all;
}

double DamperUnknowns::slope(std::span<const double> unknowns, const Group& group, std::size_t k,
                             double current) const {
  return laws_[group.kind].slope(of_kind(unknowns, group.kind), group.in_law, k, current);
}

}  // namespace dashpot
