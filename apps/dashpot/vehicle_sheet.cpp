#include "vehicle_sheet.h"

#include <filesystem>

#include "console.h"
#include "dashpot/base/text.h"
#include "dashpot/controller.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/plant.h"
#include "dashpot/suspension/dampers/damper_words.h"
#include "dashpot/suspension/dampers/passive_curve.h"
#include "dashpot/suspension/ground/ground_sequences.h"
#include "dashpot/suspension/ground/recorded_ground.h"
#include "layout.h"
#include "sequence_sheet.h"

namespace dashpot::cli {
namespace {

struct Listing {
  std::string text;
  Value json = Value::array();
  std::size_t width;

  void add(const SequenceInfo& info) {
    text += sheet_text(info, width);
    json.push_back(sheet_json(info));
  }
};

/// The description of a plant or a controller, in the form that sequences have.
template <class Thing>
SequenceInfo info_of(const Thing& thing) {
  return {thing.name, thing.title, thing.equation, thing.source, thing.remarks, thing.parameters};
}

void list_plants(Listing& list) {
  Table sets({"set", "plant", "source"});
  for (const std::string& name : plant_set_names()) {
    const PlantSet set = load_plant_set(name);
    sets.row({name, set.plant.title,
              set.source + (set.verified ? "" : " (an example: " + set.reason + ")")});
    list.json.push_back(Value::object({{"name", name},
                                       {"title", set.plant.title},
                                       {"source", set.source},
                                       {"kind", set.kind},
                                       {"verified", set.verified}}));
  }

  // --set changes the numbers of a set by the names that its kind has for them.
  list.text += "Sets of numbers\n\n" + sets.text(list.width) +
               "\nKinds of plant, with what --set can change\n";
  for (const PlantModel* model : plant_models()) list.add(info_of(*model));
}

void list_controllers(Listing& list) {
  list.text +=
      "As in mix1,crossover=2Hz; selector(skyhook/add),crossover=1.9Hz takes the first law at low "
      "frequencies, the second at high ones.\n";
  for (const ControlLaw* law : control_laws()) list.add(info_of(*law));
}

void list_roads(Listing& list) {
  list.text += "As in iso8608,class=D,speed=100km/h\n";
  for (const GroundSequence& sequence : ground_sequences()) list.add(sequence.info);
  for (const RecordedGround& kind : recorded_grounds()) {
    list.text += '\n' + std::string(kind.name) + "  " + std::string(kind.title) + '\n' +
                 paragraph(kind.remarks, list.width, 2);
    Table table({"parameter", "default", "meaning"});
    for (const auto& [name, meaning, value] : kind.settings)
      table.row({std::string(name), std::string(value), std::string(meaning)});
    list.text += table.text(list.width, 2);
    list.json.push_back(
        Value::object({{"name", kind.name}, {"title", kind.title}, {"remarks", kind.remarks}}));
  }
}

void list_dampers(Listing& list) {
  list.text +=
      "A model file that 'dashpot identify' wrote, a file with the columns velocity and force, or "
      "one of these; motion_ratio=0.7 after any of them mounts it on a lever, force_factor=0.9 "
      "builds it weaker than its model, which no controller knows.\n";

  // Each source of dampers has a table of its own: kinds, curves, published parameters.
  for (const SimpleDamper& kind : simple_dampers())
    list.add({kind.name, kind.title, "", "common practice", "", kind.parameters});

  Table curves({"passive curve"});
  for (const std::string& name : passive_curve_names()) {
    curves.row({name});
    list.json.push_back(Value::object({{"name", name}, {"kind", "curve"}}));
  }

  Table sets({"parameter set", "damper", ">drive to", "unit"});
  for (const std::string& name : parameter_set_names()) {
    const ParameterSet set = load_parameter_set(name);
    sets.row({name, set.damper, format_number(set.drive_max), to_string(set.model.drive_unit())});
    list.json.push_back(Value::object({{"name", name},
                                       {"kind", "parameter set"},
                                       {"damper", set.damper},
                                       {"drive_max", set.drive_max},
                                       {"drive_unit", to_string(set.model.drive_unit())}}));
  }

  list.text += '\n' + curves.text(list.width) + '\n' + sets.text(list.width);
}

}  // namespace

Option list_option(std::string& kind) {
  return {.names = "--list",
          .target = &kind,
          .help = "list what there is to choose from, and do nothing else",
          .value = "KIND",
          .choices = {"plants", "dampers", "controllers", "roads"},
          .noun = "list",
          .default_text = "none"};
}

void print_list(const std::string& kind, Console& console) {
  Listing list{.text = {}, .width = static_cast<std::size_t>(console.width())};
  if (kind == "plants") list_plants(list);
  if (kind == "dampers") list_dampers(list);
  if (kind == "controllers") list_controllers(list);
  if (kind == "roads") list_roads(list);
  if (console.json)
    console.print_json(list.json);
  else
    console.print(list.text);
}

}  // namespace dashpot::cli
