#include "contributing/exporter/points_example.h"

#include "dashpot/base/text.h"

namespace dashpot {

std::vector<ExportedFile> write_points_example(const ExportedModel& model,
                                               const ExportOptions& options) {
  std::vector<double> state(model.model.state_size());
  model.model.rest({}, state);
  std::string text;
  for (const double velocity : {model.domain.velocity_min, model.domain.velocity_max})
    text += format_exact(model.model.force({0, velocity, 0}, state)) + '\n';
  return {{export_name(model, options) + "_points.txt", text}};
}

}  // namespace dashpot
