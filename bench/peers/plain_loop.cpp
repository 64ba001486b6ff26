// What one writes by hand for one network: arrays of fixed size, weights as the network has them.
#include "peer.h"

using namespace peer;

namespace {

template <std::size_t kInputs, std::size_t kOutputs>
struct Layer {
  float weights[kInputs][kOutputs];  // input by input, so that the inner loop is one of lanes
  float biases[kOutputs];

  const double* take(const double* w) {
    for (std::size_t n = 0; n < kOutputs; ++n)
      for (std::size_t i = 0; i < kInputs; ++i) weights[i][n] = static_cast<float>(*w++);
    for (float& b : biases) b = static_cast<float>(*w++);
    return w;
  }
  template <class Activation>
  void apply(const float* in, float* out, Activation activation) const {
    for (std::size_t n = 0; n < kOutputs; ++n) out[n] = biases[n];
    for (std::size_t i = 0; i < kInputs; ++i)
      for (std::size_t n = 0; n < kOutputs; ++n) out[n] += weights[i][n] * in[i];
    for (std::size_t n = 0; n < kOutputs; ++n) out[n] = activation(out[n]);
  }
};

float relu(float x) { return x > 0 ? x : 0; }
float identity(float x) { return x; }

double latency_relu(int) {
  static Layer<8, 15> first;
  static Layer<15, 15> second, third;
  static Layer<15, 1> last;
  const dashpot::Mlp mlp = network(kRelu);
  last.take(third.take(second.take(first.take(mlp.parameters.data()))));
  float x[8] = {0.1F, -0.2F, 0.3F, 0.1F, 0.5F, -0.1F, 0.2F, 0.7F};
  return time_of(20000, [&] {
    float a[15], b[15], c[15], y[1];
    first.apply(x, a, relu);
    second.apply(a, b, relu);
    third.apply(b, c, relu);
    last.apply(c, y, identity);
    x[0] = 0.1F * y[0];
    asm volatile("" : "+m"(x[0]));
  });
}

double latency_tanh(int) {
  static Layer<2, 10> first;
  static Layer<10, 1> last;
  const dashpot::Mlp mlp = network(kTanh);
  last.take(first.take(mlp.parameters.data()));
  float x[2] = {0.1F, -0.2F};
  return time_of(20000, [&] {
    float a[10], y[1];
    first.apply(x, a, [](float z) { return std::tanh(z); });
    last.apply(a, y, identity);
    x[0] = 0.1F * y[0];
    asm volatile("" : "+m"(x[0]));  // or the compiler finds out that nobody looks
  });
}

}  // namespace

int main() { return serve({{"latency_relu", latency_relu}, {"latency_tanh", latency_tanh}}); }
