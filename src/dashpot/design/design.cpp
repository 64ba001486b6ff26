#include "dashpot/design/design.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/design/model_limits.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

/// One run: the models and what is found with them.
class DesignRun {
 public:
  DesignRun(const DesignRequest& request, const DesignOptions& options)
      : model_(make_design_model(options.model, "model", options.insist)),
        second_(options.second.empty()
                    ? nullptr
                    : make_design_model(options.second, "second model", options.insist)),
        report_{.request = options.refuse_outside ? within_families(request, *model_, second_.get())
                                                  : request,
                .options = options,
                .first_name = model_->name(),
                .second_name = second_ ? second_->name() : ""},
        problem_(report_.request, *model_, options.seed, second_.get(), options.threads) {
    note_limits();
  }
  DesignReport run();

 private:
  bool is_fitted() const;
  OptimiseOptions search_options(const std::string& stage, double from, double to);
  std::vector<std::vector<double>> best_of_each_goal();
  /// Whether the drawing's own ride may tell where to look for the best of the dampers made.
  bool rides_drawn_first(const DesignGoal& goal) const;
  /// The places of the designs to go on from, as far as they hold the constraints.
  std::vector<std::vector<double>> earlier_places() const;
  std::vector<std::vector<double>> front_from(std::vector<std::vector<double>> ends);
  /// Whether not even the drawn damper, without tolerances, comes near to the constraints: found
  /// within seconds, where a search that rides, or a robust one by a fitted model, would take
  /// minutes to say the same.
  bool is_hopeless();
  /// Finds the constraints that conflict, or a place that holds all of them after all.
  std::vector<std::vector<double>> explain();
  void note_limits();
  bool feeds_energy(const DamperDescription& damper);
  void add_designs(const std::vector<std::vector<double>>& places);
  void compare(Design& design) const;
  void name_roles();
  void add_sensitivities();
  /// Notes what `dashpot physics` would warn of in the designs that stand out, at the largest
  /// current and speed that are asked about.
  void note_warnings();

  std::unique_ptr<DesignModel> model_, second_;
  DesignReport report_;
  DesignProblem problem_;
  Monitor staged_;
};

void DesignRun::note_limits() {
  if (report_.request.ride)
    report_.notes.push_back("comfort is that of " + report_.request.ride->description());
  for (const DesignModel* model : {model_.get(), second_.get()}) {
    if (!model || !model->is_fitted()) continue;
    if (model->has_band())
      report_.notes.push_back(model->name() +
                              ": what is asked of its forces is met, and told, at the pessimistic "
                              "end of its band");
    const std::vector<std::string> beyond = operations_beyond(report_.request, *model);
    if (report_.options.refuse_outside && !beyond.empty())
      throw Error("the request", join(beyond, "; "),
                  "a place within, or a model that marks what lies outside");
    report_.notes.insert(report_.notes.end(), beyond.begin(), beyond.end());

    // What it sees is asked of the model as it is, without what would be refused of it.
    const std::unique_ptr<DesignModel> plain = make_design_model(
        model == model_.get() ? report_.options.model : report_.options.second, "model", true);
    if (const std::vector<std::string> unseen = unseen_fields(problem_, *plain); !unseen.empty())
      report_.notes.push_back(model->name() + " does not see " + join(unseen, ", ") +
                              ": in that its force is of the dampers that it was fitted on");
  }
}

bool DesignRun::is_fitted() const {
  return model_->is_fitted() || (second_ && second_->is_fitted());
}

/// A fitted model runs through a cycle of motion for each force, where physics has an equation: its
/// searches are shorter, and end where its error has long been more than their steps. A ride takes
/// longer still.
OptimiseOptions DesignRun::search_options(const std::string& stage, double from, double to) {
  // Its progress is a part of the whole's.
  const Monitor& monitor = report_.options.monitor;
  if (!report_.stopped) try {
      monitor.report(stage, from);
    } catch (const Interrupted&) {
      report_.stopped = true;
    }
  staged_ = {[&monitor, from, to](const Progress& own) {
               if (monitor.on_progress)
                 monitor.on_progress({own.stage, from + own.fraction * (to - from)});
             },
             monitor.stop};

  OptimiseOptions options{
      .seed = report_.options.seed, .threads = report_.options.threads, .monitor = &staged_};
  const bool takes_long = is_fitted() || report_.request.ride;
  for (const DesignVariable& variable : report_.request.variables)
    if (!takes_long && variable.fluids.size() > 1)
      options.starts *= static_cast<int>(variable.fluids.size());  // as many in each fluid
  if (is_fitted()) {
    options.starts = 3;
    options.evaluations = 100;
    options.looks = 50;
    options.step = 1e-6;
  }
  if (report_.request.ride) {
    options.starts = 2;
    options.evaluations = 30;
    options.looks = 15;
    options.step = 1e-3;
  }
  return options;
}

