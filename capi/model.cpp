#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "dashpot/base/text.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/registry.h"
#include "handles.h"
#include "status.h"

using namespace dashpot;
using namespace dashpot::capi;

dashpot_model::dashpot_model(ModelFile model_file)
    : file(std::move(model_file)),
      damper(file.model.get()),
      state_size(damper->state_size()),
      name(damper->name()),
      kind(damper->kind()),
      title(model_info(name).title) {}

namespace {

DamperInput to_input(const dashpot_input& input) noexcept {
  return {input.displacement, input.velocity, input.current};
}

void require_input(const dashpot_input* input, const char* name) {
  require(input, name);
  require_finite(input->displacement, "displacement");
  require_finite(input->velocity, "velocity");
  require_finite(input->current, "current");
}

/// The caller's state array. Throws Error where its size is not the model's.
template <class Number>
std::span<Number> state_of(const dashpot_model& model, Number* state, std::size_t size) {
  if (size != model.state_size)
    throw Error("state_size", "is " + std::to_string(size),
                model.name + " has " + std::to_string(model.state_size) + " states");
  if (size > 0) require(state, "state");
  return {state, size};
}

/// Goes through a column from sample to sample.
struct Cursor {
  const double* at;
  std::ptrdiff_t stride;
  double take() noexcept {
    const double value = *at;
    at += stride;
    return value;
  }
};

constexpr double kZero = 0;

/// Reads the caller's columns sample by sample, from the first on.
class MotionReader {
 public:
  /// Throws Error where what the model needs is missing.
  MotionReader(const dashpot_model& model, const dashpot_motion& motion)
      : displacement_(cursor(motion.displacement)),
        velocity_(cursor(motion.velocity)),
        current_(cursor(motion.current)),
        time_(cursor(motion.time)),
        has_time_(motion.time.data),
        step_(motion.sample_time) {
    require(motion.velocity.data, "velocity");
    require(motion.current.data, "current");
    if (model.damper->needs_displacement() && !motion.displacement.data)
      throw Error("displacement", "is null", model.name + " needs it");
    if (!has_time_ && motion.samples > 1 && !(step_ > 0 && std::isfinite(step_)))
      throw Error("sample_time", "is " + format_number(step_),
                  "without a column of time it is the s between samples, above 0");
  }

  /// The next sample, and s to it from the one before. Throws Error where it holds a number that is not
  /// finite, or time does not increase.
  void next(DamperInput& input, double& step) {
    input.displacement = displacement_.take();
    input.velocity = velocity_.take();
    input.current = current_.take();
    // One test for the three: this is the inner loop.
    if (!std::isfinite(input.displacement + input.velocity + input.current)) refuse(input);
    if (has_time_) {
      const double before = now_;
      now_ = time_.take();
      step_ = now_ - before;
      if ((!(step_ > 0) && place_ > 0) || !std::isfinite(now_))
        throw Error("time" + at(), "does not lie behind the sample before");
    }
    step = step_;
    ++place_;
  }

 private:
  static Cursor cursor(const dashpot_column& column) noexcept {
    return column.data ? Cursor{column.data, column.stride} : Cursor{&kZero, 0};
  }
  std::string at() const { return '[' + std::to_string(place_) + ']'; }
  [[noreturn]] void refuse(const DamperInput& input) const {
    require_finite(input.displacement, ("displacement" + at()).c_str());
    require_finite(input.velocity, ("velocity" + at()).c_str());
    require_finite(input.current, ("current" + at()).c_str());
    throw Error("sample" + at(), "holds numbers too large for any damper");
  }

  Cursor displacement_, velocity_, current_, time_;
  bool has_time_;
  double step_, now_ = 0;
  std::size_t place_ = 0;
};

bool is_usable_force(const DamperModel& model, double force, std::span<const double> state) {
  return std::isfinite(force) && !model.has_diverged(state);
}

void fill_with_nan(double* values, std::size_t first, std::size_t last) {
  std::fill(values + first, values + last, std::numeric_limits<double>::quiet_NaN());
}

/// A model on its way through a motion. Samples are read a few ahead: a model waits for what was written a
/// moment ago, which would cost a quick law a third.
class Run {
 public:
  Run(const dashpot_model& model, const dashpot_motion& motion, const dashpot_response& response)
      : model_(model),
        damper_(*model.damper),
        reader_(model, motion),
        samples_(motion.samples),
        to_(response) {
    if (response.state) {
      state_ = state_of(model, response.state, response.state_size);
    } else {
      own_.resize(model.state_size);
      state_ = own_;
    }
  }

  /// Throws NotUsable where the model diverges, with NaN from there on.
  void run() {
    for (std::size_t k = 0; k < std::min(kAhead, samples_); ++k) read(k);
    for (std::size_t k = 0; k < samples_; ++k) {
      if (k + kAhead < samples_) read(k + kAhead);
      const DamperInput& now = inputs_[k % kSlots];
      if (k > 0)
        damper_.advance(inputs_[(k - 1) % kSlots], now, steps_[k % kSlots], state_);
      else if (!to_.state)
        damper_.rest(now, state_);
      respond(k, now);
    }
  }

