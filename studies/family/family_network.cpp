#include "studies/family/family_network.h"

#include <algorithm>

#include <fmt/format.h>

#include "dashpot/base/parallel.h"
#include "dashpot/base/random.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/nets/mlp_evaluator.h"
#include "dashpot/damper/nets/standardise.h"
#include "dashpot/damper/nets/train_batches.h"

namespace dashpot {
namespace {

constexpr double kKilopascal = 1000, kMillimetre = 0.001;
/// The authors' units of raw inputs, in SI.
constexpr std::array<double, kFamilyInputs.size()> kRawUnits{1, 1,           1, 1,
                                                             1, kKilopascal, 1, kMillimetre};

void draw_normal_weights(Mlp& mlp, std::uint64_t seed) {
  Random random(seed);
  mlp.parameters.resize(Mlp::parameter_count(mlp.layers));
  for (double& parameter : mlp.parameters) parameter = random.normal();
}

}  // namespace

std::string architecture_name(const std::vector<std::size_t>& hidden) {
  const bool is_even =
      std::ranges::all_of(hidden, [&](std::size_t width) { return width == hidden.front(); });
  if (is_even) return fmt::format("h{}x{}", hidden.size(), hidden.front());
  return fmt::format("{}", fmt::join(hidden, "-"));
}

std::string describe(const FamilyRule& rule) {
  return fmt::format(
      "{}, {} inputs, rate {} {}, batch {}, {} epochs, L2 {}", architecture_name(rule.hidden),
      rule.inputs == FamilyRule::Inputs::Raw ? "raw" : "standardised", format_exact(rule.rate),
      rule.falls ? "falling" : "constant", rule.batch, rule.epochs, format_exact(rule.l2));
}

StudiedNetwork untrained_network(const FamilyRule& rule, const TrainingSamples& samples) {
  StudiedNetwork network;
  network.mlp = without_weights(kFamilyInputs.size(), rule.hidden, Activation::Relu);

  // Raw inputs are only brought to the authors' units; else inputs and force are standardised.
  network.mlp.input_mean.assign(kFamilyInputs.size(), 0);
  network.mlp.input_scale.assign(kRawUnits.begin(), kRawUnits.end());
  if (rule.inputs == FamilyRule::Inputs::Standardised) standardise(network.mlp, samples);
  return network;
}

StudiedNetwork train_family_network(const FamilyRule& rule, const TrainingSamples& samples,
                                    std::uint64_t seed, const Monitor& monitor) {
  // Raw networks start as the authors' do, from normal weights.
  const double begin = cpu_seconds();
  StudiedNetwork network = untrained_network(rule, samples);
  if (rule.inputs == FamilyRule::Inputs::Raw) draw_normal_weights(network.mlp, seed);

  // The rule in the trainer's terms; the history keeps the error of each epoch.
  BatchTrainOptions options;
  options.rate = rule.rate;
  options.schedule.kind = rule.falls ? RateSchedule::Cosine : RateSchedule::Constant;
  options.batch = rule.batch;
  options.epochs = rule.epochs;
  options.l2 = rule.l2;
  options.seed = seed;
  options.on_epoch = [&](int, double rmse) {
    monitor.check();
    network.history.push_back(rmse);
  };

  // The CPU time includes the drawing of first weights.
  train_batches(network.mlp, samples, options);
  network.seconds = cpu_seconds() - begin;
  return network;
}

std::vector<double> forces_at(const Mlp& mlp, const TrainingSamples& samples,
                              const std::vector<std::size_t>& indices) {
  std::vector<double> forces(indices.size());
  MlpEvaluator<double>(mlp).evaluate(chosen(samples, indices).inputs, forces);
  return forces;
}

ErrorSums errors_at(const TrainingSamples& samples, const std::vector<std::size_t>& indices,
                    const std::vector<double>& forces) {
  ErrorSums sums;
  for (std::size_t k = 0; k < indices.size(); ++k) sums.add(samples.targets[indices[k]], forces[k]);
  return sums;
}

}  // namespace dashpot
