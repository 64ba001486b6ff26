#include "studies/ride_rank/ride_rank_document.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/report/words.h"

namespace dashpot {
namespace {

using Cases = std::vector<RideRankCase>;

Cases those(std::span<const RideRankCase> cases,
            const std::function<bool(const RideRankCase&)>& wanted) {
  Cases chosen;
  std::ranges::copy_if(cases, std::back_inserter(chosen), wanted);
  return chosen;
}

bool was_chosen_on(const RideRankCase& one) {
  return std::ranges::find(true_dampers().first(kChosenOn), one.truth, &TrueDamperParts::name) !=
         true_dampers().first(kChosenOn).end();
}

DocumentTable quality_table(std::string title, std::string first) {
  return {.title = std::move(title),
          .columns = {{.title = std::move(first), .elastic = true},
                      {.title = "rides", .numeric = true},
                      {.title = "predicted", .numeric = true},
                      {.title = "ESR", .numeric = true},
                      {.title = "predicted picks", .numeric = true},
                      {.title = "ESR picks", .numeric = true},
                      {.title = "covered %", .numeric = true, .priority = 1}},
          .rows = {}};
}

void add_quality(DocumentTable& table, const std::string& name, const Cases& cases) {
  const RideRankQuality q = quality_of(cases);
  if (q.cases == 0) return;
  const auto two = [](double value) { return fmt::format("{:.2f}", value); };
  table.rows.push_back({name, std::to_string(q.cases), two(q.predicted.correlation),
                        two(q.esr.correlation), two(q.predicted.regret), two(q.esr.regret),
                        percent_text(100 * q.covered)});
}

/// A row for each name that a case has, in the order of the cases.
DocumentTable table_by(const char* title, const char* first, std::span<const RideRankCase> cases,
                       std::string RideRankCase::* name) {
  DocumentTable table = quality_table(title, first);
  std::vector<std::string> seen;
  for (const RideRankCase& one : cases) {
    if (std::ranges::find(seen, one.*name) != seen.end()) continue;
    seen.push_back(one.*name);
    add_quality(table, one.*name,
                those(cases, [&](const RideRankCase& c) { return c.*name == one.*name; }));
  }
  return table;
}

DocumentTable ride_table(std::span<const RideRankCase> cases) {
  DocumentTable table{.title = "",
                      .columns = {{"damper"},
                                  {"road"},
                                  {"controller"},
                                  {"model"},
                                  {"ESR %", true},
                                  {"predicted %", true},
                                  {"low", true},
                                  {"high", true},
                                  {"true %", true}},
                      .rows = {},
                      .audience = Audience::Page};

  // A row for each model in each ride.
  for (const RideRankCase& one : cases)
    for (const PredictedAndTrue& m : one.models)
      table.rows.push_back({one.truth, one.road, one.controller, m.model, percent_text(m.esr),
                            percent_text(m.predicted.value), percent_text(m.predicted.low),
                            percent_text(m.predicted.high), percent_text(m.truth)});
  return table;
}

std::string verdict_of(const RideRankQuality& all) {
  if (all.cases == 0)
    return "No ride had three models that can be ridden: there is no order to tell.";
  return fmt::format(
      "Rank correlation with the true error of the ride: {:.2f} of the predicted error, {:.2f} "
      "of the ESR on the bench. The model that is predicted to be best has {:.2f} times the "
      "error of the best there is, the one of least ESR {:.2f} times. {} % of the true errors "
      "lie within the predicted 90 % intervals.",
      all.predicted.correlation, all.esr.correlation, all.predicted.regret, all.esr.regret,
      percent_text(100 * all.covered));
}

}  // namespace

Document ride_rank_document(std::span<const RideRankCase> cases,
                            const RideRankStudyOptions& options) {
  const RideRankQuality all = quality_of(cases);
  Document document{.title = "Ranking by the ride, where the damper is known",
                    .subtitle = counted(cases.size(), "ride") + " of " + options.plant,
                    .verdict = verdict_of(all),
                    .sections = {},
                    .command = {},
                    .version = {},
                    .date = {}};

  // Dampers that the method was chosen on, and those that judge it.
  DocumentTable parts = quality_table("", "dampers");
  add_quality(parts, "those that the method was chosen on", those(cases, was_chosen_on));
  add_quality(parts, "the others, which judge it", those(cases, std::not_fn(was_chosen_on)));
  parts.note =
      "Spearman's rank correlation with the true error of the ride, mean over the rides: of the "
      "predicted error and of ESR. Picks: the true error of the model that stands first, over the "
      "least of all models. Covered: true errors within the predicted 90 % intervals.";
  document.sections.push_back(
      {.name = "orders",
       .title = "Which order is right",
       .paragraphs = {},
       .tables = {std::move(parts), table_by("By damper", "damper", cases, &RideRankCase::truth),
                  table_by("By road", "road", cases, &RideRankCase::road),
                  table_by("By controller", "controller", cases, &RideRankCase::controller)}});

  // How the dampers are built, and every figure.
  DocumentTable truths{.title = "", .columns = {{"damper"}, {"built as"}}, .rows = {}};
  for (const TrueDamperParts& truth : true_dampers())
    truths.rows.push_back({std::string(truth.name), std::string(truth.what)});
  document.sections.push_back(
      {.name = "dampers", .title = "The dampers", .paragraphs = {}, .tables = {std::move(truths)}});
  document.sections.push_back({.name = "rides",
                               .title = "Every model in every ride",
                               .paragraphs = {},
                               .tables = {ride_table(cases)},
                               .audience = Audience::Page});
  return document;
}

Value ride_rank_json(std::span<const RideRankCase> cases) {
  // Each ride with its models, then how well the orders were told over all of them.
  Value list = Value::array();
  for (const RideRankCase& one : cases) {
    Value models = Value::array();
    for (const PredictedAndTrue& m : one.models)
      models.push_back(Value::object({{"model", m.model},
                                      {"esr_percent", m.esr},
                                      {"predicted_percent", m.predicted.value},
                                      {"low_percent", m.predicted.low},
                                      {"high_percent", m.predicted.high},
                                      {"true_percent", m.truth}}));
    list.push_back(Value::object({{"damper", one.truth},
                                  {"road", one.road},
                                  {"controller", one.controller},
                                  {"models", std::move(models)}}));
  }

  const RideRankQuality all = quality_of(cases);
  return Value::object({{"predicted_correlation", all.predicted.correlation},
                        {"esr_correlation", all.esr.correlation},
                        {"predicted_regret", all.predicted.regret},
                        {"esr_regret", all.esr.regret},
                        {"covered", all.covered},
                        {"rides", std::move(list)}});
}

}  // namespace dashpot
