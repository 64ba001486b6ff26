#include "studies/family/family_document.h"

#include <algorithm>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "studies/family/family_parts.h"

namespace dashpot {
namespace {

std::string ranged(const Spread& spread, int count) {
  if (spread.low == spread.high) return decimals(spread.median, count);
  return fmt::format("{} ({} ... {})", decimals(spread.median, count), decimals(spread.low, count),
                     decimals(spread.high, count));
}

std::string verdict_of(const FamilyStudy& study) {
  const FamilyRule own = own_rule(chosen_architecture());
  const FamilyOutcome* learnt = study.outcome(FamilyProtocol::AllSamples, own);
  const FamilyOutcome* unseen = study.outcome(FamilyProtocol::Geometries, own);
  return fmt::format(
      "On the {} samples that it learns from, the paper's h3x15 leaves a mean absolute error of {} "
      "N with R2 {} (medians of {}); the paper's chart says 0.5115 N, its published weights give "
      "0.714 N and 0.9919. What it is worth for a damper that it has not seen is another figure: "
      "with each geometry left out in turn {} N and R2 {}.",
      study.family.size(), median_mae_text(learnt), median_r2_text(learnt),
      counted(learnt->by_seed.size(), "seed"), median_mae_text(unseen), median_r2_text(unseen));
}

const char* name_of(FamilyProtocol protocol) {
  switch (protocol) {
    case FamilyProtocol::FixedDamper:
      return "one damper, learnt from and judged on";
    case FamilyProtocol::EachDamper:
      return "each damper by itself, learnt from and judged on";
    case FamilyProtocol::RandomSamples:
      return "random samples left out";
    case FamilyProtocol::Geometries:
      return "each geometry left out in turn";
    case FamilyProtocol::Fluids:
      return "each fluid left out in turn";
    default:
      return "all samples, learnt from and judged on";
  }
}

Value spread_json(const Spread& spread) {
  return Value::object({{"median", spread.median}, {"low", spread.low}, {"high", spread.high}});
}

Value outcome_json(const FamilyStudy& study, const FamilyOutcome& outcome) {
  // Each division by itself, over the seeds.
  Value divisions = Value::array();
  const std::vector<FamilyDivision> divided =
      divisions_of(study.family, outcome.experiment.protocol);
  for (std::size_t d = 0; d < divided.size(); ++d)
    divisions.push_back(Value::object({{"name", divided[d].name},
                                       {"mae_N", spread_json(mae_of(outcome.by_division[d]))},
                                       {"r2", spread_json(r2_of(outcome.by_division[d]))}}));

  // All divisions together, with the rule that was trained.
  return Value::object({{"protocol", name_of(outcome.experiment.protocol)},
                        {"architecture", architecture_name(outcome.experiment.rule.hidden)},
                        {"rule", describe(outcome.experiment.rule)},
                        {"seeds", outcome.by_seed.size()},
                        {"mae_N", spread_json(mae_of(outcome.by_seed))},
                        {"r2", spread_json(r2_of(outcome.by_seed))},
                        {"mean_of_seeds", to_json(metrics(outcome.together))},
                        {"divisions", std::move(divisions)},
                        {"seconds", outcome.seconds}});
}

Value model_json(const FamilyModelOutcome& model) {
  return Value::object({{"name", model.name},
                        {"learnt", to_json(metrics(model.learnt))},
                        {"geometries_left_out", to_json(metrics(model.geometries))},
                        {"fluids_left_out", to_json(metrics(model.fluids))}});
}

}  // namespace

std::string decimals(double value, int count) { return fmt::format("{:.{}f}", value, count); }

const family_paper::Published* published_network(const std::string& architecture) {
  for (const family_paper::Published& network : family_paper::kPublished)
    if (architecture == network.architecture) return &network;
  return nullptr;
}

std::string mae_text(const FamilyOutcome* outcome) {
  return outcome ? ranged(mae_of(outcome->by_seed), 3) : "-";
}
std::string r2_text(const FamilyOutcome* outcome) {
  return outcome ? ranged(r2_of(outcome->by_seed), 4) : "-";
}
std::string median_mae_text(const FamilyOutcome* outcome) {
  return outcome ? decimals(mae_of(outcome->by_seed).median, 3) : "-";
}
std::string median_r2_text(const FamilyOutcome* outcome) {
  return outcome ? decimals(r2_of(outcome->by_seed).median, 4) : "-";
}

Document family_document(const FamilyStudy& study, bool of_paper) {
  // Of other recordings, what the models know of dampers that they have not seen.
  Document document;
  if (!of_paper) {
    document.title = "A family of dampers";
    document.subtitle =
        fmt::format("{}, one cycle of each, {} samples",
                    counted(study.family.cycles.size(), "record"), study.family.size());
    document.verdict = skill_verdict(study);
    document.sections = {left_out_section(study)};
    return document;
  }

  // Title and verdict.
  document.title = "The family paper, repeated";
  document.subtitle =
      fmt::format("{}, one cycle of each, {} samples",
                  counted(study.family.cycles.size(), "record"), study.family.size());
  document.verdict = verdict_of(study);

  // Judgement first, then architectures and training, then comparisons and limits.
  document.sections = {family_protocol_section(study),
                       determination_section(study),
                       left_out_section(study),
                       single_damper_section(study),
                       architecture_section(study),
                       penalty_section(study),
                       grid_section(study),
                       history_section(study),
                       comparison_section(study),
                       limits_section(study)};
  return document;
}

Value family_json(const FamilyStudy& study) {
  Value outcomes = Value::array();
  for (const FamilyOutcome& outcome : study.outcomes)
    outcomes.push_back(outcome_json(study, outcome));
  Value models = Value::array();
  for (const FamilyModelOutcome& model : study.models) models.push_back(model_json(model));
  return Value::object({{"format", "dashpot family study 1"},
                        {"records", study.family.cycles.size()},
                        {"samples", study.family.size()},
                        {"experiments", std::move(outcomes)},
                        {"models", std::move(models)},
                        {"seconds", study.seconds}});
}

}  // namespace dashpot
