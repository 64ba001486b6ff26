#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "dashpot/design/design_request.h"

namespace dashpot {

/// How a damper does what was asked of it.
struct Assessment {
  bool possible = true;             ///< false: no such damper can be drawn; there are no figures then
  std::vector<double> goals;        ///< the quantities, as the share of dampers made reaches them
  std::vector<double> constraints;  ///< likewise
  std::vector<double> slack;        ///< of each constraint, in shares of its bound; negative: it fails
  double violation = 0;             ///< sum of what is negative

  bool holds() const { return possible && violation == 0; }
};

/// A request turned into a search: places in the unit cube are dampers, which are assessed. Immutable.
class DesignProblem {
 public:
  /// `request` and `model` must outlive it. The seed draws the dampers that stand for those made.
  DesignProblem(const DesignRequest& request, const DesignModel& model, std::uint64_t seed);

  const DesignRequest& request() const { return request_; }
  const DesignModel& model() const { return model_; }
  std::size_t size() const { return request_.variables.size(); }

  /// The damper at a place of the unit cube. `relaxed`: ranges with steps are taken without them.
  DamperDescription damper_at(std::span<const double> place, bool relaxed = false) const;
  /// The place at which variable k takes its level (for a variable with levels), and the level at a place.
  double place_of_level(std::size_t k, std::size_t level) const;
  std::size_t level_at(std::size_t k, double place) const;

  Assessment assess(const DamperDescription& drawn) const;
  /// The damper with its fields off by these shares of their tolerances.
  DamperDescription made(const DamperDescription& drawn, std::span<const double> shares) const;
  /// The figures of every goal, then of every constraint, of one damper as it is.
  std::vector<double> figures(const DamperDescription& damper) const;

 private:
  void follow(DamperDescription& damper) const;
  double figure_of_share(std::vector<double>& figures, bool at_least) const;

  const DesignRequest& request_;
  const DesignModel& model_;
  std::vector<DamperOperation> operations_;     // each once
  std::vector<std::size_t> operation_of_;       // of every goal, then of every constraint
  std::vector<std::vector<double>> made_with_;  // shares of the tolerances of each damper made
};

}  // namespace dashpot
