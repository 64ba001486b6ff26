#include "dashpot/identify/rank/model_choice.h"

#include <algorithm>

#include "dashpot/damper/registry.h"
#include "dashpot/report/ranking_words.h"
#include "identify/small_campaign.h"
#include "support.h"

using namespace dashpot;

namespace {

const LeaveOut kByMotion{.by = LeaveOut::By::Condition};

/// Two motions at two currents, so three fits of each model.
const Dataset& two_motions() {
  static const Dataset dataset = small_campaign({{0.01, 1}, {0.005, 3}});
  return dataset;
}

ChosenModels choose(std::vector<std::string> models, double budget,
                    const Dataset& dataset = two_motions()) {
  FitWords words;
  words.models = std::move(models);
  words.budget = budget;
  return choose_models(words, dataset, kByMotion, "--budget");
}

std::vector<std::string> untried_of(const ChosenModels& chosen) {
  std::vector<std::string> names;
  for (const UntriedModel& model : chosen.budget.value().untried) names.push_back(model.name);
  return names;
}

double minutes_of(const std::vector<std::string>& models) {
  const Divisions divisions = divide(two_motions(), kByMotion);
  double seconds = 0;
  for (const std::string& model : models)
    seconds += expected_seconds(model, divisions, two_motions().drive_unit);
  return seconds / 60 / 2;
}

}  // namespace

TEST_CASE("a growing budget tries more of the usual models, in their order") {
  const std::vector<std::string>& usual = usual_models();
  std::vector<std::string> reached;
  for (const std::string& model : usual) {
    reached.push_back(model);
    CAPTURE(model);
    const ChosenModels chosen = choose({"usual"}, 1.0001 * minutes_of(reached));
    CHECK(chosen.names == reached);
    CHECK(untried_of(chosen) ==
          std::vector(usual.begin() + static_cast<std::ptrdiff_t>(reached.size()), usual.end()));
    CHECK_CLOSE(chosen.budget->expected_minutes, minutes_of(reached), 0, 1e-9);
  }
}

TEST_CASE("the budget that is named for an untried model tries it, and not a whole minute less") {
  const Dataset dataset = small_campaign({{0.01, 1}, {0.005, 3}, {0.02, 0.5}, {0.002, 5}},
                                         {.drive_levels = {0, 0.25, 0.5, 0.75, 1}});
  const ChosenModels few = choose({"all"}, 0.1, dataset);
  REQUIRE(!few.budget.value().untried.empty());
  const UntriedModel last = few.budget->untried.back();
  REQUIRE(last.budget_minutes > 1);
  CHECK(untried_of(choose({"all"}, last.budget_minutes, dataset)).empty());
  CHECK(untried_of(choose({"all"}, last.budget_minutes - 1, dataset)).back() == last.name);
}

TEST_CASE("a mean that is named beside a group costs nothing") {
  const ChosenModels chosen =
      choose({"usual", "mean"}, minutes_of({"bingham", "tanh_kwok"}) * 1.01);
  CHECK(chosen.names == std::vector<std::string>{"bingham", "tanh_kwok", "mean"});
  CHECK(minutes_of({"mean"}) == 0);
}

TEST_CASE("a budget of 0 is no limit, and 'all' has none unless one is stated") {
  CHECK(choose({"usual"}, 0).names == usual_models());
  CHECK_FALSE(choose({"usual"}, 0).budget);
  const ChosenModels all = choose({"all"}, kNaN);
  CHECK_FALSE(all.budget);
  CHECK(all.names.size() > 30);
  CHECK(choose({"all"}, 0.5).names.size() < all.names.size());
}

TEST_CASE("unless it is stated, the usual models have the usual budget") {
  CHECK(choose({"usual"}, kNaN).budget.value().minutes == kUsualBudget);
}

TEST_CASE("a budget too small for any model still tries the cheapest, and says so") {
  const ChosenModels chosen = choose({"usual"}, 1e-9);
  REQUIRE(chosen.names.size() == 1);
  for (const std::string& model : usual_models())
    CHECK(minutes_of(chosen.names) <= minutes_of({model}));
  CHECK(chosen.budget.value().too_small_for == chosen.names.front());
  Ranking ranking;
  ranking.budget = chosen.budget;
  CHECK(contains(budget_note(ranking).value(),
                 "No model can be fitted within 1e-09 min on two cores: the cheapest, "));
}

