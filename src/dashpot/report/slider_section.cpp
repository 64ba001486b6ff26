#include "dashpot/report/slider_section.h"

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/report/ranking_words.h"

namespace dashpot {
namespace {

/// Bytes of one program, and of all in a page: beside them it has 0.2 MB and its samples.
constexpr std::size_t kMostProgram = 200'000, kMostPrograms = 1'000'000;

}  // namespace

std::optional<DocumentSection> slider_section(const ReportInput& input,
                                              std::vector<DocumentSliders::Loop> loops) {
  if (!input.program) return std::nullopt;
  DocumentSliders sliders{.models = {}, .loops = std::move(loops)};
  std::vector<std::string> left_out;
  std::size_t size = 0;
  for (const RankedModel& ranked : input.ranking.models) {
    if (!is_usable(ranked) || !ranked.fit.model) continue;
    const auto leave_out = [&](const std::string& why) {
      left_out.push_back(display_name(ranked) + " (" + why + ")");
    };

    // A report is worth more than its sliders: what has no program is left out in words.
    try {
      JsText program = input.program(to_model_file(ranked, input.dataset, input.command));
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
  if (sliders.models.empty()) return std::nullopt;

  DocumentSection section{
      .name = "sliders",
      .title = "Beyond the records",
      .paragraphs = {},
      .lead =
          "The fitted models, at work in this page: set a sine and a constant current, or a "
          "parameter, and see the loops change over a measured one. Arrow keys move a slider, too.",
      .sliders = std::move(sliders),
      .audience = Audience::Page};
  if (!left_out.empty())
    section.remarks = {"Not at work in this page: " + join(left_out, ", ") + "."};
  return section;
}

}  // namespace dashpot
