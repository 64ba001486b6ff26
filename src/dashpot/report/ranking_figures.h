#pragma once
#include "dashpot/report/document.h"
#include "dashpot/report/report.h"

// The figures of a ranking's page. They follow the choices "model" and "record", whose options are
// the ranking's models and shown_records().
namespace dashpot {

/// Force, loops and residual of the chosen model on the chosen record. The curves, thinned so that
/// all pages stay small, go into `samples`; `display` says in a sentence what was thinned; `loops`
/// are those of the records at constant drive, where displacement and velocity are known.
std::vector<DocumentFigure> record_figures(const ReportInput& input,
                                           std::vector<SharedSamples>& samples,
                                           std::string& display,
                                           std::vector<DocumentSliders::Loop>& loops);

/// Where a passive network's energy goes over the widest cycle of the chosen record; no figure
/// where no model is one.
std::vector<DocumentFigure> energy_figures(const Ranking& ranking);

/// Peak force against velocity, and the error in each band of speed.
DocumentFigure overview_figure(const ReportInput& input);

/// The chosen model's ESR by condition and drive, as tables with shaded cells, one per model.
std::vector<DocumentTable> heat_maps(const ReportInput& input);

}  // namespace dashpot
