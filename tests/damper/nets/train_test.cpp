#include <algorithm>
#include <limits>
#include <numeric>

#include "dashpot/base/random.h"
#include "dashpot/damper/nets/ensemble.h"
#include "dashpot/damper/nets/flush_to_zero.h"
#include "dashpot/damper/nets/train_batches.h"
#include "dashpot/damper/nets/train_lbfgs.h"
#include "dashpot/error.h"
#include "support.h"

using namespace dashpot;

namespace {

/// One standardised input in (-1, 1), the target a x + b, and noise.
TrainingSamples line(std::size_t count, double noise, std::uint64_t seed = 5) {
  TrainingSamples samples;
  Random random(seed);
  for (std::size_t k = 0; k < count; ++k) {
    samples.inputs.push_back(random.uniform(-1, 1));
    samples.targets.push_back(0.7 * samples.inputs.back() - 0.2 + noise * random.normal());
  }
  return samples;
}

/// sin(3x), which a handful of neurons can follow.
TrainingSamples wave(std::size_t count, double noise, std::uint64_t seed = 6) {
  TrainingSamples samples = line(count, 0, seed);
  Random random(seed + 1);
  for (std::size_t k = 0; k < count; ++k)
    samples.targets[k] = std::sin(3 * samples.inputs[k]) + noise * random.normal();
  return samples;
}

Mlp network(std::vector<std::size_t> layers) {
  Mlp mlp;
  mlp.input_mean.assign(layers.front(), 0.0);
  mlp.input_scale.assign(layers.front(), 1.0);
  mlp.layers = std::move(layers);
  return mlp;
}

/// Slope and intercept of the least squares line, by the textbook formula.
std::array<double, 2> regression(const TrainingSamples& samples) {
  const auto n = static_cast<double>(samples.targets.size());
  double x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t k = 0; k < samples.targets.size(); ++k) {
    x += samples.inputs[k];
    y += samples.targets[k];
    xx += samples.inputs[k] * samples.inputs[k];
    xy += samples.inputs[k] * samples.targets[k];
  }
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  return {slope, (y - slope * x) / n};
}

const Optimiser kOptimisers[] = {Optimiser::Sgd, Optimiser::Momentum, Optimiser::RmsProp,
                                 Optimiser::Adam, Optimiser::AdamW};

}  // namespace

TEST_CASE("every optimiser reaches the least squares line, in both precisions") {
  const TrainingSamples samples = line(400, 0.1);
  const auto [slope, intercept] = regression(samples);
  for (const Optimiser optimiser : kOptimisers)
    for (const bool single : {true, false}) {
      CAPTURE(static_cast<int>(optimiser));
      Mlp mlp = network({1, 1});
      BatchTrainOptions options{.optimiser = optimiser, .rate = 0.02, .epochs = 200};
      options.schedule.kind = RateSchedule::Cosine;  // so that the noise of the batches dies out
      options.single_precision = single;
      const TrainReport report = train_batches(mlp, samples, options);
      CHECK_CLOSE(mlp.parameters[0], slope, 0, 2e-4);
      CHECK_CLOSE(mlp.parameters[1], intercept, 0, 2e-4);
      CHECK_CLOSE(report.rmse, 0.1, 0.1, 0);
      CHECK(report.iterations == 200);
    }
}

TEST_CASE("one step of each optimiser is the textbook's") {
  // One sample x = 1, t = 0, w = 0.5, b = 0.25: output 0.75, gradient 1.5 by both.
  TrainingSamples samples;
  samples.inputs = {1};
  samples.targets = {0};
  const double g = 1.5 + 0.01 * 0.5 + 0.02;  // l2 w + l1 sign(w)
  const auto step = [&](Optimiser optimiser) {
    Mlp mlp = network({1, 1});
    mlp.parameters = {0.5, 0.25};
    BatchTrainOptions options{
        .optimiser = optimiser, .rate = 0.1, .epochs = 1, .l1 = 0.02, .l2 = 0.01};
    options.decay = optimiser == Optimiser::AdamW ? 0.3 : 0;
    options.single_precision = false;
    train_batches(mlp, samples, options);
    return 0.5 - mlp.parameters[0];
  };
  CHECK_CLOSE(step(Optimiser::Sgd), 0.1 * g, 1e-12, 0);
  CHECK_CLOSE(step(Optimiser::Momentum), 0.1 * g, 1e-12, 0);
  CHECK_CLOSE(step(Optimiser::RmsProp), 0.1 * g / (std::sqrt(0.001 * g * g) + 1e-8), 1e-12, 0);
  CHECK_CLOSE(step(Optimiser::Adam), 0.1 * g / (g + 1e-8), 1e-12, 0);
  CHECK_CLOSE(step(Optimiser::AdamW), 0.1 * g / (g + 1e-8) + 0.1 * 0.3 * 0.5, 1e-12, 0);
}