bool DesignRun::rides_drawn_first(const DesignGoal& goal) const {
  const DesignRequest& request = report_.request;
  const auto of_ride = [](const auto& asked) { return is_of_ride(*asked.quantity); };
  return request.share > 0 && of_ride(goal) && std::ranges::none_of(request.constraints, of_ride);
}

std::vector<std::vector<double>> DesignRun::best_of_each_goal() {
  const std::vector<DesignGoal>& goals = report_.request.goals;
  std::vector<std::vector<double>> places;
  const double part = goals.size() > 1 ? 0.3 / static_cast<double>(goals.size()) : 0.6;
  for (std::size_t k = 0; k < goals.size() && !report_.stopped; ++k) {
    const double from = part * static_cast<double>(k);
    const bool drawn_first = rides_drawn_first(goals[k]);
    OptimiseOptions options = search_options(describe(goals[k]), from, from + part);
    Optimum optimum = optimise(drawn_first ? problem_.riding(Ridden::Drawn) : problem_, k, options);
    report_.evaluations += optimum.evaluations;
    report_.stopped = report_.stopped || optimum.stopped;

    // From the best as drawn to the best as made, in as many looks as a minute allows.
    if (drawn_first && !report_.stopped && !optimum.place.empty()) {
      constexpr int kLooks = 5;
      options.looks = kLooks;
      optimum = refine(problem_, k, optimum.place, options);
      report_.evaluations += optimum.evaluations;
      report_.stopped = report_.stopped || optimum.stopped;
    }
    if (optimum.place.empty() || optimum.violation > 0) break;  // neither can it for another goal
    places.push_back(optimum.place);
  }
  return places;
}

std::vector<std::vector<double>> DesignRun::earlier_places() const {
  std::vector<std::vector<double>> places;
  for (const DamperDescription& start : report_.options.starts) {
    const std::vector<double> place = problem_.place_of(start);
    if (problem_.assess(problem_.damper_at(place)).holds()) places.push_back(place);
  }
  return places;
}

/// Goals as numbers to be made small.
std::vector<double> to_minimise(const DesignRequest& request, std::vector<double> goals) {
  for (std::size_t k = 0; k < goals.size(); ++k)
    if (request.goals[k].maximise) goals[k] = -goals[k];
  return goals;
}

std::vector<std::vector<double>> DesignRun::front_from(std::vector<std::vector<double>> ends) {
  const DesignRequest& request = report_.request;

  // The front's problem: every goal made small.
  FrontProblem front{.size = problem_.size(), .goals = request.goals.size()};
  front.evaluate = [&](std::span<const double> place) {
    const Assessment assessment = problem_.assess(problem_.damper_at(place));
    return FrontProblem::Value{to_minimise(request, assessment.goals), assessment.violation};
  };

  // The best designs of the single goals span the front: their extent scales it, and it starts
  // from them.
  front.scale.assign(front.goals, 0.);
  for (std::size_t k = 0; k < front.goals; ++k) {
    std::vector<double> values;
    for (const auto& end : ends) values.push_back(front.evaluate(end).goals[k]);
    const auto [low, high] = std::ranges::minmax(values);
    front.scale[k] = high > low ? high - low : std::max(std::abs(high), 1e-30);
  }
  front.starts = ends;

  // The search for the front; where it finds no place, the ends themselves are the front.
  const OptimiseOptions& search = search_options("front", 0.3, 1);
  const Front found = pareto_front(front, {.method = report_.options.method,
                                           .points = report_.options.points,
                                           .generations = report_.options.generations,
                                           .seed = search.seed,
                                           .threads = search.threads,
                                           .monitor = search.monitor});
  report_.evaluations += found.evaluations;
  report_.stopped = report_.stopped || found.stopped;
  return found.places.empty() ? ends : found.places;
}

