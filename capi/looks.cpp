#include <deque>

#include "dashpot/base/date.h"
#include "dashpot/base/escape.h"
#include "dashpot/report/characterisation_document.h"
#include "dashpot/report/compare.h"
#include "handles.h"
#include "recordings.h"
#include "status.h"
#include "words.h"

using namespace dashpot;
using namespace dashpot::capi;

namespace {

/// A document in the form that was asked for; `csv`: empty where it has no such form.
std::string text_in_form(const Document& document, const std::string& form,
                         const std::string& csv = {}) {
  if (form == "json") return format_json(document_json(document));
  if (form == "html") return html_document(document);
  if (form == "markdown") return markdown_document(document);
  if (form == "text") return document_text(document, 100);
  if (form == "csv" && !csv.empty()) return csv;
  throw Error("options, format", "is '" + form + "'",
              std::string("json, html, markdown") + (csv.empty() ? " or text" : ", text or csv"));
}

}  // namespace

dashpot_status dashpot_characterise(const dashpot_recordings* recordings, const char* options,
                                    char** text) {
  return guarded([&] {
    require(text, "text");
    *text = nullptr;
    const Dataset dataset = usable_dataset(recordings);
    const LookOptions asked = read_look_options(options);
    const Characterisation figures = characterise(dataset, {asked.speeds});
    const Document document =
        characterisation_document({dataset, figures, asked.command, dashpot_version(), date_now()});
    *text = copy_text(text_in_form(document, asked.format, cycles_csv(figures)));
  });
}

dashpot_status dashpot_compare(const dashpot_thing* things, size_t count, const char* options,
                               char** text) {
  return guarded([&] {
    require(text, "text");
    *text = nullptr;
    require(things, "things");
    const LookOptions asked = read_look_options(options);

    // Copies of the recordings, complete as for a fit; models as they are.
    std::deque<Dataset> datasets;
    std::vector<ThingToCompare> compared;
    for (std::size_t k = 0; k < count; ++k) {
      require(things[k].name, "name");
      if (!things[k].model == !things[k].recordings)
        throw Error(things[k].name, "is not one of a model and recordings",
                    "either of them, and the other null");
      compared.push_back({.name = things[k].name});
      if (things[k].model)
        compared.back().model = &things[k].model->file;
      else
        compared.back().dataset = &datasets.emplace_back(usable_dataset(things[k].recordings));
    }
    const std::vector<ComparedThing> seen = compared_things(compared, asked.speeds, 0);
    *text = copy_text(text_in_form(
        comparison_document({seen, asked.speeds, asked.command, dashpot_version(), date_now()}),
        asked.format));
  });
}
