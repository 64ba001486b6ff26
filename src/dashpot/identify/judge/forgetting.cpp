#include "dashpot/identify/judge/forgetting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "dashpot/base/parallel.h"

namespace dashpot {
namespace {

using State = std::vector<double>;

/// What a record asks of a model.
struct Drive {
  std::vector<DamperInput> inputs;
  std::vector<double> time;

  double duration() const { return time.back() - time.front(); }
};

Drive drive_of(const Record& record, DriveUnit drive_unit) {
  return {damper_inputs(record, drive_unit), record.time};
}

/// The same again and again, until it lasts so long.
Drive repeated(const Drive& once, double seconds) {
  Drive all = once;
  const auto samples = static_cast<double>(once.time.size());
  const double period = once.duration() * samples / (samples - 1);
  for (double start = period; once.duration() > 0 && all.duration() < seconds; start += period) {
    all.inputs.insert(all.inputs.end(), once.inputs.begin(), once.inputs.end());
    for (const double t : once.time) all.time.push_back(start + t);
  }
  return all;
}

/// The force from a state on, which becomes that at the end; nothing where the model diverges.
std::vector<double> force_from(const DamperModel& model, const Drive& drive, std::size_t samples,
                               State& state) {
  std::vector<double> force(samples);
  const std::size_t usable = model.run(std::span(drive.inputs).first(samples),
                                       {.time = drive.time.data()}, state, {force.data()});
  if (usable < samples) force.clear();
  return force;
}

State rest_of(const DamperModel& model, const Drive& drive) {
  State state(model.state_size());
  model.rest(drive.inputs.front(), state);
  return state;
}

/// The samples at which a model may be taken over into another run: all of them, or those at which
/// it has just fed its force back. Between these its clock is part of the state, and two runs whose
/// clocks differ are not the same question.
std::vector<std::size_t> takeover_samples(const DamperModel& model, const Drive& drive) {
  constexpr double kTolerance = 1e-3;  // of a step
  const double step = model.feedback_step();
  std::vector<std::size_t> samples;
  for (std::size_t k = 0; k < drive.time.size(); ++k) {
    const double steps = step > 0 ? (drive.time[k] - drive.time.front()) / step : 0;
    if (std::abs(steps - std::round(steps)) < kTolerance) samples.push_back(k);
  }
  return samples;
}

/// The state of the model after a run from rest to that sample.
State state_at(const DamperModel& model, const Drive& drive, std::size_t sample) {
  State state = rest_of(model, drive);
  force_from(model, drive, sample + 1, state);
  return state;
}

/// The states, in a run from rest, at the greatest force and at the least.
std::vector<State> extreme_states(const DamperModel& model, const Drive& drive) {
  State state = rest_of(model, drive);
  const std::vector<double> force = force_from(model, drive, drive.time.size(), state);
  if (force.empty()) return {};
  const std::vector<std::size_t> samples = takeover_samples(model, drive);
  const auto [least, greatest] =
      std::ranges::minmax_element(samples, {}, [&](std::size_t sample) { return force[sample]; });
  return {state_at(model, drive, *least), state_at(model, drive, *greatest)};
}

double span_of(const Record& record) {
  const auto [low, high] = std::ranges::minmax(record.channel("force").samples);
  return high - low;
}

/// Runs of one model along one motion, all of which must meet that from rest within the time
/// allowed, s.
Forgetting meeting(const DamperModel& model, const Drive& once, const std::vector<State>& starts,
                   double force_span, double allowed) {
  Forgetting result{.is_tested = true};
  const Drive motion = repeated(once, allowed + kForgottenFor);
  State state = rest_of(model, motion);
  const std::vector<double> from_rest = force_from(model, motion, motion.time.size(), state);
  const double begin = motion.time.front();

  for (State start : starts) {
    const std::vector<double> force = force_from(model, motion, motion.time.size(), start);
    if (force.empty() || from_rest.empty()) {
      result.share_left = std::numeric_limits<double>::infinity();
      return result;
    }
    for (std::size_t k = 0; k < force.size(); ++k) {
      const double share = std::abs(force[k] - from_rest[k]) / force_span;
      if (share > kForgottenShare)
        result.seconds = std::max(result.seconds, motion.time[k] - begin);
      if (motion.time[k] - begin >= allowed) result.share_left = std::max(result.share_left, share);
    }
  }
  return result;
}

}  // namespace

bool Forgetting::is_forgotten() const { return !is_tested || share_left <= kForgottenShare; }

Forgetting forgetting(const DamperModel& model, const std::vector<Record>& records,
                      DriveUnit drive_unit, double force_span, int threads) {
  if (model.state_size() == 0 || records.empty()) return {};
  const Record& widest = *std::ranges::max_element(records, {}, span_of);
  const Drive extremes = drive_of(widest, drive_unit);

  const auto tried = [&](std::size_t k, double allowed) {
    // The model of this record's damper, where it is one of a family.
    const std::shared_ptr<const DamperModel> specialised = model.specialised(records[k].conditions);
    const DamperModel& damper = specialised ? *specialised : model;

    // States that it meets elsewhere; one in which it has diverged diverges again.
    std::vector<State> starts = extreme_states(damper, extremes);
    const Drive before = drive_of(records[(k + records.size() - 1) % records.size()], drive_unit);
    starts.push_back(state_at(damper, before, takeover_samples(damper, before).back()));

    Forgetting result =
        meeting(damper, drive_of(records[k], drive_unit), starts, force_span, allowed);
    result.record = records[k].name;
    return result;
  };
  std::vector<Forgetting> results(records.size());
  parallel_for(records.size(), threads,
               [&](std::size_t k) { results[k] = tried(k, kForgettingSeconds); });

  // What is slow has longer, the worst first, up to a record on which that is too little.
  for (;;) {
    Forgetting& worst = *std::ranges::max_element(results, {}, &Forgetting::share_left);
    if (worst.is_forgotten()) break;
    Forgetting later =
        tried(static_cast<std::size_t>(&worst - results.data()), kSlowForgettingSeconds);
    if (!later.is_forgotten()) break;
    worst = std::move(later);
  }

  // The worst of the records, and the longest time.
  Forgetting worst = *std::ranges::max_element(results, {}, &Forgetting::share_left);
  for (const Forgetting& result : results) worst.seconds = std::max(worst.seconds, result.seconds);
  return worst;
}

}  // namespace dashpot
