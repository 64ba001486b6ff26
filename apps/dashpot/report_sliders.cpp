#include "report_sliders.h"

#include <algorithm>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/export/js/js.h"
#include "dashpot/report/words.h"

namespace dashpot::cli {
namespace {

/// Bytes of one program, and of all in a page: beside them it has 0.2 MB and its samples.
constexpr std::size_t kMostProgram = 200'000, kMostPrograms = 1'000'000;

}  // namespace

Document with_sliders(Document report, const ReportInput& input) {
  DocumentSliders sliders;
  std::vector<std::string> left_out;
  std::size_t size = 0;
  for (const RankedModel& ranked : input.ranking.models) {
    if (!is_usable(ranked) || !ranked.fit.model) continue;
    const auto leave_out = [&](const std::string& why) {
      left_out.push_back(display_name(ranked) + " (" + why + ")");
    };

    // A report is worth more than its sliders: what has no program is left out in words.
    try {
      const ModelFile file = to_model_file(ranked, input.dataset, input.command);
      JsText program = js_program(exported_model(file), {.version = input.version});
      const std::size_t bytes = program.text().size();
      if (bytes > kMostProgram || size + bytes > kMostPrograms) {
        leave_out("too large; 'dashpot export MODEL --to js' writes it");
        continue;
      }
      size += bytes;
      sliders.models.push_back({display_name(ranked), std::move(program)});
    } catch (const Error& error) {
      leave_out(error.what());
    }
  }
  if (sliders.models.empty()) return report;

  // Where the reader has just looked at the models over the records.
  DocumentSection section{
      .name = "sliders",
      .title = "Beyond the records",
      .paragraphs = {},
      .lead =
          "The fitted models, at work in this page: set a sine and a constant current, or a "
          "parameter of a law, and see the loops change. Arrow keys move a slider, too.",
      .sliders = std::move(sliders),
      .audience = Audience::Page};
  if (!left_out.empty())
    section.remarks = {"Not at work in this page: " + join(left_out, ", ") + "."};
  const auto after = std::ranges::find(report.sections, "closer", &DocumentSection::name);
  report.sections.insert(after == report.sections.end() ? after : after + 1, std::move(section));
  return report;
}

}  // namespace dashpot::cli