 private:
  static constexpr std::size_t kAhead = 4, kSlots = 8;

  void read(std::size_t k) { reader_.next(inputs_[k % kSlots], steps_[k % kSlots]); }

  void respond(std::size_t sample, const DamperInput& input) {
    const double force = damper_.force(input, state_);
    to_.force[sample] = force;
    if (to_.half_width)
      to_.half_width[sample] = model_.file.interval->half_width_at(input, damper_.spread(input, state_));
    if (is_usable_force(damper_, force, state_)) return;
    fill_with_nan(to_.force, sample, samples_);
    if (to_.half_width) fill_with_nan(to_.half_width, sample, samples_);
    throw NotUsable(model_.name, "diverged at sample " + std::to_string(sample));
  }

  const dashpot_model& model_;
  const DamperModel& damper_;
  MotionReader reader_;
  std::size_t samples_;
  dashpot_response to_;
  std::vector<double> own_;
  std::span<double> state_;
  DamperInput inputs_[kSlots];
  double steps_[kSlots] = {};  ///< s
};

template <class Load>
dashpot_status make_model(dashpot_model** model, Load&& load) noexcept {
  return guarded([&] {
    require(model, "model");
    *model = nullptr;
    *model = new dashpot_model(load());
  });
}

}  // namespace

dashpot_status dashpot_model_load(const char* path, dashpot_model** model) {
  return make_model(model, [&] {
    require(path, "path");
    return load_model(path);
  });
}

dashpot_status dashpot_model_parse(const char* text, dashpot_model** model) {
  return make_model(model, [&] {
    require(text, "text");
    return parse_model(text, "text");
  });
}

dashpot_status dashpot_model_published(const char* name, dashpot_model** model) {
  return make_model(model, [&] {
    require(name, "name");
    return to_model_file(load_parameter_set(name));
  });
}

dashpot_status dashpot_model_save(const dashpot_model* model, const char* path) {
  return guarded([&] {
    require(model, "model");
    require(path, "path");
    save_model(model->file, path);
  });
}

dashpot_status dashpot_model_text(const dashpot_model* model, char** text) {
  return guarded([&] {
    require(text, "text");
    *text = nullptr;
    require(model, "model");
    *text = copy_text(format_model(model->file));
  });
}

dashpot_status dashpot_model_get_info(const dashpot_model* model, dashpot_model_info* info) {
  return guarded([&] {
    require(model, "model");
    require(info, "info");
    const ModelFile& file = model->file;
    *info = {.name = model->name.c_str(),
             .kind = model->kind.c_str(),
             .title = model->title.c_str(),
             .drive_unit = file.drive_unit.c_str(),
             .state_size = model->state_size,
             .parameter_count = model->damper->parameter_count(),
             .needs_displacement = model->damper->needs_displacement(),
             .sample_time = file.sample_time,
             .displacement_min = file.domain.displacement_min,
             .displacement_max = file.domain.displacement_max,
             .velocity_min = file.domain.velocity_min,
             .velocity_max = file.domain.velocity_max,
             .current_min = file.domain.current_min,
             .current_max = file.domain.current_max,
             .interval_level = file.interval ? file.interval->level : 0};
  });
}

void dashpot_model_free(dashpot_model** model) { give_back(model); }

dashpot_status dashpot_rest(const dashpot_model* model, const dashpot_input* input, double* state,
                            size_t state_size) {
  return guarded([&] {
    require(model, "model");
    require_input(input, "input");
    model->damper->rest(to_input(*input), state_of(*model, state, state_size));
  });
}

dashpot_status dashpot_advance(const dashpot_model* model, const dashpot_input* from, const dashpot_input* to,
                               double dt, double* state, size_t state_size) {
  return guarded([&] {
    require(model, "model");
    require_input(from, "from");
    require_input(to, "to");
    if (!(dt > 0) || !std::isfinite(dt)) throw Error("dt", "is " + format_number(dt), "s, above 0");
    model->damper->advance(to_input(*from), to_input(*to), dt, state_of(*model, state, state_size));
  });
}

dashpot_status dashpot_force(const dashpot_model* model, const dashpot_input* input, const double* state,
                             size_t state_size, double* force) {
  return guarded([&] {
    require(model, "model");
    require(force, "force");
    require_input(input, "input");
    const std::span<const double> now = state_of(*model, state, state_size);
    *force = model->damper->force(to_input(*input), now);
    if (!is_usable_force(*model->damper, *force, now)) throw NotUsable(model->name, "has diverged");
  });
}

dashpot_status dashpot_run(const dashpot_model* model, const dashpot_motion* motion,
                           const dashpot_response* response) {
  return guarded([&] {
    require(model, "model");
    require(motion, "motion");
    require(response, "response");
    if (motion->samples == 0) return;
    require(response->force, "force");
    if (response->half_width && !model->file.interval)
      throw Error("half_width", model->name + " has no band", "identify it with recordings left out");
    Run(*model, *motion, *response).run();
  });
}