TEST_CASE("schedules") {
  Schedule schedule{.warm_up = 2};
  CHECK_CLOSE(schedule.share(1, 10), 0.5, 1e-15, 0);
  CHECK(schedule.share(5, 10) == 1);
  schedule = {.kind = RateSchedule::Step, .step_epochs = 3, .step_factor = 0.5};
  CHECK(schedule.share(2.9, 10) == 1);
  CHECK(schedule.share(6.1, 10) == 0.25);
  schedule = {.kind = RateSchedule::Cosine, .warm_up = 2, .final_share = 0.1};
  CHECK_CLOSE(schedule.share(2, 10), 1, 1e-15, 0);
  CHECK_CLOSE(schedule.share(6, 10), 0.55, 1e-15, 0);
  CHECK_CLOSE(schedule.share(10, 10), 0.1, 1e-14, 0);
}

TEST_CASE("a weight that only L1 or L2 moves goes to zero, as far as it should") {
  TrainingSamples samples;  // target x: w + l2 / 2 penalty has its minimum at 1 / (1 + l2 / 2)
  samples.inputs = {-1, 1};
  samples.targets = {-1, 1};
  Mlp mlp = network({1, 1});
  BatchTrainOptions options{.optimiser = Optimiser::Sgd, .rate = 0.05, .epochs = 500, .l2 = 0.5};
  train_batches(mlp, samples, options);
  CHECK_CLOSE(mlp.parameters[0], 1 / 1.25, 0, 1e-5);
  mlp.parameters.clear();
  options.l2 = 0;
  options.l1 = 0.5;  // (w - 1)^2 + l1 |w|: minimum at 1 - l1 / 2
  train_batches(mlp, samples, options);
  CHECK_CLOSE(mlp.parameters[0], 0.75, 0, 1e-5);
}

TEST_CASE("L-BFGS finds the ridge solution of a line, and fits a wave") {
  const TrainingSamples samples = line(300, 0.1);
  Mlp mlp = network({1, 1});
  LbfgsOptions options;
  options.weight_decay = 0;
  options.tolerance = 1e-14;
  const TrainReport report = train_lbfgs(mlp, samples, options);
  const auto [slope, intercept] = regression(samples);
  CHECK(report.converged);
  CHECK_CLOSE(mlp.parameters[0], slope, 1e-6, 0);
  CHECK_CLOSE(mlp.parameters[1], intercept, 1e-6, 0);

  options.threads = 2;
  options.weight_decay = 1e-6;
  Mlp wavy = network({1, 6, 1}), serial = wavy;
  CHECK(train_lbfgs(wavy, wave(300, 0), options).rmse < 0.01);
  options.threads = 1;
  train_lbfgs(serial, wave(300, 0), options);
  CHECK(serial.parameters == wavy.parameters);
}

TEST_CASE("Levenberg-Marquardt gives the same bits on two threads as on one") {
  const TrainingSamples samples = wave(1500, 0.1);
  Mlp one = network({1, 6, 1}), two = one;
  train(one, samples, {.max_iterations = 20, .threads = 1});
  train(two, samples, {.max_iterations = 20, .threads = 2});
  CHECK(one.parameters == two.parameters);
}

TEST_CASE("Bayesian regularisation counts the parameters that the data determine") {
  // Far more neurons than the wave needs, few noisy samples: without regularisation they follow the
  // noise.
  const TrainingSamples samples = wave(60, 0.1), fresh = wave(2000, 0, 99);
  const auto error_on_fresh = [&](const Mlp& mlp) {
    double squares = 0;
    for (std::size_t k = 0; k < fresh.targets.size(); ++k) {
      const double error = mlp.evaluate(&fresh.inputs[k]) - fresh.targets[k];
      squares += error * error;
    }
    return std::sqrt(squares / static_cast<double>(fresh.targets.size()));
  };
  Mlp bayesian = network({1, 15, 1}), free = bayesian;
  TrainOptions options{.max_iterations = 300, .weight_decay = 1e-9};
  train(free, samples, options);
  options.bayesian = true;
  const TrainReport report = train(bayesian, samples, options);
  CHECK(report.effective_parameters > 3);
  CHECK(report.effective_parameters < 20);  // of 46
  CHECK(report.weight_decay > 1e-6);
  CHECK_CLOSE(report.rmse, 0.1, 0.25, 0);
  CHECK(error_on_fresh(bayesian) < 0.06);
  CHECK(error_on_fresh(bayesian) < 0.6 * error_on_fresh(free));
}

