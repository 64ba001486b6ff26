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

/// One value of a column; `data` is not null.
double sample(const dashpot_column& column, std::size_t k) noexcept {
  return column.data[static_cast<std::ptrdiff_t>(k) * column.stride];
}

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

/// Reads the caller's columns sample by sample.
class MotionReader {
 public:
  /// Throws Error where what the model needs is missing.
  MotionReader(const dashpot_model& model, const dashpot_motion& motion) : motion_(motion) {
    require(motion.velocity.data, "velocity");
    require(motion.current.data, "current");
    if (model.damper->needs_displacement() && !motion.displacement.data)
      throw Error("displacement", "is null", model.name + " needs it");
    if (!motion.time.data && motion.samples > 1 &&
        !(motion.sample_time > 0 && std::isfinite(motion.sample_time)))
      throw Error("sample_time", "is " + format_number(motion.sample_time),
                  "without a column of time it is the s between samples, above 0");
  }

  /// Throws Error where the sample holds a number that is not finite.
  DamperInput input(std::size_t k) const {
    const DamperInput input{motion_.displacement.data ? sample(motion_.displacement, k) : 0.0,
                            sample(motion_.velocity, k), sample(motion_.current, k)};
    // One test for the three: this is the inner loop.
    if (!std::isfinite(input.displacement + input.velocity + input.current)) refuse(input, k);
    return input;
  }

  /// s from the sample before to this one. Throws Error where time does not increase.
  double step(std::size_t k) const {
    if (!motion_.time.data) return motion_.sample_time;
    const double dt = sample(motion_.time, k) - sample(motion_.time, k - 1);
    if (!(dt > 0) || !std::isfinite(dt))
      throw Error("time[" + std::to_string(k) + "]", "does not lie behind the sample before");
    return dt;
  }

 private:
  [[noreturn]] static void refuse(const DamperInput& input, std::size_t k) {
    const std::string at = '[' + std::to_string(k) + ']';
    require_finite(input.displacement, ("displacement" + at).c_str());
    require_finite(input.velocity, ("velocity" + at).c_str());
    require_finite(input.current, ("current" + at).c_str());
    throw Error("sample" + at, "holds numbers too large for any damper");
  }

  const dashpot_motion& motion_;
};

bool is_usable_force(const DamperModel& model, double force, std::span<const double> state) {
  return std::isfinite(force) && !model.has_diverged(state);
}

void fill_with_nan(double* values, std::size_t first, std::size_t last) {
  std::fill(values + first, values + last, std::numeric_limits<double>::quiet_NaN());
}

/// Throws NotUsable where the model diverges, with NaN from there on.
void run(const dashpot_model& model, const dashpot_motion& motion, const dashpot_response& response) {
  const DamperModel& damper = *model.damper;
  const MotionReader reader(model, motion);
  std::vector<double> own;
  std::span<double> state;
  if (response.state) {
    state = state_of(model, response.state, response.state_size);
  } else {
    own.resize(model.state_size);
    state = own;
  }
  DamperInput now = reader.input(0);
  if (!response.state) damper.rest(now, state);
  for (std::size_t k = 0; k < motion.samples; ++k) {
    if (k > 0) {
      const DamperInput before = now;
      now = reader.input(k);
      damper.advance(before, now, reader.step(k), state);
    }
    response.force[k] = damper.force(now, state);
    if (response.half_width)
      response.half_width[k] = model.file.interval->half_width_at(now, damper.spread(now, state));
    if (is_usable_force(damper, response.force[k], state)) continue;
    fill_with_nan(response.force, k, motion.samples);
    if (response.half_width) fill_with_nan(response.half_width, k, motion.samples);
    throw NotUsable(model.name, "diverged at sample " + std::to_string(k));
  }
}

template <class Load>
dashpot_status make_model(dashpot_model** model, Load&& load) noexcept {
  return guarded([&] {
    require(model, "model");
    *model = nullptr;
    *model = new dashpot_model(load());
  });
}

ModelFile published(const std::string& name) {
  const ParameterSet set = load_parameter_set(name);
  ModelFile file;
  file.model = std::make_unique<LawModel>(set.model);
  file.drive_unit = set.model.drive_unit();
  file.domain.current_min = set.drive_min;
  file.domain.current_max = set.drive_max;
  file.provenance.dataset = set.damper;
  file.provenance.citation = set.source;
  return file;
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
    return published(name);
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
    run(*model, *motion, *response);
  });
}
