#include "dashpot/machine/damper_unknowns.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace dashpot {
namespace {

void append(std::vector<double>& all, const std::vector<double>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

DamperUnknowns::DamperUnknowns(LawUnknowns each, DamperKinds kinds)
    : each_(std::move(each)), kinds_(std::move(kinds)) {
  for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
    append(lower_, each_.lower());
    append(upper_, each_.upper());
  }
}

std::vector<double> DamperUnknowns::alike(const std::vector<double>& one) const {
  std::vector<double> all;
  for (std::size_t kind = 0; kind < kinds(); ++kind) append(all, one);
  return all;
}

std::vector<double> DamperUnknowns::start(Random* random) const {
  std::vector<double> all;
  for (std::size_t kind = 0; kind < kinds(); ++kind) append(all, each_.start(random));
  return all;
}

std::vector<double> DamperUnknowns::off_bounds(const std::vector<double>& unknowns) const {
  std::vector<double> all;
  for (std::size_t kind = 0; kind < kinds(); ++kind) {
    const std::span<const double> own = of_kind(unknowns, kind);
    append(all, each_.off_bounds({own.begin(), own.end()}));
  }
  return all;
}

std::vector<LawModel> DamperUnknowns::models(std::span<const double> unknowns) const {
  std::vector<LawModel> all;
  for (std::size_t kind = 0; kind < kinds(); ++kind)
    all.push_back(each_.model(of_kind(unknowns, kind)));
  return all;
}

std::vector<double> DamperUnknowns::of(std::span<const LawModel> models) const {
  assert(models.size() == kinds());
  std::vector<double> all;
  for (const LawModel& model : models) append(all, each_.of(model));
  return all;
}

std::vector<LawUnknowns::Coefficient> DamperUnknowns::coefficients(
    std::span<const double> unknowns) const {
  std::vector<LawUnknowns::Coefficient> all;
  for (std::size_t kind = 0; kind < kinds(); ++kind)
    for (LawUnknowns::Coefficient& one : each_.coefficients(of_kind(unknowns, kind))) {
      one.name = kinds_.named(kind, one.name);
      one.first += kind * each_.size();
      all.push_back(std::move(one));
    }
  return all;
}

std::vector<DamperUnknowns::Group> DamperUnknowns::groups() const {
  std::vector<Group> all;
  for (std::size_t kind = 0; kind < kinds(); ++kind)
    for (const LawUnknowns::Group& one : each_.groups()) all.push_back(group_of(kind, one));
  return all;
}

std::vector<DamperUnknowns::Flattened> DamperUnknowns::flattened(
    std::span<const double> unknowns) const {
  std::vector<Flattened> all;
  for (std::size_t kind = 0; kind < kinds(); ++kind)
    for (const LawUnknowns::Flattened& one : each_.flattened(of_kind(unknowns, kind))) {
      all.push_back({group_of(kind, one.group), {unknowns.begin(), unknowns.end()}});
      std::ranges::copy(one.unknowns, all.back().unknowns.begin() +
                                          static_cast<std::ptrdiff_t>(kind * each_.size()));
    }
  return all;
}

double DamperUnknowns::step(std::span<const double> unknowns, const Group& group) const {
  return each_.step(of_kind(unknowns, group.kind), group.in_law);
}

std::vector<LawModel> DamperUnknowns::moved(std::span<const double> unknowns, const Group& group,
                                            double step) const {
  std::vector<LawModel> all = models(unknowns);
  all[group.kind] = each_.moved(of_kind(unknowns, group.kind), group.in_law, step);
  return all;
}

double DamperUnknowns::slope(std::span<const double> unknowns, const Group& group, std::size_t k,
                             double current) const {
  return each_.slope(of_kind(unknowns, group.kind), group.in_law, k, current);
}

}  // namespace dashpot
