#include "dashpot/damper/nets/kernel.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "dashpot/base/random.h"
#include "dashpot/damper/nets/mlp_evaluator.h"
#include "dashpot/damper/nets/normal_equations.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr Activation kKinds[] = {Activation::Identity, Activation::Relu, Activation::Tanh,
                                 Activation::Sigmoid};

Mlp network(std::vector<std::size_t> layers, Activation hidden,
            Activation output = Activation::Identity) {
  Mlp mlp;
  Random random(4);
  mlp.activations.assign(layers.size() - 1, hidden);
  mlp.activations.back() = output;

  for (std::size_t k = 0; k < layers.front(); ++k) {
    mlp.input_mean.push_back(random.uniform(-1, 1));
    mlp.input_scale.push_back(random.uniform(0.5, 2));
  }
  mlp.output_mean = 3;
  mlp.output_scale = 20;

  mlp.layers = std::move(layers);
  initialise(mlp, 8);
  for (double& w : mlp.parameters) w += random.uniform(-0.1, 0.1);  // biases too
  return mlp;
}

/// Widths below, at and beyond what fills a vector of lanes, and the widest.
const std::vector<std::vector<std::size_t>> kShapes{
    {1, 1},         {3, 1},       {2, 10, 1},         {8, 15, 15, 15, 1},
    {2, 16, 1},     {5, 7, 9, 1}, {17, 33, 64, 3, 1}, {1, 1, 1},
    {31, 128, 8, 1}};

std::vector<double> random_inputs(std::size_t count) {
  Random random(2);
  std::vector<double> inputs(count);
  for (double& value : inputs) value = random.uniform(-2, 2);
  return inputs;
}

/// Calls check(level, Real{}) for all levels of this processor and both precisions.
template <class Check>
void for_levels(Check check) {
  for (const SimdLevel level : simd_levels()) {
    CAPTURE(static_cast<int>(level));
    check(level, float{});
    check(level, double{});
  }
}

template <class Real>
std::vector<Real> as(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

}  // namespace

TEST_CASE("one sample and many agree with the plain evaluation, at every level and precision") {
  for (const std::vector<std::size_t>& shape : kShapes)
    for (const Activation hidden : kKinds) {
      const Mlp mlp = network(
          shape, hidden, hidden == Activation::Tanh ? Activation::Sigmoid : Activation::Identity);
      const std::size_t width = shape.front(), count = 2 * kBlock + 5;
      const std::vector<double> inputs = random_inputs(width * count);
      for_levels([&]<class Real>(SimdLevel level, Real) {
        const MlpEvaluator<Real> evaluator(mlp, level);
        const std::vector<Real> raw = as<Real>(inputs);
        std::vector<Real> many(count);
        evaluator.evaluate(raw, many);
        const double tolerance = 3000 * static_cast<double>(std::numeric_limits<Real>::epsilon());
        double worst = 0;
        for (std::size_t k = 0; k < count; ++k) {
          const double expected = mlp.evaluate(&inputs[k * width]);
          const double scale = std::abs(expected) + mlp.output_scale;
          worst = std::max(worst, std::abs(evaluator.evaluate(&raw[k * width]) - expected) / scale);
          worst = std::max(worst, std::abs(many[k] - expected) / scale);
        }
        CHECK_CLOSE(worst, 0, 0, tolerance);
      });
    }
}

TEST_CASE("TC-12: a (2,10,1) network, at every level and precision") {
  Mlp mlp = network({2, 10, 1}, Activation::Tanh);
  for (int i = 0; i < 10; ++i) {
    double* w = mlp.parameters.data();
    w[2 * i] = std::sin(i + 1);
    w[2 * i + 1] = std::cos(i + 1);
    w[20 + i] = 0.1 * (i - 4.5);
    w[30 + i] = (i % 2 ? -1.0 : 1.0) / (i + 1);
  }
  mlp.parameters[40] = 0.05;
  mlp.input_mean = {0, 0};
  mlp.input_scale = {1, 1};
  mlp.output_mean = 0;
  mlp.output_scale = 1;
  for_levels([&]<class Real>(SimdLevel level, Real) {
    const MlpEvaluator<Real> evaluator(mlp, level);
    const double tolerance = sizeof(Real) == sizeof(float) ? 3e-7 : 5e-9;
    const Real inputs[] = {Real(0.3), Real(-0.5), 1, 1};
    CHECK_CLOSE(evaluator.evaluate(inputs), -0.40879391, 0, tolerance);
    CHECK_CLOSE(evaluator.evaluate(inputs + 2), 0.53232924, 0, tolerance);
  });
}

