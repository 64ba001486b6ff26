#include "dashpot/damper/kinds/fuzzy/train_fuzzy.h"

#include <numeric>

#include "dashpot/base/random.h"
#include "dashpot/error.h"
#include "support.h"

using namespace dashpot;

namespace {

using Shape = Membership::Shape;

/// Bells over velocity and a change of it; linear in the current.
Sugeno start(Shape shape = Shape::Bell) {
  Sugeno sugeno{.inputs = {{0, 0.17, -2, 2}, {0, 0.5, -2, 2}, {1, 0.58, -2, 2}},
                .memberships = {},
                .rules = {},
                .consequents = {},
                .output_mean = 0,
                .output_scale = 1000};
  for (const double centre : {-1.2, 0.0, 1.2})
    sugeno.memberships.push_back({shape, 0, centre, 0.7, 2});
  for (const double centre : {-1.0, 1.0}) sugeno.memberships.push_back({shape, 1, centre, 1.1, 2});
  for (std::size_t v = 0; v < 3; ++v)
    for (std::size_t d = 3; d < 5; ++d) sugeno.rules.push_back({v, d});
  return sugeno;
}

/// Force of `truth` with an offset per record of -80 ... 80 N and noise of 20 N.
TrainingSamples samples_of(const Sugeno& truth, std::size_t count, double noise = 20) {
  TrainingSamples samples;
  samples.groups = 5;
  Random random(7);
  for (std::size_t k = 0; k < count; ++k) {
    const std::array input{random.uniform(-0.3, 0.3), random.uniform(-0.9, 0.9),
                           random.uniform(0, 2)};
    samples.inputs.insert(samples.inputs.end(), input.begin(), input.end());
    samples.group.push_back(k % samples.groups);  // interleaved: the trainer sorts
    samples.targets.push_back(truth.evaluate(input.data()) +
                              40.0 * (static_cast<double>(samples.group.back()) - 2) +
                              noise * random.normal());
  }
  return samples;
}

/// The grid of start() elsewhere, with rules of its own.
Sugeno moved(Shape shape = Shape::Bell) {
  Sugeno truth = start(shape);
  Random random(3);
  for (Membership& m : truth.memberships) {
    m.centre += random.uniform(-0.2, 0.2);
    m.width *= random.uniform(0.7, 1.1);
  }
  for (std::size_t k = 0; k < truth.consequent_count(); ++k)
    truth.consequents.push_back(random.uniform(-1, 1));
  return truth;
}

/// Of a model with its consequents: residuals with every record's best offset, and the ridge.
double plain_cost(const Sugeno& model, const TrainingSamples& samples,
                  const FuzzyTrainOptions& options) {
  std::vector<double> sum(samples.groups), size(samples.groups);
  double squares = 0;
  for (std::size_t k = 0; k < samples.targets.size(); ++k) {
    const double r =
        (samples.targets[k] - model.evaluate(&samples.inputs[3 * k])) / model.output_scale;
    squares += r * r;
    sum[samples.group[k]] += r;
    size[samples.group[k]] += 1;
  }
  for (std::size_t g = 0; g < samples.groups; ++g)
    squares -= sum[g] * sum[g] / (size[g] * (1 + options.offset_decay));
  const std::vector<double>& q = model.consequents;
  return squares / static_cast<double>(samples.targets.size()) +
         options.ridge * std::inner_product(q.begin(), q.end(), q.begin(), 0.0);
}

}  // namespace

TEST_CASE("no consequents are better than those of the least squares") {
  const FuzzyTrainOptions options{.max_iterations = 0};
  TrainingSamples samples = samples_of(moved(), 700);
  Sugeno model = start();
  train(model, samples, options);
  // train() moves the mean offset into the constants, which the ridge penalties: no offset here.
  samples.group.assign(samples.group.size(), 0);
  samples.groups = 1;
  FuzzyTrainOptions stiff = options;
  stiff.offset_decay = 1e12;
  model = start();
  const ReducedCost reduced = reduced_cost(model, samples, stiff);
  train(model, samples, stiff);
  CHECK_CLOSE(plain_cost(model, samples, stiff), reduced.cost, 1e-9, 0);
  for (double& q : model.consequents)
    for (const double move : {1e-3, -1e-3}) {
      q += move;
      CHECK(plain_cost(model, samples, stiff) > reduced.cost);
      q -= move;
    }
}

