#include "dashpot/identify/rank/model_choice.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/passive_network/presets.h"
#include "dashpot/damper/registry.h"
#include "dashpot/error.h"
#include "dashpot/identify/fit/fit.h"
#include "dashpot/identify/fit/network_design.h"

namespace dashpot {
namespace {

constexpr double kCores = 2;  // that a budget is stated for

/// CPU seconds of one fit of a model: so much whatever the records, so much per thousand samples of
/// them, up to as many as the fit reads; and of passive networks per million steps of training.
struct FitCost {
  double per_fit = 0, per_thousand_samples = 0;
  double most_thousands = INFINITY;  // of samples
  double varying = 1;                // times as much where the drive varies within records
  double per_million_steps = 0;
};

// Measured on utfsm, utfpr, nees-2012-1158, sysidentpy-simulated and the virtual bench, rounded. A
// fit of a hysteresis network or a state space counts with what training on until it dissipates
// takes, of which some fits need all and some nothing.
struct ModelCost {
  std::string_view model;
  FitCost cost;
};
constexpr std::array kModelCosts{
    ModelCost{"bingham", {.per_fit = 0.01, .per_thousand_samples = 0.0015, .varying = 2}},
    ModelCost{"tanh_kwok", {.per_fit = 0.03, .per_thousand_samples = 0.0055, .varying = 2}},
    ModelCost{"large_scale_bouc_wen",
              {.per_fit = 0.2, .per_thousand_samples = 0.065, .varying = 2}},
    ModelCost{"modified_bouc_wen", {.per_fit = 0.3, .per_thousand_samples = 0.11, .varying = 2}},
    ModelCost{"extended_bingham", {.per_fit = 0.3, .per_thousand_samples = 0.3, .varying = 2}},
    ModelCost{"passive_network_one_sensor", {.per_fit = 0.5, .per_million_steps = 0.22}},
};

/// Of the models without a row of their own; what has none here either costs as a hybrid does.
struct KindCost {
  ModelKind kind;
  FitCost cost;
};
constexpr std::array kKindCosts{
    KindCost{ModelKind::Law, {.per_fit = 0.1, .per_thousand_samples = 0.04, .varying = 2}},
    KindCost{ModelKind::Network,
             {.per_fit = 0.3, .per_thousand_samples = 0.2, .most_thousands = 10}},
    KindCost{ModelKind::Narx, {.per_fit = 0.5, .per_thousand_samples = 0.5, .most_thousands = 6}},
    KindCost{ModelKind::HysteresisNetwork,
             {.per_fit = 0.9, .per_thousand_samples = 0.65, .most_thousands = 8, .varying = 1.5}},
    KindCost{ModelKind::StateSpace,
             {.per_fit = 3, .per_thousand_samples = 3.1, .most_thousands = 6}},
    KindCost{ModelKind::PassiveNetwork, {.per_fit = 0.5, .per_million_steps = 0.3}},
    KindCost{ModelKind::Fuzzy,
             {.per_fit = 0.1, .per_thousand_samples = 0.04, .most_thousands = 20}},
};
constexpr FitCost kOtherCost{.per_fit = 2, .per_thousand_samples = 0.3, .varying = 2};

FitCost cost_of(const std::string& model) {
  const auto own = std::ranges::find(kModelCosts, model, &ModelCost::model);
  if (own != kModelCosts.end()) return own->cost;
  const auto of_kind = std::ranges::find(kKindCosts, model_info(model).kind, &KindCost::kind);
  return of_kind != kKindCosts.end() ? of_kind->cost : kOtherCost;
}

bool is_model(const std::string& name) {
  for (const auto& names : {model_names(), more_model_names()})
    if (std::ranges::find(names, name) != names.end()) return true;
  return false;
}

bool has_displacement(const std::vector<Record>& records) {
  return std::ranges::all_of(records,
                             [](const Record& r) { return r.find("displacement") != nullptr; });
}

bool varies_within(const std::vector<Record>& records) {
  return std::ranges::any_of(records, [](const Record& r) { return !r.drive_level.has_value(); });
}

/// The models that one word stands for.
std::vector<std::string> models_of(const std::string& word, const std::vector<Record>& records) {
  // Models of a family need what recordings of one damper do not have: each word stands for one of
  // both.
  if (word == "all" || word == "family") {
    std::vector<std::string> names = model_names();
    std::erase_if(names, [&](const std::string& name) {
      return (model_info(name).kind == ModelKind::Family) != (word == "family");
    });
    return names;
  }
  if (word != "usual") return {word};

  // In the order that wins soonest on such data, of the channels that they have. Where the drive
  // varies within records, a passive network learns for longer than most.
  std::vector<std::string> names = usual_models();
  if (varies_within(records)) {
    const auto passive = std::ranges::find(names, "passive_network");
    std::rotate(passive, passive + 1, std::ranges::find(names, "neural_state_space"));
  }
  if (!has_displacement(records))
    std::ranges::replace(names, std::string("passive_network"),
                         std::string("passive_network_one_sensor"));
  return names;
}

/// The minutes that limit a group; 0: none do.
double minutes_for(const FitWords& words, const std::string& group) {
  if (group != "usual" && group != "all") return 0;
  if (!std::isnan(words.budget)) return words.budget;
  return group == "usual" ? kUsualBudget : 0;
}

NetworkDesign design_of(const FitWords& words, const std::string& where) {
  NetworkDesign design;
  for (const std::string& text : words.network) parse_network_setting(text, where, design);
  return design;
}

}  // namespace

const std::vector<std::string>& usual_models() {
  static const std::vector<std::string> names = {"bingham",
                                                 "tanh_kwok",
                                                 "large_scale_bouc_wen",
                                                 "modified_bouc_wen",
                                                 "passive_network",
                                                 "hysteresis_network",
                                                 "extended_bingham",
                                                 "modified_bouc_wen+network",
                                                 "neural_state_space"};
  return names;
}

double expected_seconds(const std::string& model, const Divisions& divisions, DriveUnit drive_unit,
                        const NetworkDesign& design) {
  // A mean is made of fits that are there.
  if (model_info(model).kind == ModelKind::Mean) return 0;

  // A passive hybrid is its network, half of whose trials are made once more, and its law, fitted
  // once and for each of some six trials.
  if (const ModelInfo& info = model_info(model); info.kind == ModelKind::PassiveHybrid) {
    constexpr double kNetworks = 1.4, kLaws = 7;
    const auto seconds = [&](const std::string& part) {
      return expected_seconds(part, divisions, drive_unit, design);
    };
    return kNetworks * seconds("passive_network") + kLaws * seconds(std::string(info.law->name));
  }

  constexpr double kThousand = 1000;
  const FitCost cost = cost_of(model);
  double seconds = 0;
  for (const std::vector<Record>* training : fits_of(divisions)) {
    double samples = 0;
    for (const Record& record : *training) samples += static_cast<double>(record.size());
    seconds += (cost.per_fit +
                cost.per_thousand_samples * std::min(samples / kThousand, cost.most_thousands)) *
               (varies_within(*training) ? cost.varying : 1);
    if (model_info(model).kind == ModelKind::PassiveNetwork)
      seconds += cost.per_million_steps / (kThousand * kThousand) *
                 passive_training_steps(find_preset(passive_network_presets(), model), *training,
                                        drive_unit, design);
  }
  return seconds;
}

ChosenModels choose_models(const std::vector<std::string>& words,
                           const std::vector<Record>& records) {
  const bool displaced = has_displacement(records);
  ChosenModels chosen;
  for (const std::string& word : words)
    for (const std::string& model : models_of(word, records)) {
      const bool fits = displaced || !is_model(model) || !model_info(model).needs_displacement();
      std::vector<std::string>& list = fits ? chosen.names : chosen.passed_over;
      if (std::ranges::find(list, model) == list.end()) list.push_back(model);
    }
  if (!chosen.names.empty() || chosen.passed_over.empty()) return chosen;

  // Nothing is left to fit: say which record is in the way.
  const auto without = std::ranges::find_if(
      records, [](const Record& r) { return r.find("displacement") == nullptr; });
  throw Error(without->name,
              "has no displacement, which " + join(chosen.passed_over, ", ") +
                  (chosen.passed_over.size() == 1 ? " needs" : " need"),
              "'dashpot inspect' says why none was integrated from the velocity; or take models of "
              "velocity and current only, as bingham");
}

ChosenModels choose_models(const FitWords& words, const Dataset& dataset, const LeaveOut& leave_out,
                           const std::string& where) {
  if (!std::isnan(words.budget) && !(words.budget >= 0 && std::isfinite(words.budget)))
    throw Error(where, "is " + format_number(words.budget), "minutes, 0 (no limit) or more");
  ChosenModels chosen = choose_models(words.models, dataset.records);

  // The widest limit counts where several groups are named.
  double minutes = 0;
  for (const std::string& word : words.models)
    if (const double of_group = minutes_for(words, word); of_group > 0)
      minutes = std::max(minutes, of_group);
    else if (word == "all")
      return chosen;
  if (minutes <= 0) return chosen;

  // The models that nobody named: the usual ones in their order, then the others by their cost.
  const Divisions divisions = divide(dataset, leave_out);
  const NetworkDesign design = design_of(words, "--network");
  const auto usual = models_of("usual", dataset.records);
  struct Candidate {
    std::string name;
    double seconds;
    std::ptrdiff_t place;
  };
  std::vector<Candidate> candidates;
  for (const std::string& name : chosen.names) {
    const bool named = std::ranges::find(words.models, name) != words.models.end();
    if (named || model_info(name).kind == ModelKind::Family) continue;
    candidates.push_back({name, expected_seconds(name, divisions, dataset.drive_unit, design),
                          std::ranges::find(usual, name) - usual.begin()});
  }
  std::ranges::stable_sort(candidates, [](const Candidate& a, const Candidate& b) {
    return std::pair(a.place, a.seconds) < std::pair(b.place, b.seconds);
  });

  // Try them up to the first that the budget does not reach.
  FitBudget budget{.minutes = minutes};
  double spent = 0;  // minutes, with those that stay untried
  for (const Candidate& candidate : candidates) {
    const double own = candidate.seconds / 60 / kCores;
    spent += own;
    if (spent <= minutes) {
      budget.expected_minutes = spent;
    } else if (&candidate == &candidates.front() && chosen.names.size() == candidates.size()) {
      // A ranking of nothing helps nobody.
      budget.expected_minutes = spent;
      budget.too_small_for = candidate.name;
    } else {
      budget.untried.push_back(
          {candidate.name, std::string(model_info(candidate.name).title), own, std::ceil(spent)});
      std::erase(chosen.names, candidate.name);
    }
  }
  chosen.budget = std::move(budget);
  return chosen;
}

}  // namespace dashpot
