// The experiments that the tables and figures of the family paper ask for.
#include <algorithm>

#include "studies/family/family_study.h"

namespace dashpot {
namespace {

using Architecture = std::vector<std::size_t>;

constexpr std::size_t kFewSeeds = 3;
constexpr std::size_t kLargeNetwork = 5000;  // parameters; one training of it takes seconds

/// Several divisions mean as many trainings of each seed: half the seeds serve.
std::size_t seeds_left_out(std::size_t seeds) { return (seeds + 1) / 2; }

std::size_t seeds_for(const Architecture& hidden, std::size_t seeds) {
  Architecture layers{kFamilyInputs.size()};
  layers.insert(layers.end(), hidden.begin(), hidden.end());
  layers.push_back(1);
  return Mlp::parameter_count(layers) > kLargeNetwork ? std::min(seeds, kFewSeeds) : seeds;
}

void add_architectures(std::vector<FamilyExperiment>& all, std::size_t seeds) {
  for (const Architecture& hidden : family_architectures())
    for (const FamilyRule& rule : {own_rule(hidden), authors_rule(hidden)})
      all.push_back({FamilyProtocol::AllSamples, rule, seeds_for(hidden, seeds)});
  for (const Architecture& hidden : single_architectures()) {
    for (const FamilyRule& rule : {own_single_rule(hidden), authors_rule(hidden)})
      all.push_back({FamilyProtocol::FixedDamper, rule, seeds});
    all.push_back(
        {FamilyProtocol::EachDamper, own_single_rule(hidden), std::min(seeds, kFewSeeds)});
  }
  for (const Architecture& hidden : history_architectures())
    all.push_back({FamilyProtocol::AllSamples, printed_rule(hidden),
                   hidden == chosen_architecture() ? seeds : std::min(seeds, kFewSeeds)});
}

void add_training(std::vector<FamilyExperiment>& all, std::size_t seeds) {
  for (const double l2 : kStudiedPenalties) {
    all.push_back({FamilyProtocol::AllSamples, penalised_rule(l2), seeds});
    all.push_back({FamilyProtocol::Geometries, penalised_rule(l2), seeds_left_out(seeds)});
  }
  for (const double rate : kStudiedRates)
    for (const std::size_t batch : kStudiedBatches)
      for (const bool is_own : {true, false})
        all.push_back({FamilyProtocol::AllSamples, grid_rule(is_own, rate, batch),
                       std::min(seeds, kFewSeeds)});
}

void add_left_out(std::vector<FamilyExperiment>& all, std::size_t seeds) {
  for (const Architecture& hidden : judged_architectures())
    for (const FamilyProtocol protocol : {FamilyProtocol::Geometries, FamilyProtocol::Fluids})
      all.push_back({protocol, own_rule(hidden), seeds_left_out(seeds)});
  for (const FamilyRule& rule :
       {printed_rule(chosen_architecture()), authors_rule(chosen_architecture()),
        own_rule(chosen_architecture())}) {
    for (const FamilyProtocol protocol :
         {FamilyProtocol::AllSamples, FamilyProtocol::RandomSamples})
      all.push_back({protocol, rule, seeds});
    for (const FamilyProtocol protocol : {FamilyProtocol::Geometries, FamilyProtocol::Fluids})
      all.push_back({protocol, rule, seeds_left_out(seeds)});
  }
}

}  // namespace

FamilyRule printed_rule(Architecture hidden) {
  FamilyRule rule = authors_rule(std::move(hidden));
  rule.rate = 1e-4;
  rule.batch = 20;
  return rule;
}

FamilyRule authors_rule(Architecture hidden) {
  return {.hidden = std::move(hidden), .inputs = FamilyRule::Inputs::Raw, .falls = false};
}

FamilyRule own_rule(Architecture hidden) { return {.hidden = std::move(hidden)}; }

FamilyRule own_single_rule(Architecture hidden) {
  return {.hidden = std::move(hidden), .batch = 20, .epochs = 1000};
}

FamilyRule penalised_rule(double l2) {
  FamilyRule rule = own_rule(chosen_architecture());
  rule.l2 = l2;
  return rule;
}

FamilyRule grid_rule(bool is_own, double rate, std::size_t batch) {
  FamilyRule rule = is_own ? own_rule(chosen_architecture()) : authors_rule(chosen_architecture());
  rule.rate = rate;
  rule.batch = batch;
  return rule;
}

Architecture chosen_architecture() { return {15, 15, 15}; }

const std::vector<Architecture>& single_architectures() {
  static const std::vector<Architecture> all{{10}, {9, 9}, {10, 10, 10}, {20, 20, 20}};
  return all;
}

const std::vector<Architecture>& family_architectures() {
  static const std::vector<Architecture> all{{10},         {50},         {9, 9},
                                             {100, 100},   {10, 10, 10}, {15, 15, 15},
                                             {20, 20, 20}, {30, 30, 30}, {100, 100, 100}};
  return all;
}

const std::vector<Architecture>& history_architectures() {
  static const std::vector<Architecture> all{{10, 10, 10}, {15, 15, 15}, {30, 30, 30}};
  return all;
}

const std::vector<Architecture>& judged_architectures() {
  static const std::vector<Architecture> all{
      {10}, {9, 9}, {10, 10, 10}, {15, 15, 15}, {30, 30, 30}};
  return all;
}

std::vector<FamilyExperiment> family_experiments(std::size_t seeds) {
  std::vector<FamilyExperiment> all;
  add_architectures(all, seeds);
  add_training(all, seeds);
  add_left_out(all, seeds);
  return all;
}

}  // namespace dashpot
