#include "dashpot/design/model_limits.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace dashpot {
namespace {

/// The operating points at which the request asks for forces.
std::vector<DamperOperation> places_of_force(const DesignRequest& request) {
  std::vector<DamperOperation> places;
  for (const DesignGoal& goal : request.goals)
    if (goal.quantity->is_of_force()) places.push_back(goal.at);
  for (const DesignConstraint& constraint : request.constraints)
    if (constraint.quantity->is_of_force()) places.push_back(constraint.at);
  return places;
}

bool moves_force(const DesignModel& model, const DamperDescription& from,
                 const DamperDescription& to, const DamperOperation& at) {
  constexpr double kRounding = 1e-9;
  const double a = model.evaluate(from, at).force, b = model.evaluate(to, at).force;
  if (!std::isfinite(a) || !std::isfinite(b)) return true;  // what is refused tells nothing
  return std::abs(b - a) > kRounding * (std::abs(a) + std::abs(b));
}

}  // namespace

DesignRequest within_families(DesignRequest request, const DesignModel& first,
                              const DesignModel* second) {
  const DesignQuantity& outside = find_design_quantity(kOutsideFamily, "design");
  if (first.is_fitted()) request.constraints.push_back({&outside, {}, false, 0, ToldBy::First});
  if (second && second->is_fitted())
    request.constraints.push_back({&outside, {}, false, 0, ToldBy::Second});
  return request;
}

std::vector<std::string> operations_beyond(const DesignRequest& request, const DesignModel& model) {
  std::vector<std::string> beyond;
  for (const DamperOperation& at : places_of_force(request))
    for (std::string& what : model.extrapolations(at))
      if (std::ranges::find(beyond, what) == beyond.end()) beyond.push_back(std::move(what));
  return beyond;
}

std::vector<std::string> unseen_fields(const DesignProblem& problem, const DesignModel& model) {
  const std::vector<DamperOperation> places = places_of_force(problem.request());
  if (places.empty()) return {};

  // The largest current shows most: the coil's fields do nothing without one.
  const DamperOperation& at = *std::ranges::max_element(
      places, {}, [](const DamperOperation& place) { return std::abs(place.current); });

  // Each variable goes from one end of its range to the other, the rest in the middle.
  const std::unique_ptr<DesignModel> physics = make_design_model("physics", "design");
  std::vector<std::string> unseen;
  for (std::size_t k = 0; k < problem.size(); ++k) {
    std::vector<double> place(problem.size(), 0.5);
    place[k] = 0;
    const DamperDescription from = problem.damper_at(place);
    place[k] = 1;
    const DamperDescription to = problem.damper_at(place);
    if (!is_possible(from) || !is_possible(to)) continue;
    if (moves_force(*physics, from, to, at) && !moves_force(model, from, to, at))
      unseen.push_back(problem.request().variables[k].name());
  }
  return unseen;
}

}  // namespace dashpot
