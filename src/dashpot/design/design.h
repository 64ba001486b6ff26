#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/design/conflict.h"
#include "dashpot/design/pareto.h"
#include "dashpot/design/sensitivity.h"
#include "dashpot/monitor.h"

namespace dashpot {

/// How a request is answered.
struct DesignOptions {
  std::uint64_t seed = 1;
  int threads = 0;           ///< the result does not depend on it
  std::size_t points = 200;  ///< of a front
  int generations = 100;
  FrontMethod method = FrontMethod::Nsga2;
  std::string model = "physics";  ///< as make_design_model has them
  std::string second;             ///< a model whose figures stand beside; empty: none
  /// Refuses designs beyond the dampers of a family's model; else they are marked.
  bool refuse_outside = false;
  /// Keeps designs at which a family's model leaps beyond physics (kMostLeap); else they are
  /// refused.
  bool insist = false;
  /// Designs of an earlier run, from which the search for a front goes on in place of the best for
  /// each goal. Those that fail a constraint of the request are left out.
  std::vector<DamperDescription> starts = {};
  Monitor monitor;
};

/// One damper that holds every constraint.
struct Design {
  std::string name;  ///< "design_001"
  DamperDescription damper;
  Assessment assessment;
  /// With a second model: all figures of the drawing by each model, in the middle of its band,
  /// goals and then constraints.
  std::vector<double> first, second;
  double disagreement = 0;  ///< the largest difference of the two, in shares of the first's
  std::string role;         ///< what makes it stand out: "largest force", "knee"; else empty
  /// Fields in which it lies beyond the dampers of a family's model, in words.
  std::vector<std::string> outside;
  std::optional<Sensitivity> sensitivity;  ///< of those that stand out, where there are tolerances
};

/// The answer to a request, and how it was found.
struct DesignReport {
  DesignRequest request;  ///< with the constraints that refuse designs beyond a family, if asked
  DesignOptions options;
  std::string first_name, second_name;  ///< of the models
  std::vector<std::string> notes;       ///< what a family's model cannot know, in words
  std::vector<Design> designs;          ///< the best, or a front in the order of its first goal
  std::optional<Conflict> conflict;     ///< why there is none
  std::size_t rejected = 0;             ///< designs that failed when checked by themselves
  std::size_t evaluations = 0;
  double wall_seconds = 0;
  bool stopped = false;  ///< the user asked to stop: the best so far
};

/// One goal: the best design. Several: a front of designs of which none is better in all goals.
/// Every design is written as a damper's description, read again and assessed anew; one that then
/// fails a constraint is not returned. Ends with what it has when the monitor asks to stop. Throws
/// Error where a current or a speed is beyond a family's model, and that is to be refused.
DesignReport design(const DesignRequest& request, const DesignOptions& options);

/// The assessment of a description's text, from scratch. Throws Error where the text is no
/// description.
Assessment check_design(const std::string& text, const DesignRequest& request,
                        const DesignModel& model, std::uint64_t seed,
                        const DesignModel* second = nullptr);

}  // namespace dashpot