TEST_CASE("the gradient of the reduced cost is that of its differences") {
  for (const Shape shape : {Shape::Bell, Shape::Gaussian, Shape::Sigmoid}) {
    const TrainingSamples samples = samples_of(moved(), 700);  // not a multiple of the block
    const FuzzyTrainOptions options;
    const Sugeno model = start(shape);
    const ReducedCost reduced = reduced_cost(model, samples, options);
    REQUIRE(reduced.gradient.size() == 15);
    const double h = 1e-4;
    for (std::size_t k = 0; k < 15; ++k) {
      const auto cost = [&](double move) {
        Sugeno other = model;
        Membership& m = other.memberships[k / 3];
        if (k % 3 == 0) m.centre += move;
        if (k % 3 == 1) m.width *= std::exp(move);
        if (k % 3 == 2) m.slope *= std::exp(move);
        return reduced_cost(other, samples, options).cost;  // the penalty of moves starts anew: 0
      };
      CAPTURE(k);
      CHECK_CLOSE(2 * reduced.gradient[k], (cost(h) - cost(-h)) / (2 * h), 1e-4, 1e-7);
    }
  }
}

TEST_CASE("learning reaches the noise, finds the offsets and gives the same bits again") {
  for (const Shape shape : {Shape::Bell, Shape::Gaussian}) {
    const Sugeno truth = moved(shape);
    const TrainingSamples samples = samples_of(truth, 4000);
    const FuzzyTrainOptions options{.tolerance = 1e-7, .ridge = 1e-8, .premise_decay = 1e-8};
    Sugeno model = start(shape), again = start(shape), fixed = start(shape);
    const TrainReport report = train(model, samples, options);
    CHECK_CLOSE(report.rmse, 20, 0.03, 0);
    REQUIRE(report.offsets.size() == 5);
    CHECK_CLOSE(std::accumulate(report.offsets.begin(), report.offsets.end(), 0.0), 0, 0, 1e-9);
    for (std::size_t g = 0; g < 5; ++g)  // known to 20 N / sqrt(800)
      CHECK_CLOSE(report.offsets[g], 40.0 * (static_cast<double>(g) - 2), 0, 2.5);
    for (const double v : {-0.2, 0.01, 0.15}) {
      const std::array input{v, 0.3, 1.5};
      CHECK_CLOSE(model.evaluate(input.data()), truth.evaluate(input.data()), 0, 10);
    }
    train(again, samples, options);
    CHECK(again.consequents == model.consequents);
    CHECK(again.memberships[2].centre == model.memberships[2].centre);
    // The memberships have to learn too: the consequents alone leave more.
    CHECK(train(fixed, samples, {.max_iterations = 0}).rmse > 30);
  }
}

TEST_CASE("learning without groups, with a constant input, and with an interruption") {
  TrainingSamples samples = samples_of(moved(), 1000, 0);
  for (std::size_t k = 0; k < samples.targets.size(); ++k) {
    samples.inputs[3 * k + 2] = 1;
    samples.targets[k] = 500 + 1000 * samples.inputs[3 * k];
  }
  samples.group.clear();
  samples.groups = 0;
  Sugeno model = start();
  const TrainReport report = train(model, samples, {.ridge = 1e-9});
  CHECK(report.offsets.empty());
  CHECK(report.rmse < 1);
  CHECK_CLOSE(model.evaluate(std::array{0.1, 0.0, 1.0}.data()), 600, 0, 2);

  FuzzyTrainOptions options;
  options.on_iteration = [](int iteration) {
    if (iteration == 2) throw Interrupted();
  };
  CHECK_THROWS_AS(train(model, samples_of(moved(), 700), options), Interrupted);
}
