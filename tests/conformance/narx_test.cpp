#include <cmath>
#include <cstdlib>

#include "dashpot/base/parallel.h"
#include "dashpot/base/random.h"
#include "dashpot/damper/inverse/wanted.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/narx/narx_model.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/identify.h"
#include "sanitized.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr double kNarxSampleTime = 2e-3;

/// Random motion and a current that jumps at random, and what the damper makes of them.
struct Run {
  std::vector<DamperInput> inputs;
  std::vector<double> time, force;
};

Run random_run(const DamperModel& damper, std::size_t samples, double noise, std::uint64_t seed) {
  const Motion motion = random_motion({.amplitude = 0.01,
                                       .frequency = 3,
                                       .duration = kNarxSampleTime * static_cast<double>(samples),
                                       .sample_time = kNarxSampleTime,
                                       .seed = seed});
  Run run;
  Random random(seed);
  std::vector<double> state(damper.state_size());
  double current = 0;
  for (std::size_t k = 0; k < std::min(samples, motion.size()); ++k) {
    if (random.uniform() < 0.02) current = random.uniform(0, 2);
    const DamperInput now{motion.displacement[k], motion.velocity[k], current};
    if (k == 0)
      damper.rest(now, state);
    else
      damper.advance(run.inputs.back(), now, kNarxSampleTime, state);
    run.inputs.push_back(now);
    run.time.push_back(kNarxSampleTime * static_cast<double>(k));
    run.force.push_back(damper.force(now, state) + noise * random.normal());
  }
  return run;
}

Record record_of(const Run& run) {
  Record record;
  record.name = record.condition = "random";
  record.time = run.time;
  record.sample_time = kNarxSampleTime;
  const auto add = [&](const char* name, const char* unit, auto value) {
    Channel channel{name, unit, {}, {}};
    for (std::size_t k = 0; k < run.time.size(); ++k) channel.samples.push_back(value(k));
    record.channels.push_back(std::move(channel));
  };
  add("displacement", "m", [&](std::size_t k) { return run.inputs[k].displacement; });
  add("velocity", "m/s", [&](std::size_t k) { return run.inputs[k].velocity; });
  add("current", "A", [&](std::size_t k) { return run.inputs[k].current; });
  add("force", "N", [&](std::size_t k) { return run.force[k]; });
  return record;
}

/// Any network that a user may ask for, trained a little.
std::shared_ptr<const DamperModel> trained_model(const DamperModel& damper, std::uint64_t seed) {
  Random random(seed);
  const auto choose = [&](auto... of) {
    const std::common_type_t<decltype(of)...> all[] = {of...};
    return all[random.index(sizeof...(of))];
  };
  IdentifyOptions options{.offset = OffsetMode::None, .starts = 1, .seed = seed, .threads = 1};
  NetworkDesign& design = options.network;
  design.hidden = {2 + random.index(9)};
  if (random.uniform() < 0.3) design.hidden.push_back(2 + random.index(5));
  design.activation =
      choose(Activation::Tanh, Activation::Relu, Activation::Sigmoid, Activation::Identity);
  design.delays = random.index(4);
  design.feedback = 1 + random.index(4);
  design.spacing = 1 + random.index(3);
  design.epochs = 3 + random.index(20);
  design.l2 = std::pow(10, random.uniform(-9, -3));
  design.training = choose(FeedbackTraining::SeriesParallel, FeedbackTraining::SeriesParallel,
                           FeedbackTraining::SeriesParallel, FeedbackTraining::FreeRun);
  design.output =
      choose(OutputRange::Linear, OutputRange::Linear, OutputRange::Linear, OutputRange::Bounded);
  const double noise = choose(0.0, 1.0, 10.0, 100.0);
  const std::vector<Record> records{
      record_of(random_run(damper, 200 + random.index(300), noise, seed + 1))};
  return identify(choose("narx_one_sensor", "narx_two_sensors"), records, DriveUnit::Ampere,
                  options)
      .model;
}

struct Outcome {
  std::size_t not_numbers = 0, beyond = 0;
  std::optional<double> diverged_at;
  bool is_bounded = false;
};

/// All samples, those after a divergence too.
Outcome outcome_of(const NarxModel& model, const Run& run) {
  Outcome outcome;
  const Mlp& mlp = model.members().front();
  outcome.is_bounded = mlp.activations.back() == Activation::Tanh;
  std::vector<double> state(model.state_size());
  model.rest(run.inputs.front(), state);
  for (std::size_t k = 0; k < run.inputs.size(); ++k) {
    if (k > 0) model.advance(run.inputs[k - 1], run.inputs[k], kNarxSampleTime, state);
    const double force = model.force(run.inputs[k], state);
    outcome.not_numbers += !std::isfinite(force);
    outcome.beyond +=
        !(std::abs(force - mlp.output_mean) <= (NarxModel::kRange + 1e-9) * mlp.output_scale);
    if (!outcome.diverged_at && model.has_diverged(state)) outcome.diverged_at = run.time[k];
  }
  return outcome;
}

std::size_t number_from(const char* variable, std::size_t otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

}  // namespace

// The whole of it: DASHPOT_NARX_MODELS=1000 DASHPOT_NARX_SAMPLES=100000
TEST_CASE("no trained NARX model gives NaN, and each divergence is told with its time") {
  const std::size_t models = number_from("DASHPOT_NARX_MODELS", kSanitized ? 24 : 60);
  const std::size_t samples = number_from("DASHPOT_NARX_SAMPLES", 2000);
  const LawModel damper = load_parameters("kwok2006");
  std::vector<Outcome> outcomes(models);
  std::vector<std::optional<double>> told(models);
  const Run run = random_run(damper, samples, 0, 99);
  parallel_for(models, 0, [&](std::size_t k) {
    const auto model = trained_model(damper, 1000 * k);
    outcomes[k] = outcome_of(dynamic_cast<const NarxModel&>(*model->with_offset(0)), run);
    told[k] = free_run(*model, run.inputs, run.time).diverged_at;
  });
  std::size_t diverged = 0, bounded = 0, bounded_diverged = 0;
  for (std::size_t k = 0; k < models; ++k) {
    CAPTURE(k);
    CHECK(outcomes[k].not_numbers == 0);
    CHECK(outcomes[k].beyond == 0);
    CHECK(told[k] == outcomes[k].diverged_at);
    diverged += told[k].has_value();
    bounded += outcomes[k].is_bounded;
    bounded_diverged += outcomes[k].is_bounded && told[k];
  }
  CHECK(bounded_diverged == 0);
  MESSAGE(models << " models, " << run.inputs.size() << " samples each: " << diverged
                 << " diverged; of " << bounded << " with a bounded output, " << bounded_diverged);
}
