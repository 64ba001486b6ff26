#include "studies/one_sensor/one_sensor_document.h"
#include "studies/one_sensor/one_sensor_parts.h"

namespace dashpot {
namespace {

Value result_json(const OneSensorView& view, std::size_t damper, const StudiedModel& model,
                  std::size_t experiment) {
  // Nothing where the model was not fitted.
  const StudiedResult* result = view.study.result(damper, model.key, experiment);
  if (!result) return {};

  // Errors in shares of the span of the damper's force, beside the metrics in N.
  Value json =
      Value::object({{"experiment", view.study.dampers[damper].damper.experiments[experiment].name},
                     {"model", model.key},
                     {"parameters", result->parameters},
                     {"seconds", result->seconds},
                     {"diverged_at", result->diverged_at ? Value(*result->diverged_at) : Value()},
                     {"damper_half_span_percent", view.half_percent(damper, result->metrics.rmse)},
                     {"damper_span_percent", view.half_percent(damper, result->metrics.rmse) / 2},
                     {"metrics", to_json(result->metrics)}});
  if (result->one_step) json.add("one_step", to_json(metrics(*result->one_step)));
  return json;
}

Value damper_json(const OneSensorView& view, std::size_t d) {
  const DamperStudy& one = view.study.dampers[d];

  // Every model on every experiment, as far as it was fitted.
  Value results = Value::array(), sizes = Value::array();
  for (const StudiedModel& model : view.study.models)
    for (std::size_t e = 0; e < one.damper.experiments.size(); ++e)
      if (Value result = result_json(view, d, model, e); !result.is_null())
        results.push_back(std::move(result));

  // The size choice.
  for (const StudiedSize& size : one.sizes)
    sizes.push_back(Value::object({{"neurons", size.neurons},
                                   {"parameters", size.parameters},
                                   {"rmse_N", size.error},
                                   {"by_fold_N", Value::array(size.by_fold)}}));

  // The damper with both.
  return Value::object({{"name", one.damper.name},
                        {"description", one.damper.description},
                        {"virtual", one.damper.is_virtual},
                        {"half_span_N", one.damper.half_span()},
                        {"results", std::move(results)},
                        {"sizes", std::move(sizes)},
                        {"smallest_sufficient", smallest_sufficient(one.sizes)}});
}

}  // namespace

Value one_sensor_json(const OneSensorStudy& study) {
  const OneSensorView view(study);
  Value dampers = Value::array(), models = Value::array();
  for (std::size_t d = 0; d < study.dampers.size(); ++d) dampers.push_back(damper_json(view, d));
  for (const StudiedModel& model : study.models)
    models.push_back(Value::object({{"key", model.key},
                                    {"title", model.title},
                                    {"model", model.model},
                                    {"network", format_design(model.design)}}));
  return Value::object({{"format", "dashpot one-sensor study 1"},
                        {"models", std::move(models)},
                        {"dampers", std::move(dampers)},
                        {"seconds", study.seconds}});
}

}  // namespace dashpot
