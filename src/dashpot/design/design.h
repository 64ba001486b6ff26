#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/base/monitor.h"
#include "dashpot/design/conflict.h"
#include "dashpot/design/pareto.h"
#include "dashpot/design/sensitivity.h"

namespace dashpot {

struct DesignOptions {
  std::uint64_t seed = 1;
  int threads = 0;           ///< the result does not depend on it
  std::size_t points = 200;  ///< of a front
  int generations = 100;
  FrontMethod method = FrontMethod::Nsga2;
  std::string model = "physics";
  std::string second;  ///< a model whose figures stand beside; empty: none
  Monitor monitor;
};

/// One damper that holds every constraint.
struct Design {
  std::string name;  ///< "design_001"
  DamperDescription damper;
  Assessment assessment;
  std::vector<double> second;  ///< the second model's figures as drawn: goals, then constraints
  double disagreement = 0;     ///< the largest difference of the two as drawn, in shares of the first's
  std::string role;            ///< what makes it stand out: "largest force", "knee"; else empty
  std::optional<Sensitivity> sensitivity;  ///< of those that stand out, where there are tolerances
};

struct DesignReport {
  DesignRequest request;
  DesignOptions options;
  std::vector<Design> designs;       ///< the best, or a front in the order of its first goal
  std::optional<Conflict> conflict;  ///< why there is none
  std::size_t rejected = 0;          ///< designs that failed when checked by themselves
  std::size_t evaluations = 0;
  double wall_seconds = 0;
  bool stopped = false;  ///< the user asked to stop: the best so far
};

/// One goal: the best design. Several: a front of designs of which none is better in all goals. Every design
/// is written as a damper's description, read again and assessed anew; one that then fails a constraint is
/// not returned. Ends with what it has when the monitor asks to stop.
DesignReport design(const DesignRequest& request, const DesignOptions& options);

/// The assessment of a description's text, from scratch.
Assessment check_design(const std::string& text, const DesignRequest& request, const DesignModel& model,
                        std::uint64_t seed);

}  // namespace dashpot
