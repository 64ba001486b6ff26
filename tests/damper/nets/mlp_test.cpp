#include "dashpot/damper/nets/mlp.h"

#include <algorithm>
#include <numeric>

#include "dashpot/base/random.h"
#include "dashpot/damper/nets/normal_equations.h"
#include "dashpot/damper/nets/standardise.h"
#include "dashpot/error.h"
#include "support.h"

using namespace dashpot;

namespace {

Mlp plain(std::vector<std::size_t> layers, std::uint64_t seed = 1) {
  Mlp mlp;
  mlp.input_mean.assign(layers.front(), 0.0);
  mlp.input_scale.assign(layers.front(), 1.0);
  mlp.layers = std::move(layers);
  initialise(mlp, seed);
  return mlp;
}

/// Five records of a damper of tanh shape, F = (200 + 900 i) tanh(20 v) + (600 + 1500 i) v, under
/// every current, with an offset per record of (-80 ... 80) N and noise of 30 N.
TrainingSamples noisy_damper(std::size_t count) {
  TrainingSamples samples;
  samples.groups = 5;
  Random random(7);
  for (std::size_t k = 0; k < count; ++k) {
    const double v = random.uniform(-0.3, 0.3), i = random.uniform(0, 2);
    samples.group.push_back(k * samples.groups / count);
    samples.inputs.insert(samples.inputs.end(), {v, i});
    samples.targets.push_back((200 + 900 * i) * std::tanh(20 * v) + (600 + 1500 * i) * v +
                              40.0 * (static_cast<double>(samples.group.back()) - 2) +
                              30 * random.normal());
  }
  return samples;
}

Mlp damper_network() {
  Mlp mlp;
  mlp.layers = {2, 10, 1};
  mlp.input_mean = {0, 1};
  mlp.input_scale = {0.17, 0.58};
  mlp.output_scale = 1200;
  return mlp;
}

/// Cost of the residuals with every group's best offset, from evaluate() alone.
double plain_error(const Mlp& mlp, const TrainingSamples& samples, double offset_decay) {
  std::vector<double> sum(samples.groups), size(samples.groups);
  double squares = 0;
  for (std::size_t k = 0; k < samples.targets.size(); ++k) {
    const double r = (mlp.evaluate(&samples.inputs[k * mlp.layers.front()]) - samples.targets[k]) /
                     mlp.output_scale;
    squares += r * r;
    sum[samples.group[k]] += r;
    size[samples.group[k]] += 1;
  }
  for (std::size_t g = 0; g < samples.groups; ++g)
    squares -= sum[g] * sum[g] / (size[g] * (1 + offset_decay));
  return squares;
}

}  // namespace

TEST_CASE("a network is standardised by its samples; a constant input has scale 1") {
  Mlp mlp = without_weights(2, {3}, Activation::Relu);
  CHECK(mlp.layers == std::vector<std::size_t>{2, 3, 1});
  CHECK(mlp.activations == std::vector{Activation::Relu, Activation::Identity});
  CHECK(mlp.parameters.empty());  // a trainer draws the first ones

  // The mean of ten times 0.1 rounds: what it leaves is no spread.
  TrainingSamples samples;
  for (int k = 0; k < 10; ++k) {
    samples.inputs.insert(samples.inputs.end(), {0.1, k % 2 == 0 ? 1.0 : 5.0});
    samples.targets.push_back(k % 2 == 0 ? -7 : 7);
  }
  standardise(mlp, samples);
  CHECK(mlp.input_mean[0] == doctest::Approx(0.1));
  CHECK(mlp.input_scale[0] == 1);
  CHECK(mlp.input_mean[1] == 3);
  CHECK(mlp.input_scale[1] == 2);
  CHECK(mlp.output_mean == 0);
  CHECK(mlp.output_scale == 7);
}

TEST_CASE("TC-12: a (2,10,1) network") {
  Mlp mlp = plain({2, 10, 1});
  REQUIRE(mlp.parameters.size() == 41);
  for (int i = 0; i < 10; ++i) {
    double* w = mlp.parameters.data();
    w[2 * i] = std::sin(i + 1);
    w[2 * i + 1] = std::cos(i + 1);
    w[20 + i] = 0.1 * (i - 4.5);
    w[30 + i] = (i % 2 ? -1.0 : 1.0) / (i + 1);
  }
  mlp.parameters[40] = 0.05;
  CHECK_CLOSE(mlp.evaluate(std::array{0.3, -0.5}.data()), -0.40879391, 0, 5e-9);
  CHECK_CLOSE(mlp.evaluate(std::array{1.0, 1.0}.data()), 0.53232924, 0, 5e-9);

  mlp.input_mean = {1, -2};  // the same point and output, standardised
  mlp.input_scale = {2, 4};
  mlp.output_mean = 100;
  mlp.output_scale = 1000;
  CHECK_CLOSE(mlp.evaluate(std::array{1.6, -4.0}.data()), 100 - 408.79391, 0, 5e-6);
}

TEST_CASE("parameters are counted and initialised from the seed") {
  CHECK(Mlp::parameter_count({2, 10, 1}) == 41);
  CHECK(Mlp::parameter_count({3, 10, 1}) == 51);
  CHECK(Mlp::parameter_count({8, 15, 15, 15, 1}) == 631);
  CHECK(plain({2, 10, 1}, 5).parameters == plain({2, 10, 1}, 5).parameters);
  CHECK(plain({2, 10, 1}, 5).parameters != plain({2, 10, 1}, 6).parameters);
}