TEST_CASE("models that are named are never dropped, whatever they cost") {
  const std::vector<std::string> named = {"neural_state_space", "hysteresis_network"};
  CHECK(choose(named, 1e-9).names == named);
  CHECK_FALSE(choose(named, 1e-9).budget);

  // Beside a group that the budget does not reach, and as a member of it.
  CHECK(choose({"usual", "neural_state_space"}, 1e-9).names ==
        std::vector<std::string>{"neural_state_space"});
  const ChosenModels both = choose({"passive_network", "usual"}, 1e-9);
  CHECK(both.names == std::vector<std::string>{"passive_network"});
  CHECK(both.budget.value().too_small_for.empty());
  CHECK(std::ranges::count(untried_of(both), "passive_network") == 0);
}

TEST_CASE("without a displacement the passive network of one sensor stands for the other") {
  Dataset blind = two_motions();
  for (Record& record : blind.records)
    std::erase_if(record.channels, [](const Channel& c) { return c.name == "displacement"; });
  const ChosenModels chosen = choose({"usual"}, 0, blind);
  CHECK(std::ranges::count(chosen.names, "passive_network_one_sensor") == 1);
  CHECK(std::ranges::count(chosen.names, "passive_network") == 0);
  for (const std::string& name : chosen.names) CHECK(!model_info(name).needs_displacement());
}

TEST_CASE("where the drive varies within records the hysteresis network comes before the passive") {
  const auto first_of_both = [](const Dataset& dataset) {
    for (const std::string& name : choose({"usual"}, 0, dataset).names)
      if (name == "passive_network" || name == "hysteresis_network") return name;
    return std::string();
  };
  Dataset varying = two_motions();
  for (Record& record : varying.records) record.drive_level.reset();
  CHECK(first_of_both(two_motions()) == "passive_network");
  CHECK(first_of_both(varying) == "hysteresis_network");
}

TEST_CASE("costs follow the data: more records cost more, fewer updates of a network less") {
  const Divisions two = divide(two_motions(), kByMotion);
  const Divisions four =
      divide(small_campaign({{0.01, 1}, {0.005, 3}, {0.02, 0.5}, {0.002, 5}}), kByMotion);
  for (const std::string& model : usual_models()) {
    CAPTURE(model);
    CHECK(expected_seconds(model, four, DriveUnit::Ampere) >
          expected_seconds(model, two, DriveUnit::Ampere));
  }
  CHECK(expected_seconds("passive_network", two, DriveUnit::Ampere, {.epochs = 100}) <
        0.2 * expected_seconds("passive_network", two, DriveUnit::Ampere));
}

TEST_CASE("what was not tried is said with its cost and with the budget that tries it") {
  Ranking ranking;
  CHECK_FALSE(budget_note(ranking));
  ranking.budget = FitBudget{.minutes = 2, .expected_minutes = 1};
  CHECK_FALSE(budget_note(ranking));
  ranking.budget->untried = {{"neural_state_space", "Neural state space", 6, 8}};
  CHECK(budget_note(ranking) ==
        "Not tried within 2 min on two cores: neural_state_space (about 6 min); --budget 8 tries "
        "it too.");
  ranking.budget->untried.push_back({"anfis", "ANFIS", 0.4, 9});
  CHECK(budget_note(ranking) ==
        "Not tried within 2 min on two cores: neural_state_space (about 6 min), anfis (about 30 "
        "s); --budget 8 tries the first too, --budget 9 tries all.");
}

TEST_CASE("a budget that is none is refused with where it stands") {
  for (const double wrong : {-1.0, kInfinity})
    CHECK(contains(message_of([&] { choose({"usual"}, wrong); }), "--budget"));
}

TEST_CASE("unasked, a passive network is tried on many motions, too") {
  // A fit without each of 20 motions would take all of the time that a law leaves.
  std::vector<SineMotion> motions;
  for (int k = 0; k < 20; ++k) motions.push_back({0.004 + 0.0005 * k, 0.5 + 0.1 * k});
  const Dataset dataset = small_campaign(motions);
  FitWords words;
  words.models = {"usual"};
  const ChosenModels chosen = choose_models(words, dataset, default_leave_out(dataset), "--budget");
  CHECK(std::ranges::find(chosen.names, "passive_network") != chosen.names.end());
}
