#include "dashpot/design/design.h"

#include <algorithm>
#include <memory>
#include <set>

#include <fmt/core.h>

#include "commands.h"
#include "console.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/design/design_law.h"
#include "dashpot/machine/comfort_ride.h"
#include "dashpot/report/design_report.h"
#include "design_next.h"
#include "document_text.h"
#include "layout.h"
#include "results.h"

namespace dashpot::cli {
namespace {

namespace fs = std::filesystem;

struct DesignSettings {
  std::string request, start_from, folder = "dashpot-design", method = "nsga2",
                                   outside_family = "mark";
  DesignOptions options;
  std::uint64_t points = DesignOptions().points;
  bool quantities = false, report = true, insist = false;
  NextSettings next;
};

constexpr std::string_view kDesignExample =
    "# A front of dampers for a car: a large range of forces against little mass\n"
    "dashpot design passenger_car --output car\n"
    "\n"
    "# Designs within a fitted family, with the figures of its model and of the physics:\n"
    "dashpot design family_prototype --model results/models/family_gated.json --second physics "
    "--outside-family refuse\n"
    "\n"
    "# The next prototypes to build and record, that would tell a family most:\n"
    "dashpot design my_request.yaml --next 4 --model results/models/family_physics.json\n"
    "\n"
    "# A design is a damper's description and a model:\n"
    "dashpot physics car/designs/design_001.yaml --current 2 --velocity 0.3\n"
    "dashpot track car/models/design_001.json";

DesignRequest requested(const DesignSettings& settings, Goals goals) {
  if (settings.request.empty())
    throw UsageError("REQUEST", "is missing: a file, or one of " + join(request_names(), ", "));
  return is_path(settings.request) ? load_request(settings.request, goals, read_comfort_ride)
                                   : named_request(settings.request);
}

/// The designs that an earlier run left in its folder, in their order.
std::vector<DamperDescription> earlier_designs(const std::string& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(fs::path(folder) / "designs", none))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  if (files.empty())
    throw Error(folder, "holds no designs to go on from", "the --output of an earlier run");
  std::ranges::sort(files);
  std::vector<DamperDescription> designs;
  for (const fs::path& file : files) designs.push_back(load_description(file));
  return designs;
}

std::string quantities_text(int width) {
  Table table({"quantity", "unit", "meaning"});
  for (const DesignQuantity& quantity : design_quantities())
    table.row(
        {std::string(quantity.name), std::string(quantity.unit), std::string(quantity.meaning)});
  return table.text(static_cast<std::size_t>(width));
}

/// Removes the designs of an earlier run, which must not stand among those of this one.
void remove_designs_but(const std::set<fs::path>& written, const fs::path& folder) {
  for (const auto& [part, ending] : {std::pair{"designs", ".yaml"}, std::pair{"models", ".json"}}) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder / part, none))
      if (entry.path().filename().string().starts_with("design_") &&
          entry.path().extension() == ending && !written.contains(entry.path()))
        fs::remove(entry.path());
  }
}

/// The models of a design: members of families, or laws, the largest error of which is kept, as a
/// share of its largest force.
class ModelWriter {
 public:
  ModelWriter(const DesignReport& report, const Console& console)
      : report_(report), console_(console) {
    add(report.options.model, "--model", "");
    if (!report.options.second.empty()) add(report.options.second, "--second", "_second");
  }

  /// Returns the files that it has written.
  std::set<fs::path> write(const Design& design, const fs::path& folder) {
    std::set<fs::path> written;
    for (const Assessor& one : models_) {
      ModelFile file = file_of(design, *one.model);
      file.provenance.command = console_.command_line();
      file.provenance.created = date_now();
      const fs::path path = folder / (design.name + one.ending + ".json");
      save_model(file, path);
      written.insert(path);
    }
    return written;
  }
  /// "laws, within 1.2 % RMS of the largest force"
  std::string text() const {
    std::vector<std::string> kinds;
    if (laws_ > 0)
      kinds.push_back("laws, within " + format_number(100 * worst_, 2) +
                      " % RMS of the largest force");
    if (members_ > 0) kinds.push_back("members of a family");
    return join(kinds, "; ");
  }

 private:
  struct Assessor {
    std::unique_ptr<DesignModel> model;
    std::string ending;
  };
  void add(const std::string& name, const std::string& option, const std::string& ending) {
    models_.push_back({make_design_model(name, option), ending});
  }
  ModelFile file_of(const Design& design, const DesignModel& model) {
    if (std::optional<ModelFile> own = model.model_of(design.damper)) {
      ++members_;
      return std::move(*own);
    }
    ++laws_;
    DesignLaw law = law_of_design(design.damper, report_.request, model);
    worst_ = std::max(worst_, law.rms_error / law.largest_force);
    return std::move(law.file);
  }

  const DesignReport& report_;
  const Console& console_;
  std::vector<Assessor> models_;
  int laws_ = 0, members_ = 0;
  double worst_ = 0;
};

/// Descriptions and models; says of which kind these are.
std::string write_designs(const DesignReport& report, const fs::path& folder,
                          const Console& console) {
  ModelWriter models(report, console);
  std::set<fs::path> written;
  for (const Design& design : report.designs) {
    const fs::path path = folder / "designs" / (design.name + ".yaml");
    write_file(path, format_description(design.damper));
    written.insert(path);
    written.merge(models.write(design, folder / "models"));
  }
  remove_designs_but(written, folder);
  return models.text();
}