TEST_CASE("error, gradient and normal matrix agree with evaluate() and its differences") {
  for (const std::vector<std::size_t>& layers :
       {std::vector<std::size_t>{2, 10, 1}, {2, 5, 4, 3, 1}}) {
    TrainingSamples samples = noisy_damper(700);  // not a multiple of the block
    std::rotate(samples.group.begin(), samples.group.begin() + 33, samples.group.end());
    Mlp mlp = damper_network();
    mlp.layers = layers;
    initialise(mlp, 3);
    const double decay = 1e-3;
    const SampleBlocks blocks = make_blocks(mlp, samples, decay);
    const BlockErrors errors(mlp, blocks, 1);
    const NormalEquations equations = errors.normal_equations(mlp.parameters);
    CHECK_CLOSE(equations.squared_error, plain_error(mlp, samples, decay), 1e-12, 0);
    CHECK_CLOSE(errors.squared_error(mlp.parameters), equations.squared_error, 1e-12, 0);

    // The gradient of r'r / 2 by central differences; the matrix from Jacobian rows made likewise.
    const std::size_t n = mlp.parameters.size(), m = samples.targets.size();
    std::vector<double> jacobian(m * n);
    const double h = 1e-5;
    for (std::size_t p = 0; p < n; ++p) {
      Mlp up = mlp, down = mlp;
      up.parameters[p] += h;
      down.parameters[p] -= h;
      CHECK_CLOSE(equations.gradient[p],
                  (plain_error(up, samples, decay) - plain_error(down, samples, decay)) / (4 * h),
                  1e-6, 1e-6);
      for (std::size_t k = 0; k < m; ++k) {
        const double* input = &samples.inputs[2 * k];
        jacobian[k * n + p] =
            (up.evaluate(input) - down.evaluate(input)) / (2 * h * mlp.output_scale);
      }
    }
    std::vector<double> size(samples.groups), sums(samples.groups * n);
    for (std::size_t k = 0; k < m; ++k) {
      size[samples.group[k]] += 1;
      for (std::size_t p = 0; p < n; ++p) sums[samples.group[k] * n + p] += jacobian[k * n + p];
    }
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) {
        double expected = 0;
        for (std::size_t k = 0; k < m; ++k) expected += jacobian[k * n + a] * jacobian[k * n + b];
        for (std::size_t g = 0; g < samples.groups; ++g)
          expected -= sums[g * n + a] * sums[g * n + b] / (size[g] * (1 + decay));
        CHECK_CLOSE(equations.matrix[a * n + b], expected, 1e-6, 1e-6);
      }
  }
}

/// Without the decay that guards real fits against invented forces, and to the end.
const TrainOptions kToTheNoise{.max_iterations = 200, .tolerance = 1e-7, .weight_decay = 1e-8};

TEST_CASE("training reaches the noise and finds the offsets" * doctest::test_suite("long")) {
  const TrainingSamples samples = noisy_damper(6000);
  Mlp mlp = damper_network();
  const TrainReport report = train(mlp, samples, kToTheNoise);
  CHECK(report.iterations <= 200);
  CHECK_CLOSE(report.rmse, 30, 0.03, 0);
  REQUIRE(report.offsets.size() == 5);
  CHECK_CLOSE(std::accumulate(report.offsets.begin(), report.offsets.end(), 0.0), 0, 0, 1e-9);
  for (std::size_t g = 0; g < 5; ++g) {
    const double expected =
        40.0 * (static_cast<double>(g) - 2);  // its mean is known to 30 N / sqrt(1200)
    CHECK_CLOSE(report.offsets[g], expected, 0, 3);
  }
  // The network with the mean offset inside is the noiseless damper.
  for (const double v : {-0.2, -0.05, 0.01, 0.1}) {
    const double force = (200 + 900 * 1.5) * std::tanh(20 * v) + (600 + 1500 * 1.5) * v;
    CHECK_CLOSE(mlp.evaluate(std::array{v, 1.5}.data()), force, 0, 15);
  }
  Mlp again = damper_network();
  train(again, samples, kToTheNoise);
  CHECK(again.parameters == mlp.parameters);
}

TEST_CASE("training without groups, with several layers, and with an interruption") {
  TrainingSamples samples = noisy_damper(3000);
  for (std::size_t k = 0; k < samples.targets.size(); ++k)
    samples.targets[k] -= 40.0 * (static_cast<double>(samples.group[k]) - 2) - 500;
  samples.group.clear();
  samples.groups = 0;
  Mlp mlp = damper_network();
  mlp.layers = {2, 6, 5, 1};
  const TrainReport report = train(mlp, samples, kToTheNoise);
  CHECK(report.offsets.empty());
  CHECK_CLOSE(report.rmse, 30, 0.05, 0);
  CHECK_CLOSE(mlp.evaluate(std::array{0.0, 1.0}.data()), 500, 0, 20);

  TrainOptions options;
  options.on_iteration = [](int iteration, double) {
    if (iteration == 3) throw Interrupted();
  };
  CHECK_THROWS_AS(train(mlp, samples, options), Interrupted);
}
