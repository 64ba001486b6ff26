#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/core.h>

#include "commands.h"
#include "console.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/dataset.h"
#include "dashpot/identify/fit/family_build.h"
#include "dashpot/identify/judge/extrapolation.h"
#include "dashpot/machine/found_noise.h"
#include "dashpot/model_file.h"
#include "dashpot/physics/damper_physics.h"
#include "document_text.h"
#include "layout.h"
#include "member_in_plant.h"

namespace dashpot::cli {
namespace {

struct MemberSettings {
  std::string model, damper, plant, outside_family = "mark", output;
  std::vector<std::string> changes, recordings;
};

constexpr std::string_view kMemberExample =
    "# One damper of a fitted family, as a model that every other command takes:\n"
    "dashpot member results/models/family_gated.json --set gap=1.25mm,pole_length=9mm -o "
    "member.json\n"
    "\n"
    "# The same as a strong build of it, and as a drawing, a coil and a fluid say:\n"
    "dashpot member results/models/family_gated.json --set build=1.64 -o strong.json\n"
    "dashpot member results/models/family_gated.json --damper my_damper.yaml --outside-family "
    "refuse\n"
    "\n"
    "# A build that was recorded: a few cycles at one current make the rest its own:\n"
    "dashpot member results/models/family_physics.json --damper my_damper.yaml --recording "
    "short_test.csv -o build.json\n"
    "\n"
    "# The same from a drive of the car that it works in, whose numbers are not all known:\n"
    "dashpot member results/models/family_physics.json --damper my_damper.yaml --recording "
    "drive.csv --in car.yaml -o build.json";

Conditions changes_of(const MemberSettings& settings) {
  Conditions conditions;
  for (const std::string& change : settings.changes) {
    const std::size_t equals = change.find('=');
    if (equals == std::string::npos)
      throw UsageError("--set", "'" + change + "' has no value; write gap=1.2mm");
    const std::string name(trim(change.substr(0, equals)));
    if (name == kYieldStress)
      throw UsageError("--set", "yield_stress would be the same at any current, without one too",
                       "a drawing, whose coil and fluid give it at every current: --damper "
                       "my_damper.yaml");

    // A number without a unit is taken in the unit of its field.
    std::string unit;
    std::vector<std::string> known;
    for (const MemberField& field : member_fields()) {
      known.emplace_back(field.name);
      if (field.name == name) unit = field.unit;
    }

    if (unit.empty())
      throw UsageError("--set", "unknown number '" + name + "'; " + suggest(name, known));
    conditions.emplace_back(name, parse_quantity(trim(std::string_view(change).substr(equals + 1)),
                                                 unit, "--set " + name));
  }
  return conditions;
}

/// What --set may change of a drawing, from which its areas, its field and its lag follow.
constexpr std::string_view kDrawn[] = {"gap", "pole_length", "piston_area", "gap_area"};

/// The drawn damper, whose coil and fluid tell its yield stress at every current, with the geometry
/// of --set: what the drawing computes from that is computed anew.
DamperDescription description_of(const std::string& damper, const Conditions& changes) {
  DamperDescription description = find_description(damper);
  for (const std::string_view name : kDrawn)
    if (const double* value = find_condition(changes, name))
      description.*find_description_field(name, "--set").field = *value;
  if (description.gap_area > 0 && find_condition(changes, "gap") &&
      !find_condition(changes, "gap_area"))
    throw UsageError("--set",
                     "gap is changed, and " + damper + " states the gap_area of its own gap",
                     "gap_area beside it, or a drawing of that gap");
  const std::string where = changes.empty() ? damper : damper + " with --set";
  require_possible(description, where);
  require_field(description, where);
  return description;
}

/// Says what a family's model does not take of a drawing, and what is to be known of its fluid.
void tell_drawing(const DamperDescription& description, double largest_current, Console& console) {
  if (description.friction > 0 || description.passive_length > 0)
    console.note(
        "friction and passive_length of the drawing do not count: a family's model has learnt "
        "its own from its recordings");
  if (description.fluid->index != 1)
    console.note(description.fluid->name +
                 " is a Herschel-Bulkley fluid: a family's model takes it by its viscosity at its "
                 "shear rate");
  const double field = fluid_state(description, largest_current).field;
  for (const std::string& warning : fluid_warnings(description, field)) console.warn(warning);
}

/// The member that is asked for: of the drawing, or of the family's file, with the numbers of
/// --set.
FamilyMember member_asked_for(const MemberSettings& settings, const FamilyMember& of_file,
                              double largest_current, Console& console) {
  const Conditions changes = changes_of(settings);
  if (!settings.damper.empty()) {
    const DamperDescription description = description_of(settings.damper, changes);
    tell_drawing(description, largest_current, console);
    return with_conditions(member_of(description, largest_current), changes, "--set");
  }

  // Without a drawing nothing follows from a number.
  std::vector<std::string> alone;
  for (const std::string_view name : kDrawn)
    if (find_condition(changes, name)) alone.emplace_back(name);
  if (!alone.empty())
    console.note("areas and yield stress do not follow " + join(alone, ", ") +
                 ": what --set does not name stays that of the file's damper; a drawing computes "
                 "it anew (--damper)");
  return with_conditions(of_file, changes, "--set");
}

std::string table_of(const FamilyModel& model, int width) {
  Table table({"number", "unit", ">this damper", ">the family"});
  for (const MemberField& field : member_fields()) {
    std::string range;
    for (const Family::Range& r : model.family().domain)
      if (r.field == field.field) range = format_number(r.min) + " ... " + format_number(r.max);
    table.row({std::string(field.name), std::string(field.unit),
               format_number(model.member().*field.field), range});
  }

  // The yield stress follows the current: its range stands in place of a number.
  const std::vector<double>& stresses = model.member().yield.stresses;
  table.row({std::string(kYieldStress), "Pa",
             format_number(stresses.front()) +
                 (stresses.size() > 1 ? " ... " + format_number(stresses.back()) : ""),
             model.family().yield ? format_number(model.family().yield->min) + " ... " +
                                        format_number(model.family().yield->max)
                                  : ""});

  return table.text(static_cast<std::size_t>(width));
}

/// How the build differs from its drawing, and whether it can be one of it. by: the recordings that
/// told it; is_drive: of a plant, not of a bench.
void print_build(const BuildReport& report, const std::string& by, bool is_drive,
                 Console& console) {
  Table table({"this build", ">from its drawing", ">builds differ by", ">known to"});
  for (const BuildReport::Deviation& one : report.deviations) {
    const bool newtons = &one == &report.deviations.back();
    const auto text = [&](double value) {
      return newtons ? format_number(value, 3) + " N" : format_number(100 * value, 3) + " %";
    };
    table.row({one.name, text(one.value), text(one.spread), text(one.left)});
  }

  // How much of the force it leaves.
  console.print('\n' + table.text(static_cast<std::size_t>(console.width())) +
                fmt::format("{} the family leaves {} % of the force's power, this build {} %.\n",
                            is_drive ? "As the sensors tell the force," : "On its recording",
                            format_number(report.esr_before, 3),
                            format_number(report.esr_after, 3)));

  // What speaks against it.
  const std::string of_another = std::string("a ") + (is_drive ? "drive with" : "recording of") +
                                 " another damper, or a drawing that is not this damper's";
  if (!report.is_likely())
    console.warn(fmt::format(
        "{}: not one build in a hundred lies so far from its drawing ({} standard deviations): {}",
        by, format_number(std::sqrt(report.distance), 3), of_another));
  else if (!report.is_told())
    console.warn(fmt::format(
        "{}: what this build leaves is {} times what the family usually leaves of a recording{}{}",
        by, format_number(report.left_of_usual, 3),
        is_drive ? ": motions that it has not learnt from, "
                 : ", so that it says nothing of the build: ",
        of_another));
}

/// The member as its recordings on a bench say that it was built.
BuildReport measured(const FamilyModel& member, const ModelFile& family,
                     const MemberSettings& settings, Console& console) {
  const Dataset data = load_dataset({settings.recordings.begin(), settings.recordings.end()});
  const std::string names = join(settings.recordings, ", ");
  for (const std::string& note : data.notes) console.note(note);
  require_same_drive(family, data, names);
  for (const Extrapolation& beyond : extrapolations(family, data)) console.warn(describe(beyond));
  BuildReport report = measure_build(member, data.records, data.drive_unit);
  print_build(report, names, false, console);
  return report;
}

int run_member(const MemberSettings& settings, Console& console) {
  require_output(settings.output);
  ModelFile file = load_model(settings.model);
  const auto* family = model_as<FamilyModel>(*file.model);
  if (!family)
    throw Error(settings.model, "is a model of one damper, not of a family",
                "a file that 'dashpot identify --models family' wrote");

  // The member, marked or refused outside of the family.
  const bool refuse = settings.outside_family == "refuse";
  const auto asked = family->with_outside(refuse ? OutsideFamily::Refuse : OutsideFamily::Mark);
  const double largest =
      std::max(std::abs(file.domain.current_min), std::abs(file.domain.current_max));
  std::shared_ptr<const FamilyModel> member =
      asked->with_member(member_asked_for(settings, family->member(), largest, console));

  if (member->member().build != 0 && family->family().build_spread == 0)
    console.warn("build=" + format_number(member->member().build) + " counts for nothing: " +
                 family->name() + " does not know how builds of a drawing differ");
  const std::vector<std::string> outside = member->extrapolations();
  console.print(table_of(*member, console.width()));
  for (const std::string& what : outside) console.warn(what + ": it extrapolates there");

  // A recording makes the member the build that was recorded.
  Value json = Value::object({{"member", to_json(member->member())},
                              {"outside_family", Value::array(outside)},
                              {"output", settings.output}});
  if (!settings.recordings.empty()) {
    BuildReport report;
    if (settings.plant.empty()) {
      report = measured(*member, file, settings, console);
    } else {
      MemberInPlant found = build_from_drive(
          *member, file, {settings.plant, settings.model, settings.recordings}, console);
      print_document(found.document, console);
      if (!found.build.found.has_models()) return kNotUsable;
      report = std::move(found.build.build);
      print_build(report, join(settings.recordings, ", "), true, console);
      json.add("in_plant", document_json(found.document));
      file.noise_found = told_noise(found.build.found);
    }
    member = report.model;
    Value build = Value::object();
    for (const BuildReport::Deviation& one : report.deviations)
      build.add(one.name,
                Value::object({{"value", one.value}, {"spread", one.spread}, {"left", one.left}}));
    json.add("build", std::move(build));
    json.add("esr_before", report.esr_before);
    json.add("esr_after", report.esr_after);
    json.add("likely", report.is_likely());
  }
  if (console.json) console.print_json(json);

  // The file keeps the family's provenance; only its model becomes the member's.
  if (settings.output.empty()) return kDone;
  file.model = member->with_offset(0);
  save_model(file, settings.output);
  console.print("\nModel  " + settings.output + '\n');
  return kDone;
}

}  // namespace

Command member_command() {
  auto settings = std::make_shared<MemberSettings>();
  return {
      .name = "member",
      .title = "One damper of a fitted family, as a model of its own",
      .description =
          "Reads a model of a family of dampers and makes it the model of one of them: by its "
          "numbers, by a drawing with coil and fluid, or by how far a build is from the mean of "
          "its design. Says what of it lies outside the dampers that the family was fitted on.",

      .options = {{.names = "MODEL",
                   .target = &settings->model,
                   .help = "a model file of a family that 'dashpot identify' wrote",
                   .takes = Takes::File,
                   .required = true},

                  // The member: by its drawing, its numbers or both.
                  {.names = "--damper",
                   .target = &settings->damper,
                   .help = "a damper description, as of 'dashpot physics'",
                   .value = "DAMPER",
                   .takes = Takes::File},
                  {.names = "--set",
                   .target = &settings->changes,
                   .help = "the damper's numbers, as gap=1.25mm,build=1",
                   .value = "LIST"},
                  {.names = "--recording",
                   .target = &settings->recordings,
                   .help = "short recordings of this build, of family_physics: the member is made "
                           "what they say, as far as builds differ",
                   .value = "FILE",
                   .takes = Takes::File},

                  {.names = "--in",
                   .target = &settings->plant,
                   .help = "the recordings are of a plant in which this damper works: a YAML file "
                           "or words (docs/in-plant.md); the build is found with what is unknown "
                           "of it",
                   .value = "PLANT",
                   .takes = Takes::File,
                   .default_text = "a bench that measures the force",
                   .needs = "--recording"},

                  // The limits of the family, and where the model goes.
                  {.names = "--outside-family",
                   .target = &settings->outside_family,
                   .help = "a damper outside the family: warn and go on, or refuse it",
                   .value = "MODE",
                   .choices = {"mark", "refuse"}},
                  {.names = "-o,--output",
                   .target = &settings->output,
                   .help = "write the model of this damper",
                   .value = "FILE",
                   .takes = Takes::File}},

      .example = std::string(kMemberExample),
      .run = [settings](Console& console) { return run_member(*settings, console); }};
}

}  // namespace dashpot::cli
