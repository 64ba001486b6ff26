#include <cmath>
#include <span>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/registry.h"
#include "dashpot/report/parameter_files.h"
#include "handles.h"
#include "status.h"

using namespace dashpot;
using namespace dashpot::capi;

dashpot_model::dashpot_model(ModelFile model_file)
    : file(std::move(model_file)),
      damper(file.model.get()),
      state_size(damper->state_size()),
      name(damper->name()),
      kind(name_of(damper->kind())),
      title(info_of(*damper).title) {}

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

dashpot_status dashpot_model_parameters(const dashpot_model* model, char** text) {
  return guarded([&] {
    require(text, "text");
    *text = nullptr;
    require(model, "model");
    *text = copy_text(format_json(presentable(parameters_json(model->file))));
  });
}

dashpot_status dashpot_model_get_info(const dashpot_model* model, dashpot_model_info* info) {
  return guarded([&] {
    require(model, "model");
    require(info, "info");

    // The texts belong to the model and live as long as it does.
    const ModelFile& file = model->file;
    *info = {.name = model->name.c_str(),
             .kind = model->kind.c_str(),
             .title = model->title.c_str(),
             .drive_unit = to_string(file.drive_unit).c_str(),
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

dashpot_status dashpot_advance(const dashpot_model* model, const dashpot_input* from,
                               const dashpot_input* to, double dt, double* state,
                               size_t state_size) {
  return guarded([&] {
    require(model, "model");
    require_input(from, "from");
    require_input(to, "to");
    if (!(dt > 0) || !std::isfinite(dt)) throw Error("dt", "is " + format_number(dt), "s, above 0");
    model->damper->advance(to_input(*from), to_input(*to), dt, state_of(*model, state, state_size));
  });
}

dashpot_status dashpot_force(const dashpot_model* model, const dashpot_input* input,
                             const double* state, size_t state_size, double* force) {
  return guarded([&] {
    require(model, "model");
    require(force, "force");
    require_input(input, "input");
    const std::span<const double> now = state_of(*model, state, state_size);
    *force = model->damper->force(to_input(*input), now);
    if (!std::isfinite(*force) || model->damper->has_diverged(now))
      throw NotUsable(model->name, "has diverged");
  });
}
