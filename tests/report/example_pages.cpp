// Writes the example report and the example inspection into a folder, for the test that clicks
// through them.
#include <cmath>
#include <filesystem>

#include "dashpot/base/file.h"
#include "dashpot/export/js/js.h"
#include "dashpot/report/inspection.h"
#include "export/example_models.h"
#include "report/example_ranking.h"
#include "report/example_search.h"

namespace {

/// A law and a network that run in their page; with `records`, over one of 10 mm at 2 Hz and 1 A.
dashpot::Document sliders_document(bool records = false) {
  dashpot::DocumentSliders sliders;
  const auto add = [&](const dashpot::DamperModel& model) {
    sliders.models.push_back({model.name(), dashpot::js_program(exported(model), {})});
  };
  add(example_law(dashpot::find_law("bouc_wen")));
  add(dashpot::NetworkModel("mlp_one_sensor", {"velocity", "current"}, {example_mlp(1)}));
  std::vector<dashpot::SharedSamples> samples;
  if (records) {
    constexpr double kAmplitude = 0.01, kRate = 12.566370614359172;  // m, rad/s
    dashpot::SharedSamples displacement{.values = {}, .unit = "m"},
        velocity{.values = {}, .unit = "m/s"}, force{.values = {}, .unit = "N"};
    for (int k = 0; k <= 200; ++k) {
      displacement.values.push_back(kAmplitude * std::sin(kRate * k / 400));
      velocity.values.push_back(kAmplitude * kRate * std::cos(kRate * k / 400));
      force.values.push_back(800 * std::tanh(30 * velocity.values.back()));
    }
    samples = {displacement, velocity, force};
    sliders.loops.push_back({.name = "a record",
                             .drive = 1,
                             .conditions = {},
                             .displacement = 0,
                             .velocity = 1,
                             .force = 2,
                             .first = 0});
  }
  return {.title = "Sliders",
          .subtitle = {},
          .verdict = "Two models that run in their page.",
          .sections = {{.name = "sliders",
                        .title = "Beyond the records",
                        .paragraphs = {},
                        .sliders = std::move(sliders)}},
          .command = {},
          .version = "0.1.0",
          .date = "2026-11-21",
          .samples = std::move(samples)};
}

/// A figure whose sole plot has no title of its own.
dashpot::Document curve_document() {
  dashpot::DocumentSection section{.name = "curve", .title = "A curve", .paragraphs = {}};
  dashpot::FigurePanel panel{
      "", "velocity (m/s)", "force (N)", {{"force", "series-1", {0, 1}, {0, 2}}}};
  section.figures.push_back({"line", "Force of a dashpot", "One plot.", {std::move(panel)}});

  // One whose axes hardly differ from end to end.
  dashpot::FigurePanel tiny{"A tiny range",
                            "energy (J)",
                            "force (N)",
                            {{"force", "series-1", {1e-9, 8e-9}, {4414.5, 4414.52}}}};
  section.figures.push_back({"tiny", "", "", {std::move(tiny)}});

  // Names of files that hold no place to break a line at.
  const std::string file = "campaign/g1.8_l9_122EG_build_1_20_mm_0.6_Hz_1_A_of_the_second_day.csv";
  section.title = "A curve of " + file;
  section.figures.push_back(
      {"named",
       "",
       "",
       {{"Named", "velocity (m/s)", "force (N)", {{file, "series-1", {0, 1}, {0, 2}}}}}});
  return {.title = "Curve",
          .subtitle = {},
          .verdict = "A figure of one plot.",
          .sections = {std::move(section)},
          .command = {},
          .version = "0.1.0",
          .date = "2026-11-21"};
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2) return 2;
  const std::filesystem::path folder = arguments[1];
  ExampleRanking example = example_ranking(count > 2 ? std::stoul(arguments[2]) : 1500);
  example.dataset.records[1].notes = {"<script>alert('a note')</script>"};
  dashpot::write_file(folder / "report.html",
                      dashpot::html_document(dashpot::ranking_document(example.input())));
  dashpot::write_file(folder / "sliders.html", dashpot::html_document(sliders_document()));
  dashpot::write_file(folder / "over.html", dashpot::html_document(sliders_document(true)));
  dashpot::write_file(folder / "curve.html", dashpot::html_document(curve_document()));
  const ExampleRanking crowded = crowded_ranking(30);
  dashpot::write_file(folder / "crowded.html",
                      dashpot::html_document(dashpot::ranking_document(crowded.input())));
  dashpot::write_file(folder / "inspect.html",
                      dashpot::html_document(dashpot::inspection_document(
                          {example.dataset, {}, "dashpot inspect demo", "0.1.0", "2026-11-21"})));
  const dashpot::SearchReport search = example_search();
  dashpot::write_file(
      folder / "search.html",
      dashpot::html_document(dashpot::search_document(
          {example.dataset, search, "dashpot search demo", "0.1.0", "2026-11-21"})));
}
