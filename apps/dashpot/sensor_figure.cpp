#include "sensor_figure.h"

namespace dashpot::cli {

DocumentFigure sensor_figure(const InPlantTrace& trace, const std::vector<SensorFigures>& sensors,
                             const std::string& forces) {
  constexpr std::size_t kMostShown = 1500;
  DocumentFigure figure{.name = "sensors",
                        .title = "Sensors",
                        .caption = "Measured and modelled, at the end of the first recording.",
                        .panels = {}};
  const std::size_t count = trace.dampers.front().force.size();
  const std::size_t first = count > kMostShown ? count - kMostShown : 0;
  for (std::size_t s = 0; s < trace.modelled.size(); ++s) {
    FigurePanel panel{.title = sensors[s].channel,
                      .x_label = "Time",
                      .y_label = sensors[s].channel,
                      .series = {},
                      .reads_along_x = true,
                      .x_unit = "s",
                      .y_unit = sensors[s].unit};
    FigureSeries measured{.label = "measured", .colour = "measured"};
    FigureSeries modelled{.label = "modelled", .colour = "modelled"};
    for (std::size_t k = first; k < count; ++k) {
      measured.x.push_back(trace.sample_time * static_cast<double>(k));
      measured.y.push_back(trace.measured[s][k]);
      modelled.y.push_back(trace.modelled[s][k]);
    }
    modelled.x = measured.x;
    panel.series = {std::move(measured), std::move(modelled)};
    figure.panels.push_back(std::move(panel));
  }

  // The virtual load cells: what no sensor measures.
  for (const DamperTrace& damper : trace.dampers) {
    const std::string place = trace.dampers.size() > 1 ? " at " + damper.strut : "";
    FigurePanel panel{.title = "force of the damper" + place + ", " + forces,
                      .x_label = "Deflection",
                      .y_label = "Force",
                      .series = {},
                      .x_unit = "m",
                      .y_unit = "N"};
    FigureSeries loop{.label = "modelled", .colour = "modelled"};
    for (std::size_t k = first; k < count; ++k) {
      loop.x.push_back(damper.deflection[k]);
      loop.y.push_back(damper.force[k]);
    }
    panel.series = {std::move(loop)};
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace dashpot::cli