std::vector<std::vector<double>> DesignRun::explain() {
  const Optimum nearest = least_violation(problem_, search_options("least violation", 0.6, 0.7));
  report_.evaluations += nearest.evaluations;
  report_.stopped = report_.stopped || nearest.stopped;
  if (nearest.violation == 0) return {nearest.place};  // designs are rare, but there are some
  if (report_.stopped) return {};
  report_.conflict = find_conflict(problem_, nearest, search_options("conflict", 0.7, 1));
  report_.evaluations += report_.conflict->evaluations;
  report_.stopped = report_.stopped || report_.conflict->stopped;
  const std::vector<double> design = report_.conflict->design;
  if (design.empty()) return {};
  report_.conflict.reset();
  return {design};
}

bool DesignRun::is_hopeless() {
  constexpr double kFar = 0.1;  // of a bound: more than tolerances could mend
  const DesignRequest& request = report_.request;
  const bool takes_long = request.ride || (is_fitted() && request.share > 0);
  if (!takes_long || request.constraints.empty()) return false;

  // A few searches of the same request for the drawing alone, and without rides as goals: what
  // they tell counts only where the constraints hold.
  DesignRequest drawn = request;
  drawn.share = 0;
  drawn.tolerances.clear();
  std::erase_if(drawn.goals, [](const DesignGoal& goal) { return is_of_ride(*goal.quantity); });
  const DesignProblem problem(drawn, *model_, report_.options.seed, second_.get());
  OptimiseOptions options = search_options("can it be reached", 0, 0.1);
  options.starts = 2;
  options.evaluations = 100;
  const Optimum nearest = least_violation(problem, options);
  if (nearest.stopped || nearest.violation <= kFar) return false;

  // What it would take says the same filter as for any conflict.
  report_.evaluations += nearest.evaluations;
  report_.conflict = find_conflict(problem, nearest, search_options("conflict", 0.1, 1));
  report_.evaluations += report_.conflict->evaluations;
  report_.stopped = report_.stopped || report_.conflict->stopped;
  if (!report_.conflict->design.empty()) {
    report_.conflict.reset();
    return false;
  }
  if (request.share > 0)
    report_.notes.push_back(
        "judged by the drawn damper alone: that a share of the dampers made must hold the same "
        "asks more");
  return true;
}

void DesignRun::compare(Design& design) const {
  design.first = problem_.middle_figures(design.damper, *model_);
  design.second = problem_.middle_figures(design.damper, *second_);
  for (std::size_t k = 0; k < design.first.size(); ++k) {
    const double share = std::abs(design.second[k] / design.first[k] - 1);
    if (std::isfinite(share)) design.disagreement = std::max(design.disagreement, share);
  }
}

/// Whether a fitted model of this damper is no damper's in some other motion or at some other
/// current than those that were asked; said once.
bool DesignRun::feeds_energy(const DamperDescription& damper) {
  if (report_.options.insist) return false;
  for (const DesignModel* model : {model_.get(), second_.get()}) {
    if (!model || model->dissipates(damper, report_.options.threads)) continue;
    const std::string note =
        model->name() +
        " was refused where it feeds energy in, in some cycle within its data; to insist keeps it";
    if (std::ranges::find(report_.notes, note) == report_.notes.end())
      report_.notes.push_back(note);
    return true;
  }
  return false;
}

void DesignRun::add_designs(const std::vector<std::vector<double>>& places) {
  for (const auto& place : places) {
    // The description is written and read again: what is judged is what the user gets.
    Design design;
    design.damper = problem_.damper_at(place);
    design.damper.name = report_.request.name;
    design.assessment = check_design(format_description(design.damper), report_.request, *model_,
                                     report_.options.seed, second_.get());
    if (!design.assessment.holds() || feeds_energy(design.damper)) {
      ++report_.rejected;
      continue;
    }

    // The fields in which it lies beyond the dampers of either model, each once.
    design.outside = model_->extrapolations(design.damper);
    if (second_) {
      compare(design);
      for (std::string& what : second_->extrapolations(design.damper))
        if (std::ranges::find(design.outside, what) == design.outside.end())
          design.outside.push_back(std::move(what));
    }
    report_.designs.push_back(std::move(design));
  }

  // Names follow the order of the first goal.
  std::ranges::sort(report_.designs, [](const Design& a, const Design& b) {
    return a.assessment.goals < b.assessment.goals;
  });
  for (std::size_t k = 0; k < report_.designs.size(); ++k) {
    Design& design = report_.designs[k];
    design.name = fmt::format("design_{:03}", k + 1);
    design.damper.name += (design.damper.name.empty() ? "" : ", ") + design.name;
  }
}

