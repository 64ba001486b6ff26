#include <memory>

#include "commands.h"
#include "console.h"
#include "dashpot/damper/registry.h"
#include "layout.h"
#include "model_sheet.h"

namespace dashpot::cli {
namespace {

struct ModelsSettings {
  std::string name;
  bool markdown = false;
};

constexpr std::string_view kModelsExample =
    "# What is there to choose from?\n"
    "dashpot models\n"
    "\n"
    "# The equation, parameters and source of one of them:\n"
    "dashpot models modified_bouc_wen\n"
    "\n"
    "# Is a law of your own read as it is meant?\n"
    "dashpot models my_law.yaml";

/// The models of each kind below its name.
std::string overview_table(int width) {
  Table table({"name", ">to fit", ">states", "title"});
  std::string kind;
  for (const std::string& name : model_names()) {
    const ModelSheet sheet = model_sheet(name);
    if (sheet.kind != kind) table.row({sheet.kind});
    kind = sheet.kind;
    table.row({"  " + sheet.name, std::to_string(sheet.numbers),
               std::to_string(sheet.states.size()), sheet.title});
  }
  return table.text(static_cast<std::size_t>(width));
}

std::string markdown_page(const std::vector<std::string>& names) {
  std::string text =
      "# Models\n\nMade by `dashpot models --markdown` from the tables that the program itself "
      "uses. SI units; extension positive; a force that resists extension is positive.\n";
  for (const std::string& name : names) text += '\n' + sheet_markdown(model_sheet(name));
  return text;
}

Value json_list(const std::vector<std::string>& names) {
  Value list = Value::array();
  for (const std::string& name : names) list.push_back(sheet_json(model_sheet(name)));
  return list;
}

int run_models(const ModelsSettings& settings, Console& console) {
  const bool all = settings.name.empty();
  const std::vector<std::string> names = all ? model_names() : std::vector{settings.name};
  if (console.json)
    console.print_json(all ? json_list(names) : sheet_json(model_sheet(settings.name)));
  else if (settings.markdown)
    console.print(markdown_page(names));
  else if (all)
    console.print(overview_table(console.width()) +
                  "\n'dashpot models NAME' shows equation, parameters and source.\n");
  else
    console.print(sheet_text(model_sheet(settings.name), console.width()));
  return kDone;
}

}  // namespace

Command models_command() {
  auto settings = std::make_shared<ModelsSettings>();
  return {.name = "models",
          .title = "The damper models: equations, parameters, sources",
          .description =
              "Lists the models that can be identified, or shows one: its equation, the table of "
              "its parameters (units, defaults, bounds), states, source and limits.",

          .options = {{.names = "NAME",
                       .target = &settings->name,
                       .help = "the model to show, or the file of a law (.yaml), which is checked",
                       .choices = model_names(),
                       .more_choices = more_model_names(),
                       .noun = "model",
                       .takes = Takes::File,
                       .meaning = model_named},
                      {.names = "--markdown",
                       .target = &settings->markdown,
                       .help = "print a page for the documentation"}},

          .example = std::string(kModelsExample),
          .run = [settings](Console& console) { return run_models(*settings, console); }};
}

}  // namespace dashpot::cli
