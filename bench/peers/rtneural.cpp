// RTNeural's compile-time models, of the backend that the build chooses, with the same weights.
#include <RTNeural/RTNeural.h>

#include "dashpot/damper/nets/mlp_evaluator.h"
#include "peer.h"

using namespace peer;

namespace {

template <int kInputs, int kOutputs>
using Dense = RTNeural::DenseT<float, kInputs, kOutputs>;
template <int kSize>
using Relu = RTNeural::ReLuActivationT<float, kSize>;
using ReluModel = RTNeural::ModelT<float, 8, 1, Dense<8, 15>, Relu<15>, Dense<15, 15>, Relu<15>,
                                   Dense<15, 15>, Relu<15>, Dense<15, 1>>;
using TanhModel =
    RTNeural::ModelT<float, 2, 1, Dense<2, 10>, RTNeural::TanhActivationT<float, 10>, Dense<10, 1>>;

/// Gives a layer its weights and biases; what follows them.
template <class Layer>
const double* take(Layer& layer, const double* w) {
  std::vector<std::vector<float>> rows(Layer::out_size, std::vector<float>(Layer::in_size));
  std::vector<float> biases(Layer::out_size);
  for (auto& row : rows)
    for (float& weight : row) weight = static_cast<float>(*w++);
  for (float& bias : biases) bias = static_cast<float>(*w++);
  layer.setWeights(rows);
  layer.setBias(biases.data());
  return w;
}
void take_all(ReluModel& model, const double* w) {
  w = take(model.get<4>(), take(model.get<2>(), take(model.get<0>(), w)));
  take(model.get<6>(), w);
}
void take_all(TanhModel& model, const double* w) { take(model.get<2>(), take(model.get<0>(), w)); }

/// Infinite where its output is not Dashpot's.
template <class Model>
double latency(const std::vector<std::size_t>& layers) {
  static Model model;
  take_all(model, network(layers).parameters.data());
  alignas(64) float x[16] = {0.1F, -0.2F, 0.3F, 0.1F, 0.5F, -0.1F, 0.2F, 0.7F};
  const float ours = dashpot::MlpEvaluator<float>(network(layers)).evaluate(x);
  if (!(std::abs(model.forward(x) - ours) <= 1e-5F * (1 + std::abs(ours)))) return HUGE_VAL;
  return time_of(20000, [&] {
    x[0] = 0.1F * model.forward(x);
    asm volatile("" : "+m"(x[0]));
  });
}

}  // namespace

int main() {
  return serve({{"latency_relu", [](int) { return latency<ReluModel>(kRelu); }},
                {"latency_tanh", [](int) { return latency<TanhModel>(kTanh); }}});
}