/// The best for each goal, and the knee: nearest to the best of all goals at once, each in the
/// front's extent.
void DesignRun::name_roles() {
  std::vector<Design>& designs = report_.designs;
  if (designs.empty()) return;

  // The goals of all designs as numbers to be made small.
  const DesignRequest& request = report_.request;
  std::vector<std::vector<double>> values;
  for (const Design& design : designs)
    values.push_back(to_minimise(request, design.assessment.goals));

  // The best design of each goal, and the squared distances from all those bests together.
  std::vector<double> distance(designs.size(), 0.);
  const auto add_role = [&](std::size_t k, const std::string& role) {
    designs[k].role += (designs[k].role.empty() ? "" : "; ") + role;
  };
  for (std::size_t g = 0; g < request.goals.size(); ++g) {
    const auto by_goal = [g](const std::vector<double>& row) { return row[g]; };
    const auto best = std::ranges::min_element(values, {}, by_goal);
    const double low = (*best)[g], high = (*std::ranges::max_element(values, {}, by_goal))[g];
    add_role(static_cast<std::size_t>(best - values.begin()), describe(request.goals[g]));
    for (std::size_t k = 0; k < designs.size(); ++k)
      if (high > low) distance[k] += std::pow((values[k][g] - low) / (high - low), 2);
  }

  // Only several goals have a knee.
  if (request.goals.size() > 1)
    add_role(static_cast<std::size_t>(std::ranges::min_element(distance) - distance.begin()),
             "knee");
}

void DesignRun::add_sensitivities() {
  if (report_.request.tolerances.empty()) return;
  for (Design& design : report_.designs)
    if (!design.role.empty())
      design.sensitivity =
          sensitivity(problem_, design.damper,
                      {.seed = report_.options.seed, .threads = report_.options.threads});
}

void DesignRun::note_warnings() {
  // Where the designs are looked at.
  DamperOperation at;
  const auto widen = [&at](const auto& asked) {
    for (const auto& one : asked) {
      at.current = std::max(at.current, std::abs(one.at.current));
      at.velocity = std::max(at.velocity, std::abs(one.at.velocity));
    }
  };
  widen(report_.request.goals);
  widen(report_.request.constraints);

  // Each warning once, with the names of the designs that it is of.
  std::vector<std::pair<std::string, std::vector<std::string>>> warnings;
  for (const Design& design : report_.designs) {
    if (design.role.empty()) continue;
    const DamperPhysics physics = evaluate_physics(design.damper, at);
    for (const std::string& warning : physics_warnings(design.damper, physics)) {
      auto own = std::ranges::find(warnings, warning, [](const auto& pair) { return pair.first; });
      if (own == warnings.end()) own = warnings.insert(own, {warning, {}});
      own->second.push_back(design.name);
    }
  }
  for (const auto& [warning, names] : warnings)
    report_.notes.push_back(join(names, ", ") + ": " + warning);
}

DesignReport DesignRun::run() {
  const auto start = std::chrono::steady_clock::now();

  // Places to begin at: an earlier front, or the best for each goal; where none is possible, those
  // that show why.
  const bool hopeless = is_hopeless();
  std::vector<std::vector<double>> places;
  if (!hopeless && report_.request.goals.size() > 1) places = earlier_places();
  if (!hopeless && places.empty()) places = best_of_each_goal();
  if (places.empty() && !hopeless && !report_.stopped) places = explain();

  // The front between several goals, and what is to be known of its designs.
  if (report_.request.goals.size() > 1 && !places.empty() && !report_.stopped)
    places = front_from(std::move(places));
  add_designs(places);
  name_roles();
  add_sensitivities();
  note_warnings();

  for (const DesignModel* model : {model_.get(), second_.get()})
    if (model && model->has_refused())
      report_.notes.push_back(
          model->name() +
          " was refused wherever its force does not resist the motion, or less with the current "
          "than without" +
          (report_.options.insist
               ? ""
               : fmt::format(", or lies {} times further from the plate flow's than at a damper of "
                             "its fit",
                             kMostLeap)));

  report_.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return std::move(report_);
}

}  // namespace

Assessment check_design(const std::string& text, const DesignRequest& request,
                        const DesignModel& model, std::uint64_t seed, const DesignModel* second) {
  return DesignProblem(request, model, seed, second).assess(parse_description(text, "design"));
}

DesignReport design(const DesignRequest& request, const DesignOptions& options) {
  return DesignRun(request, options).run();
}

}  // namespace dashpot
