#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "dashpot/base/text.h"
#include "handles.h"
#include "status.h"

using namespace dashpot;
using namespace dashpot::capi;

namespace {

constexpr std::size_t kBlock = 256;  // samples that the first cache holds
constexpr double kZero = 0;

/// Reads the caller's columns, a block at a time.
class MotionReader {
 public:
  /// Throws Error where what the model needs is missing.
  MotionReader(const dashpot_model& model, const dashpot_motion& motion)
      : displacement_(motion.displacement.data ? motion.displacement : dashpot_column{&kZero, 0}),
        velocity_(motion.velocity),
        current_(motion.current),
        time_(motion.time),
        step_(motion.sample_time),
        inputs_(std::min(kBlock, motion.samples)),
        times_(time_.data ? inputs_.size() : 0) {
    // Every model takes velocity and current; only some need displacement or time.
    require(motion.velocity.data, "velocity");
    require(motion.current.data, "current");
    if (model.damper->needs_displacement() && !motion.displacement.data)
      throw Error("displacement", "is null", model.name + " needs it");
    if (!time_.data && motion.samples > 1 && !(step_ > 0 && std::isfinite(step_)))
      throw Error("sample_time", "is " + format_number(step_),
                  "without a column of time it is the s between samples, above 0");
  }

  /// Samples that stay until the next call. Throws Error where one holds a number that is not
  /// finite, or time does not increase.
  std::span<const DamperInput> read(std::size_t first, std::size_t count) {
    // The block is copied and tested in one pass, which is all that good data costs.
    bool usable = true;
    for (std::size_t k = 0; k < count; ++k) {
      const auto at = static_cast<std::ptrdiff_t>(first + k);
      inputs_[k] = {displacement_.data[at * displacement_.stride],
                    velocity_.data[at * velocity_.stride], current_.data[at * current_.stride]};
      usable &= has_numbers(k);
    }
    for (std::size_t k = 0; k < (time_.data ? count : 0); ++k) {
      times_[k] = time_.data[static_cast<std::ptrdiff_t>(first + k) * time_.stride];
      usable &= has_time(k);
    }

    // Only a block that failed is searched for the sample to name.
    for (std::size_t k = 0; !usable && k < count; ++k)
      require_usable(k, '[' + std::to_string(first + k) + ']');

    return {inputs_.data(), count};
  }
  /// Between the samples of the block.
  Steps steps() const noexcept { return {time_.data ? times_.data() : nullptr, step_}; }

 private:
  /// One test for the three.
  bool has_numbers(std::size_t k) const noexcept {
    return std::isfinite(inputs_[k].displacement + inputs_[k].velocity + inputs_[k].current);
  }
  bool has_time(std::size_t k) const noexcept {
    return std::isfinite(times_[k]) && (k == 0 || times_[k] > times_[k - 1]);
  }
  void require_usable(std::size_t k, const std::string& at) const {
    require_finite(inputs_[k].displacement, ("displacement" + at).c_str());
    require_finite(inputs_[k].velocity, ("velocity" + at).c_str());
    require_finite(inputs_[k].current, ("current" + at).c_str());
    if (!has_numbers(k)) throw Error("sample" + at, "holds numbers too large for any damper");
    if (time_.data && !has_time(k))
      throw Error("time" + at, "does not lie behind the sample before");
  }

  dashpot_column displacement_, velocity_, current_, time_;
  double step_;  ///< s, where no column is time
  std::vector<DamperInput> inputs_;
  std::vector<double> times_;
};

/// A model on its way through a motion, block by block: each begins with the last sample of the one
/// before.
class Run {
 public:
  Run(const dashpot_model& model, const dashpot_motion& motion, const dashpot_response& response)
      : model_(model), reader_(model, motion), samples_(motion.samples), to_(response) {
    if (to_.half_width && model.damper->is_ensemble()) spread_.resize(std::min(kBlock, samples_));
    if (!to_.state) own_.resize(model.state_size);
    state_ = to_.state ? state_of(model, to_.state, to_.state_size) : std::span(own_);
  }

  /// Throws NotUsable where the model diverges, with NaN from there on.
  void run() {
    std::size_t first = 0, last = 0;
    do {
      first = last;
      last = std::min(first + kBlock, samples_) - 1;
      respond(first, reader_.read(first, last + 1 - first));
    } while (last + 1 < samples_);
  }

 private:
  void respond(std::size_t first, std::span<const DamperInput> inputs) {
    // A run without a state of the caller's starts at rest.
    if (first == 0 && !to_.state) model_.damper->rest(inputs.front(), state_);
    const std::size_t usable =
        model_.damper->run(inputs, reader_.steps(), state_,
                           {to_.force + first, spread_.empty() ? nullptr : spread_.data()});

    // The band follows the model's own spread where it is an ensemble.
    for (std::size_t k = 0; k < (to_.half_width ? usable : 0); ++k)
      to_.half_width[first + k] =
          model_.file.interval->half_width_at(inputs[k], spread_.empty() ? 0 : spread_[k]);

    // From where the model diverged, the caller finds NaN, not numbers of an earlier run.
    if (usable == inputs.size()) return;
    for (double* values : {to_.force, to_.half_width})
      if (values)
        std::fill(values + first + usable, values + samples_,
                  std::numeric_limits<double>::quiet_NaN());
    throw NotUsable(model_.name, "diverged at sample " + std::to_string(first + usable));
  }

  const dashpot_model& model_;
  MotionReader reader_;
  std::size_t samples_;
  dashpot_response to_;
  std::vector<double> own_, spread_;
  std::span<double> state_;
};

}  // namespace

dashpot_status dashpot_run(const dashpot_model* model, const dashpot_motion* motion,
                           const dashpot_response* response) {
  return guarded([&] {
    require(model, "model");
    require(motion, "motion");
    require(response, "response");
    if (motion->samples == 0) return;
    require(response->force, "force");
    if (response->half_width && !model->file.interval)
      throw Error("half_width", model->name + " has no band",
                  "identify it with recordings left out");
    Run(*model, *motion, *response).run();
  });
}