TEST_CASE("early stopping keeps the network that met the left-out samples best") {
  const TrainingSamples samples = wave(30, 0.3), left_out = wave(500, 0, 77);
  const Stopping stopping{.left_out = &left_out, .patience = 5};
  const auto check = [&](const Mlp& mlp, const TrainReport& report, int limit) {
    CHECK(report.stopped_early);
    CHECK(report.iterations < limit);
    double squares = 0;
    for (std::size_t k = 0; k < left_out.targets.size(); ++k)
      squares += std::pow(mlp.evaluate(&left_out.inputs[k]) - left_out.targets[k], 2);
    CHECK_CLOSE(report.left_out_rmse, std::sqrt(squares / 500), 1e-9, 0);
  };
  Mlp mlp = network({1, 12, 1});
  check(mlp,
        train(mlp, samples,
              {.max_iterations = 400, .tolerance = 0, .weight_decay = 1e-9, .stopping = stopping}),
        400);
  mlp.parameters.clear();
  BatchTrainOptions batches{.rate = 0.02, .batch = 10, .epochs = 3000, .stopping = stopping};
  check(mlp, train_batches(mlp, samples, batches), 3000);
  mlp.parameters.clear();
  LbfgsOptions lbfgs{
      .max_iterations = 2000, .tolerance = 0, .weight_decay = 1e-9, .stopping = stopping};
  check(mlp, train_lbfgs(mlp, samples, lbfgs), 2000);
}

TEST_CASE(
    "mini-batch training: the same bits again, other bits from another seed, stopped from "
    "outside") {
  const TrainingSamples samples = wave(500, 0.1);
  const auto trained = [&](std::uint64_t seed) {
    Mlp mlp = network({1, 8, 8, 1});
    mlp.activations = {Activation::Relu, Activation::Sigmoid, Activation::Identity};
    BatchTrainOptions options{.epochs = 20, .seed = seed};
    train_batches(mlp, samples, options);
    return mlp.parameters;
  };
  CHECK(trained(3) == trained(3));
  CHECK(trained(3) != trained(4));
  Mlp mlp = network({1, 4, 1});
  BatchTrainOptions options;
  options.on_epoch = [](int epoch, double) {
    if (epoch == 3) throw Interrupted();
  };
  CHECK_THROWS_AS(train_batches(mlp, samples, options), Interrupted);
  LbfgsOptions lbfgs;
  lbfgs.on_iteration = [](int iteration, double) {
    if (iteration == 3) throw Interrupted();
  };
  CHECK_THROWS_AS(train_lbfgs(mlp, samples, lbfgs), Interrupted);
}

TEST_CASE("denormal numbers are zero while it trains, and themselves again afterwards") {
  volatile double small = std::numeric_limits<double>::min();
  const auto half = [&] { return small / 2; };
  REQUIRE(half() > 0);
  {
    const FlushToZero flush;
#if defined(__SSE__)
    CHECK(half() == 0);
#endif
  }
  CHECK(half() > 0);
  Mlp mlp = network({1, 2, 1});
  BatchTrainOptions options;
  double within = 1;
  options.on_epoch = [&](int, double) {
    within = half();
    throw Interrupted();
  };
  CHECK_THROWS_AS(train_batches(mlp, line(50, 0), options), Interrupted);
#if defined(__SSE__)
  CHECK(within == 0);
#endif
  CHECK(half() > 0);
}

TEST_CASE("starts do not depend on threads, the best is chosen, and an ensemble averages") {
  const TrainingSamples samples = wave(200, 0.05);
  const auto train_one = [&](Mlp& mlp, std::size_t) {
    return train(mlp, samples, {.max_iterations = 15});
  };
  std::vector<TrainedMlp> one = train_from_starts(network({1, 3, 1}), 3, 10, 1, train_one);
  const std::vector<TrainedMlp> two = train_from_starts(network({1, 3, 1}), 3, 10, 2, train_one);
  double mean = 0, squares = 0, least = HUGE_VAL;
  const double x = 0.3;
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(one[k].mlp.parameters == two[k].mlp.parameters);
    mean += one[k].mlp.evaluate(&x) / 3;
    least = std::min(least, one[k].report.rmse);
  }
  for (std::size_t k = 0; k < 3; ++k) squares += std::pow(one[k].mlp.evaluate(&x) - mean, 2);
  const MlpEnsemble::Answer answer = MlpEnsemble({one[0].mlp, one[1].mlp, one[2].mlp}).evaluate(&x);
  CHECK_CLOSE(answer.mean, mean, 1e-12, 0);
  CHECK_CLOSE(answer.spread, std::sqrt(squares / 2), 1e-9, 1e-15);
  CHECK(best_of(one).report.rmse == least);
}
