#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "dashpot/base/random.h"
#include "dashpot/identify/fit/law_unknowns.h"
#include "dashpot/machine/in_plant_setup.h"

namespace dashpot {

/// The unknowns of a law in the dampers of a plant: those of one kind of damper behind those of the
/// other, of each as LawUnknowns has them.
class DamperUnknowns {
 public:
  /// each: of every kind.
  DamperUnknowns(const LawUnknowns& each, DamperKinds kinds);
  /// Of the dampers of a plant: in a kind whose drive never changes parameters are constant.
  DamperUnknowns(const Law& law, const DataScale& scale, const InPlantSetup& setup,
                 const std::vector<ParameterChoice>& choices);

  std::size_t kinds() const { return kinds_.size(); }
  std::size_t size() const { return lower_.size(); }
  const std::vector<double>& lower() const { return lower_; }
  const std::vector<double>& upper() const { return upper_; }
  std::vector<std::string> warnings() const;
  /// Those of dampers that are alike, in dampers of these kinds.
  DamperUnknowns in_kinds(DamperKinds kinds) const { return {laws_.front(), std::move(kinds)}; }
  bool slows_filter() const { return laws_.front().slows_filter(); }

  /// All kinds as this one is, of dampers that are alike.
  std::vector<double> alike(const std::vector<double>& one) const;
  /// All kinds alike; with `random`, each value of each is moved as LawUnknowns does it.
  std::vector<double> start(Random* random = nullptr) const;
  /// The unknowns, with those that stand at a bound back inside.
  std::vector<double> off_bounds(const std::vector<double>& unknowns) const;
  /// The law of each kind.
  std::vector<LawModel> models(std::span<const double> unknowns) const;
  /// The unknowns of such models, one of each kind.
  std::vector<double> of(std::span<const LawModel> models) const;
  /// Of all kinds, named "front.alpha" where there are several.
  std::vector<LawUnknowns::Coefficient> coefficients(std::span<const double> unknowns) const;

  /// The unknowns that act through one parameter of the law in one kind of damper.
  struct Group {
    std::size_t kind = 0;
    LawUnknowns::Group in_law;  ///< among those of its kind
    std::size_t first = 0;      ///< among all
    std::size_t count() const { return in_law.count; }
  };
  std::vector<Group> groups() const;
  /// From where a fit may end elsewhere, as LawUnknowns has it, of one kind after the other.
  struct Flattened {
    Group group;
    std::vector<double> unknowns;
  };
  std::vector<Flattened> flattened(std::span<const double> unknowns) const;
  /// As LawUnknowns has them, in the group's kind.
  double step(std::span<const double> unknowns, const Group& group) const;
  std::vector<LawModel> moved(std::span<const double> unknowns, const Group& group,
                              double step) const;
  double slope(std::span<const double> unknowns, const Group& group, std::size_t k,
               double current) const;

 private:
  std::span<const double> of_kind(std::span<const double> unknowns, std::size_t kind) const {
    return unknowns.subspan(first_[kind], laws_[kind].size());
  }
  Group group_of(std::size_t kind, const LawUnknowns::Group& in_law) const {
    return {kind, in_law, first_[kind] + in_law.first};
  }
  void add(LawUnknowns law);

  DamperKinds kinds_;
  std::vector<LawUnknowns> laws_;   ///< per kind
  std::vector<std::size_t> first_;  ///< of each kind's
  std::vector<double> lower_, upper_;
};

}  // namespace dashpot