TEST_CASE("the kernel's tanh is the tanh") {
  Mlp mlp;
  mlp.layers = {1, 1};
  mlp.activations = {Activation::Tanh};
  mlp.parameters = {1, 0};
  mlp.input_mean = {0};
  mlp.input_scale = {1};
  for_levels([&]<class Real>(SimdLevel level, Real) {
    const MlpEvaluator<Real> evaluator(mlp, level);
    const auto tanh_of = [&](Real x) { return evaluator.evaluate(&x); };
    double worst = 0;
    for (double x = 1e-12; x < 60; x *= 1.003) {
      const Real rounded = static_cast<Real>(x);
      const double expected = std::tanh(static_cast<double>(rounded));
      worst = std::max(worst, std::abs(tanh_of(rounded) / expected - 1));
      CHECK(tanh_of(-rounded) == -tanh_of(rounded));
    }
    CHECK_CLOSE(worst, 0, 0, 5 * static_cast<double>(std::numeric_limits<Real>::epsilon()));
    CHECK(tanh_of(0) == 0);
    CHECK(tanh_of(Real(700)) == 1);
    CHECK(tanh_of(-std::numeric_limits<Real>::infinity()) == -1);
    CHECK(std::isnan(tanh_of(std::numeric_limits<Real>::quiet_NaN())));
  });
}

TEST_CASE("a NaN comes out as one, whatever the activation") {
  const double inputs[] = {std::nan(""), 1};
  for (const Activation kind : kKinds)
    for (const SimdLevel level : simd_levels())
      CHECK(std::isnan(MlpEvaluator<double>(network({2, 10, 1}, kind), level).evaluate(inputs)));
}

namespace {

/// Sum over samples and outputs of weight * output: its derivatives are what a backward pass gives
/// when the weights are its slopes.
struct Weighted {
  Mlp mlp;
  std::size_t samples;
  std::vector<double> inputs, weights;

  Weighted(std::vector<std::size_t> layers, Activation hidden, Activation output, std::size_t count)
      : mlp(network(std::move(layers), hidden, output)), samples(count) {
    inputs = random_inputs(samples * mlp.layers.front());
    weights = random_inputs(samples * mlp.layers.back());
  }

  template <class Real>
  void fill(PaddedNetwork<Real>& net) const {
    for (std::size_t s = 0; s < samples; ++s)
      for (std::size_t k = 0; k < net.inputs(); ++k)
        net.input(s)[k] = static_cast<Real>(inputs[s * net.inputs() + k]);
  }
  double value() const {
    PaddedNetwork<double> net(mlp, samples, SimdLevel::Baseline);
    fill(net);
    net.forward(samples);
    double sum = 0;
    for (std::size_t n = 0; n < net.outputs(); ++n)
      for (std::size_t s = 0; s < samples; ++s) sum += weights[n * samples + s] * net.output(n)[s];
    return sum;
  }
  double difference(double& number) {
    const double middle = number, h = 1e-5;
    number = middle + h;
    const double up = value();
    number = middle - h;
    const double down = value();
    number = middle;
    return (up - down) / (2 * h);
  }
};

/// The largest difference, relative to the largest expected value.
template <class Actual>
double worst_of(const std::vector<double>& expected, Actual actual) {
  double worst = 0, largest = 0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    worst = std::max(worst, std::abs(actual(k) - expected[k]));
    largest = std::max(largest, std::abs(expected[k]));
  }
  return worst / largest;
}

}  // namespace