void write_results(const Document& report, const DesignInput& input, const DesignSettings& settings,
                   Console& console) {
  const fs::path folder = settings.folder;
  std::string where;
  if (!input.design.designs.empty()) {
    const std::string kinds = write_designs(input.design, folder, console);
    where = fmt::format("\nDesigns  {}/\nModels   {}/ ({})\n", (folder / "designs").string(),
                        (folder / "models").string(), kinds);
  }
  if (settings.report) {
    if (where.empty()) where = "\n";
    where += write_document(report, folder, "design", false, csv_design(input.design));
  }
  console.print(where);
}

int run_design(DesignSettings settings, Console& console) {
  if (settings.quantities) {
    console.print(quantities_text(console.width()));
    return kDone;
  }

  if (settings.next.count > 0) {
    return run_next(settings.next, requested(settings, Goals::Optional), settings.options.model,
                    settings.folder, settings.options.seed, settings.options.threads, console);
  }

  // The words of the command line become options of the search.
  const DesignRequest request = requested(settings, Goals::Required);
  settings.options.points = static_cast<std::size_t>(settings.points);
  settings.options.method = settings.method == "moead" ? FrontMethod::Moead : FrontMethod::Nsga2;
  settings.options.refuse_outside = settings.outside_family == "refuse";
  settings.options.insist = settings.insist;
  if (!settings.start_from.empty()) {
    if (request.goals.size() < 2)
      throw UsageError("--start-from", "a single goal is searched anew", "leave it out");
    settings.options.starts = earlier_designs(settings.start_from);
  }
  settings.options.monitor = console.monitor();

  // A folder that cannot be written is found out before the search, not after it.
  prepare_results({settings.folder, settings.report});
  const DesignReport report = design(request, settings.options);

  // The designs go to the terminal, into files and, if asked for, out as JSON.
  const DesignInput input{report, console.command_line(), DASHPOT_VERSION, date_now()};
  const Document document = design_document(input);
  print_document(document, console);
  console.print(fmt::format("{} dampers assessed in {} s\n", report.evaluations,
                            format_number(report.wall_seconds, 3)));
  for (const std::string& note : report.notes) console.warn(note);
  write_results(document, input, settings, console);
  if (console.json) console.print_json(document_json(document));

  // An interrupted search writes its designs first and then ends as interrupted.
  if (report.stopped) console.check_stop();
  if (!report.designs.empty()) return kDone;
  console.error(!report.conflict                   ? "no design was found"
                : report.conflict->members.empty() ? "there is no design; the lines above say why"
                                                   : "the constraints conflict; the lines above "
                                                     "say which");
  return kNotUsable;
}

std::vector<Option> options_of(DesignSettings& settings) {
  std::vector<Option> options{
      // The request, and where its designs go.
      {.names = "REQUEST",
       .target = &settings.request,
       .help = "what may vary, what must hold and what to favour: a YAML file, or one that comes "
               "with Dashpot: " +
               join(request_names(), ", "),
       .takes = Takes::File},
      {.names = "-o,--output",
       .target = &settings.folder,
       .help = "folder of the results",
       .value = "DIR",
       .takes = Takes::Folder},

      // The search for the front.
      {.names = "--points",
       .target = &settings.points,
       .help = "designs on the front of several goals",
       .value = "N",
       .minimum = 4},
      {.names = "--generations",
       .target = &settings.options.generations,
       .help = "generations of the search for the front",
       .value = "N",
       .minimum = 1},
      {.names = "--start-from",
       .target = &settings.start_from,
       .help = "go on from the designs in an earlier run's folder",
       .value = "DIR",
       .takes = Takes::Folder,
       .default_text = "none"},
      {.names = "--method",
       .target = &settings.method,
       .help = "method of the search for the front",
       .value = "NAME",
       .choices = {"nsga2", "moead"},
       .noun = "method"},

      // The models that assess a design.
      {.names = "--model",
       .target = &settings.options.model,
       .help =
           "the model that assesses a design: first principles, or the file of a family's model",
       .value = "MODEL",
       .choices = design_model_names(),
       .noun = "model",
       .takes = Takes::File},
      {.names = "--second",
       .target = &settings.options.second,
       .help = "a second model, whose figures stand beside the first's; constraints and goals can "
               "use it too",
       .value = "MODEL",
       .choices = design_model_names(),
       .noun = "model",
       .takes = Takes::File,
       .default_text = "none"},
      {.names = "--outside-family",
       .target = &settings.outside_family,
       .help = "designs beyond the dampers that a family was fitted on",
       .value = "MODE",
       .choices = {"mark", "refuse"}},
      {.names = "--insist",
       .target = &settings.insist,
       .help = fmt::format("keep designs whose force lies {} times further from the plate flow's "
                           "than that of a family's damper, or that feed energy in",
                           kMostLeap)},

      // The run itself, and what it prints or leaves out.
      seed_option(settings.options.seed),
      threads_option(settings.options.threads),
      {.names = "--quantities",
       .target = &settings.quantities,
       .help = "list what constraints and goals may name"},
      {.names = "--no-report",
       .target = &settings.report,
       .help = "write descriptions and models only"}};
  for (Option& option : next_options(settings.next)) options.push_back(std::move(option));
  return options;
}

}  // namespace

Command design_command() {
  auto settings = std::make_shared<DesignSettings>();
  return {.name = "design",
          .title = "Design dampers that meet a request",
          .description =
              "Finds dampers that meet a request: the best for one goal, or a front for several, "
              "also where made dampers differ from their drawing. Each design is written as a "
              "description and as a model for the other commands, after it was read again and "
              "checked. Where none is possible, it says which constraints conflict.",
          .options = options_of(*settings),
          .example = std::string(kDesignExample),
          .run = [settings](Console& console) { return run_design(*settings, console); }};
}

}  // namespace dashpot::cli
