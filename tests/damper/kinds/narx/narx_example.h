#pragma once
#include "dashpot/base/random.h"
#include "dashpot/damper/kinds/narx/narx_model.h"

/// A network for these regressors with random weights; the force has mean 20 and scale 900 N, also
/// where it is fed back.
inline dashpot::Mlp example_narx_network(const dashpot::Regressors& regressors,
                                         std::uint64_t seed = 1, std::size_t hidden = 5) {
  dashpot::Mlp mlp;
  mlp.layers = {regressors.count(), hidden, 1};
  mlp.output_mean = 20;
  mlp.output_scale = 900;
  for (const dashpot::Regressors::Input& input : regressors.inputs)
    for (std::size_t k = 0; k < input.lags.size(); ++k) {
      mlp.input_mean.push_back(input.name == "current" ? 1 : 0);
      mlp.input_scale.push_back(input.name == "velocity" ? 0.1 : 0.5);
    }
  mlp.input_mean.resize(regressors.count(), mlp.output_mean);
  mlp.input_scale.resize(regressors.count(), mlp.output_scale);
  dashpot::Random random(seed);
  mlp.parameters.resize(dashpot::Mlp::parameter_count(mlp.layers));
  for (double& weight : mlp.parameters) weight = 0.4 * random.normal();
  return mlp;
}

/// Velocity now and 1 and 3 steps ago, current 2 steps ago, force 1 and 2 steps ago; steps of 5 ms.
inline dashpot::Regressors example_regressors() {
  return {.inputs = {{"velocity", {0, 1, 3}}, {"current", {2}}},
          .feedback = {1, 2},
          .sample_time = 5e-3};
}
