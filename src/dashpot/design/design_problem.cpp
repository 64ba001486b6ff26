#include "dashpot/design/design_problem.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "dashpot/base/parallel.h"
#include "dashpot/error.h"
#include "dashpot/numerics/latin_hypercube.h"

namespace dashpot {
namespace {

constexpr double kImpossible = 1e3;  // a violation that no bound comes near

bool same(const DamperOperation& a, const DamperOperation& b) {
  return a.current == b.current && a.velocity == b.velocity && a.displacement == b.displacement;
}

/// Ratios of a decade and more are searched by their logarithm.
bool is_logarithmic(const DesignVariable& v) { return v.from > 0 && v.to >= 10 * v.from; }

/// A range: its step `level` where it is taken in steps.
double range_value(const DesignVariable& v, double place, std::optional<std::size_t> level) {
  if (level) return std::min(v.to, v.from + static_cast<double>(*level) * v.step);
  // A step has the places around its value, as place_of_level has them.
  if (v.step > 0)
    return std::clamp(v.from + (place * static_cast<double>(v.levels()) - 0.5) * v.step, v.from,
                      v.to);
  if (is_logarithmic(v)) return std::clamp(v.from * std::pow(v.to / v.from, place), v.from, v.to);
  return v.from + place * (v.to - v.from);
}

/// The place at which a range without steps has a value, as range_value() has it.
double place_of_value(const DesignVariable& v, double value) {
  const double place = is_logarithmic(v) ? std::log(value / v.from) / std::log(v.to / v.from)
                                         : (value - v.from) / (v.to - v.from);
  return std::isfinite(place) ? std::clamp(place, 0., 1.) : 0.5;
}

void set_variable(const DesignVariable& variable, double place, std::optional<std::size_t> level,
                  DamperDescription& damper) {
  if (!variable.fluids.empty())
    damper.fluid = variable.fluids[*level];
  else
    damper.*variable.field->field =
        variable.values.empty() ? range_value(variable, place, level) : variable.values[*level];
}

/// What becomes of the tolerances of so many dampers, in -1 ... 1.
std::vector<std::vector<double>> draw_made(std::size_t dampers, std::size_t tolerances,
                                           std::uint64_t seed) {
  std::vector<std::vector<double>> made = latin_hypercube(dampers, tolerances, seed);
  for (std::vector<double>& damper : made)
    for (double& tolerance : damper) tolerance = 2 * tolerance - 1;
  return made;
}

double slack_of(const DesignConstraint& constraint, double figure) {
  const double scale = constraint.bound == 0 ? 1 : std::abs(constraint.bound);
  const double slack =
      (constraint.at_least ? figure - constraint.bound : constraint.bound - figure) / scale;
  return std::isfinite(slack) ? std::max(slack, -kImpossible) : -kImpossible;
}

}  // namespace

bool is_possible(const DamperDescription& damper) {
  try {
    require_possible(damper, "");
    return true;
  } catch (const Error&) {
    return false;
  }
}

DesignProblem::DesignProblem(const DesignRequest& request, const DesignModel& model,
                             std::uint64_t seed, const DesignModel* second, int threads)
    : request_(request), model_(model), second_(second), threads_(threads) {
  for (const DesignGoal& goal : request.goals) question_of_.push_back(ask(goal.at, goal.by));
  for (const DesignConstraint& constraint : request.constraints)
    question_of_.push_back(ask(constraint.at, constraint.by));
  ask_fitted();

  // A robust request judges each drawing by the same dampers made.
  if (request.share > 0)
    made_with_ =
        draw_made(static_cast<std::size_t>(request.samples), request.tolerances.size(), seed);
}

/// The same operation by the same model is evaluated once, whoever asks for it.
std::size_t DesignProblem::ask(const DamperOperation& at, ToldBy by) {
  if (by == ToldBy::Second && !second_)
    throw Error("the request", "asks for figures by a second model, and there is none", "name one");
  const auto found = std::ranges::find_if(
      questions_, [&](const Question& known) { return same(known.at, at) && known.by == by; });
  const auto place = static_cast<std::size_t>(found - questions_.begin());
  if (place == questions_.size()) questions_.push_back({at, by});
  return place;
}

/// A fitted model tells its force wherever a moving damper is asked for anything, be it mass, and
/// where none moves, at the end of what it was fitted on: a drawing whose force it refuses is no
/// design.
void DesignProblem::ask_fitted() {
  for (const auto& [model, by] :
       {std::pair{&model_, ToldBy::First}, std::pair{second_, ToldBy::Second}}) {
    if (!model || !model->is_fitted()) continue;
    bool moves = false;
    for (std::size_t k = 0; k < questions_.size(); ++k) {
      const DamperOperation at = questions_[k].at;
      if (at.velocity == 0) continue;
      moves = true;
      ask(at, by);
    }
    if (!moves) ask(model->usual_operation(), by);
  }
}

const DesignQuantity& DesignProblem::quantity_of(std::size_t k) const {
  const std::size_t goals = request_.goals.size();
  return k < goals ? *request_.goals[k].quantity : *request_.constraints[k - goals].quantity;
}

bool DesignProblem::is_wanted_large(std::size_t k) const {
  const std::size_t goals = request_.goals.size();
  return k < goals ? request_.goals[k].maximise : request_.constraints[k - goals].at_least;
}

std::size_t DesignProblem::level_at(std::size_t k, double place) const {
  const std::size_t levels = request_.variables[k].levels();
  if (levels == 0) return 0;
  return std::min(static_cast<std::size_t>(std::max(place, 0.) * static_cast<double>(levels)),
                  levels - 1);
}

double DesignProblem::place_of_level(std::size_t k, std::size_t level) const {
  return (static_cast<double>(level) + 0.5) / static_cast<double>(request_.variables[k].levels());
}

DamperDescription DesignProblem::damper_at(std::span<const double> place, bool relaxed) const {
  assert(place.size() == size());
  DamperDescription damper = request_.damper;
  for (std::size_t k = 0; k < place.size(); ++k) {
    const DesignVariable& variable = request_.variables[k];
    const bool free = variable.levels() == 0 || (relaxed && variable.step > 0);
    set_variable(variable, std::clamp(place[k], 0., 1.),
                 free ? std::nullopt : std::optional(level_at(k, place[k])), damper);
  }
  follow(damper);
  return damper;
}

std::vector<double> DesignProblem::place_of(const DamperDescription& damper) const {
  std::vector<double> place;
  for (std::size_t k = 0; k < size(); ++k) {
    const DesignVariable& variable = request_.variables[k];
    if (variable.levels() == 0) {
      place.push_back(place_of_value(variable, damper.*variable.field->field));
      continue;
    }

    // Of levels the nearest; of fluids the damper's own, or the first.
    std::size_t nearest = 0;
    double least = INFINITY;
    for (std::size_t level = 0; level < variable.levels(); ++level) {
      DamperDescription trial = request_.damper;
      set_variable(variable, 0, level, trial);
      const double distance =
          variable.field ? std::abs(trial.*variable.field->field - damper.*variable.field->field)
                         : (trial.fluid == damper.fluid ? 0. : 1.);
      if (distance >= least) continue;
      least = distance;
      nearest = level;
    }
    place.push_back(place_of_level(k, nearest));
  }
  return place;
}

void DesignProblem::follow(DamperDescription& damper) const {
  for (const FollowingField& following : request_.following) {
    double value = following.constant;
    for (const auto& [field, factor] : following.terms) value += factor * damper.*field->field;
    damper.*following.field->field = value;
  }
}

DamperDescription DesignProblem::made(const DamperDescription& drawn,
                                      std::span<const double> shares) const {
  // Adds the tolerances of either the fields that follow others or those that do not.
  DamperDescription damper = drawn;
  const auto off = [&](bool followers) {
    for (std::size_t t = 0; t < shares.size(); ++t) {
      const DesignTolerance& tolerance = request_.tolerances[t];
      const bool follows = std::ranges::find(request_.following, tolerance.field,
                                             &FollowingField::field) != request_.following.end();
      if (follows == followers) damper.*tolerance.field->field += shares[t] * tolerance.width;
    }
  };

  // Followers are computed from what was made; then they have their own errors.
  off(false);
  follow(damper);
  off(true);
  return damper;
}

/// The first goal or constraint that asks for the same quantity in the same question.
std::size_t DesignProblem::asked_before(std::size_t k) const {
  std::size_t first = 0;
  while (question_of_[first] != question_of_[k] || &quantity_of(first) != &quantity_of(k)) ++first;
  return first;
}

DamperFigures DesignProblem::figures(const DamperDescription& damper) const {
  return figures(damper, Wanted(question_of_.size(), 1));
}

DamperFigures DesignProblem::figures_unridden(const DamperDescription& damper) const {
  Wanted wanted(question_of_.size(), 1);
  for (std::size_t k = 0; k < wanted.size(); ++k) wanted[k] = !needs_ride(k);
  return figures(damper, wanted);
}

DamperFigures DesignProblem::figures(const DamperDescription& damper, const Wanted& wanted) const {
  const auto model_of = [&](const Question& question) -> const DesignModel& {
    return question.by == ToldBy::Second ? *second_ : model_;
  };

  // Each question once. One force that a model refuses leaves no figure.
  std::vector<Appraisal> told;
  for (const Question& question : questions_) {
    told.push_back(model_of(question).appraise(damper, question.at));
    if (const Refusal refusal = told.back().refusal; refusal != Refusal::None)
      return {std::vector<double>(question_of_.size(), NAN), refusal};
  }

  // Every goal and constraint that is wanted reads its figure from the answer to its question.
  DamperFigures figures;
  for (std::size_t k = 0; k < question_of_.size(); ++k) {
    if (!wanted[k]) {
      figures.values.push_back(NAN);
      continue;
    }
    const Question& question = questions_[question_of_[k]];
    const DesignQuantity& quantity = quantity_of(k);
    const Appraisal& own = told[question_of_[k]];
    if (const std::size_t same = asked_before(k);
        same < k && wanted[same] && !quantity.has_band()) {
      figures.values.push_back(figures.values[same]);  // a ride is long
      continue;
    }
    const auto figure = [&](const DamperPhysics& physics) {
      return quantity.of({damper, question.at, physics, model_of(question), &request_});
    };

    // Of a band the end at which a figure that is wanted large, or small, is worst.
    if (own.weak && own.strong && quantity.has_band()) {
      const double weak = figure(*own.weak), strong = figure(*own.strong);
      figures.values.push_back(is_wanted_large(k) ? std::min(weak, strong)
                                                  : std::max(weak, strong));
    } else {
      figures.values.push_back(figure(own.physics));
    }
  }
  return figures;
}

std::vector<double> DesignProblem::middle_figures(const DamperDescription& damper,
                                                  const DesignModel& model) const {
  std::vector<double> figures;
  for (std::size_t k = 0; k < question_of_.size(); ++k) {
    const DamperOperation& at = questions_[question_of_[k]].at;
    const DamperPhysics physics = model.evaluate(damper, at);
    figures.push_back(quantity_of(k).of({damper, at, physics, model, &request_}));
  }
  return figures;
}

/// The figure that the share of the dampers reaches or exceeds (at_least), or stays at or below.
double DesignProblem::figure_of_share(std::vector<double>& figures, bool at_least) const {
  for (double& figure : figures)  // an unknown figure is as bad as can be
    if (std::isnan(figure)) figure = at_least ? -HUGE_VAL : HUGE_VAL;
  std::ranges::sort(figures);
  const auto needed = static_cast<std::size_t>(
      std::ceil(request_.share * static_cast<double>(figures.size()) * (1 - 1e-12)));
  return at_least ? figures[figures.size() - needed] : figures[needed - 1];
}

Assessment DesignProblem::assess(const DamperDescription& drawn) const {
  return assess_wanted(drawn, Wanted(question_of_.size(), 1));
}

Assessment DesignProblem::assess_for(const DamperDescription& drawn,
                                     const std::size_t* goal) const {
  Wanted wanted(question_of_.size(), 1);
  for (std::size_t k = 0; k < request_.goals.size(); ++k) wanted[k] = goal && *goal == k;
  return assess_wanted(drawn, wanted);
}

Assessment DesignProblem::assess_wanted(const DamperDescription& drawn,
                                        const Wanted& wanted) const {
  Assessment assessment;
  const std::size_t goals = request_.goals.size();

  // A damper that cannot be drawn fails every constraint by more than any other could.
  const auto impossible = [&] {
    assessment.possible = false;
    assessment.violation = kImpossible * static_cast<double>(1 + request_.constraints.size());
    assessment.slack.assign(request_.constraints.size(), -kImpossible);
    return assessment;
  };
  if (!is_possible(drawn)) return impossible();

  // The drawing's own figures, or, where a share of the dampers made counts, what this share
  // reaches. A drawing that a model refuses is not made, and of others nothing else counts.
  const auto is_drawn = [&](std::size_t k) {
    return made_with_.empty() || (ridden_ == Ridden::Drawn && k < goals && needs_ride(k));
  };
  Wanted of_drawn = wanted, of_made = wanted;
  for (std::size_t k = 0; k < wanted.size(); ++k) (is_drawn(k) ? of_made : of_drawn)[k] = 0;
  auto [all, refusal] = figures(drawn, of_drawn);
  assessment.refusal = refusal;
  assessment.known = refusal == Refusal::None;
  if (!made_with_.empty() && assessment.known) {
    std::vector<DamperDescription> dampers;
    for (const std::vector<double>& shares : made_with_) {
      dampers.push_back(made(drawn, shares));
      if (!is_possible(dampers.back())) return impossible();
    }
    // What nobody asks of them is not told.
    std::vector<std::vector<double>> told(dampers.size(), std::vector<double>(all.size(), NAN));
    if (std::ranges::any_of(of_made, [](auto asked) { return asked != 0; }))
      parallel_for(dampers.size(), threads_,
                   [&](std::size_t n) { told[n] = figures(dampers[n], of_made).values; });
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (is_drawn(k)) continue;
      std::vector<double> of_dampers;
      for (const std::vector<double>& one : told) of_dampers.push_back(one[k]);
      all[k] = figure_of_share(of_dampers, is_wanted_large(k));
    }
  }

  // Slack of each constraint; the violation sums those that fail.
  assessment.goals.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(goals));
  assessment.constraints.assign(all.begin() + static_cast<std::ptrdiff_t>(goals), all.end());
  for (std::size_t k = 0; k < request_.constraints.size(); ++k) {
    assessment.slack.push_back(slack_of(request_.constraints[k], assessment.constraints[k]));
    assessment.violation += std::max(0., -assessment.slack.back());
  }

  // A goal that is not finite is as bad as a constraint whose figure is not known.
  for (std::size_t k = 0; k < goals; ++k)
    if (assessment.refusal != Refusal::None || (wanted[k] && !std::isfinite(all[k]))) {
      assessment.known = false;
      assessment.violation += kImpossible;
    }
  return assessment;
}

}  // namespace dashpot