TEST_CASE("gradients by weights and inputs agree with differences, with any number of outputs") {
  const std::vector<std::vector<std::size_t>> shapes{
      {8, 15, 15, 15, 1}, {2, 10, 1}, {3, 4}, {2, 16, 5, 3}, {17, 18, 2}};
  for (const std::vector<std::size_t>& shape : shapes)
    for (const Activation kind : kKinds) {
      Weighted problem(shape, kind, kind == Activation::Relu ? Activation::Tanh : kind, 20);
      std::vector<double> by_weights, by_inputs;
      for (double& w : problem.mlp.parameters) by_weights.push_back(problem.difference(w));
      for (double& x : problem.inputs) by_inputs.push_back(problem.difference(x));
      for_levels([&]<class Real>(SimdLevel level, Real) {
        PaddedNetwork<Real> net(problem.mlp, problem.samples, level);
        problem.fill(net);
        net.forward(problem.samples);
        for (std::size_t k = 0; k < problem.weights.size(); ++k)
          net.output_slope(k / problem.samples)[k % problem.samples] =
              static_cast<Real>(problem.weights[k]);
        const std::size_t width = net.inputs();
        AlignedVector<Real> input_gradient(problem.samples * padded<Real>(width));
        net.backward(problem.samples, input_gradient.data());
        std::vector<double> gradient(by_weights.size());
        net.get_gradient(gradient);
        CHECK_CLOSE(worst_of(by_weights, [&](std::size_t k) { return gradient[k]; }), 0, 0, 1e-6);
        CHECK_CLOSE(worst_of(by_inputs,
                             [&](std::size_t k) -> double {
                               return input_gradient[k / width * padded<Real>(width) + k % width];
                             }),
                    0, 0, 1e-6);
      });
    }
}

TEST_CASE("parameters go through the padding and back") {
  const Mlp mlp = network({17, 33, 64, 3, 2}, Activation::Relu);
  std::vector<double> back(mlp.parameters.size());
  PaddedNetwork<double>(mlp, 4, SimdLevel::Baseline).get_parameters(back);
  CHECK(back == mlp.parameters);
}

TEST_CASE("normal equations: every level agrees, and threads do not change a bit") {
  Random random(3);
  TrainingSamples samples;
  samples.groups = 3;
  for (std::size_t k = 0; k < 1500; ++k) {
    samples.inputs.insert(samples.inputs.end(), {random.uniform(-1, 1), random.uniform(-1, 1)});
    samples.targets.push_back(random.uniform(-10, 10));
    samples.group.push_back(k % 3);
  }
  for (const Activation kind : kKinds) {
    const Mlp mlp = network({2, 9, 6, 1}, kind);
    const SampleBlocks blocks = make_blocks(mlp, samples, 1e-3);
    const NormalEquations expected =
        BlockErrors(mlp, blocks, 1, SimdLevel::Baseline).normal_equations(mlp.parameters);
    for (const SimdLevel level : simd_levels()) {
      const BlockErrors errors(mlp, blocks, 1, level);
      const NormalEquations one = errors.normal_equations(mlp.parameters);
      CHECK_CLOSE(one.squared_error, expected.squared_error, 1e-12, 0);
      CHECK_CLOSE(errors.squared_error(mlp.parameters), expected.squared_error, 1e-12, 0);
      CHECK_CLOSE(worst_of(expected.matrix, [&](std::size_t k) { return one.matrix[k]; }), 0, 0,
                  1e-12);
      CHECK_CLOSE(worst_of(expected.gradient, [&](std::size_t k) { return one.gradient[k]; }), 0, 0,
                  1e-12);
      const NormalEquations two =
          BlockErrors(mlp, blocks, 2, level).normal_equations(mlp.parameters);
      CHECK(two.matrix == one.matrix);
      CHECK(two.gradient == one.gradient);
      CHECK(two.offsets == one.offsets);
    }
  }
}
