#include "design_next.h"

#include <cmath>
#include <filesystem>
#include <numbers>

#include <fmt/core.h>

#include "campaign.h"
#include "dashpot/base/escape.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/design/next_drawings.h"
#include "dashpot/error.h"
#include "dashpot/model_file.h"
#include "layout.h"

namespace dashpot::cli {
namespace {

namespace fs = std::filesystem;

/// The sines and currents asked for; else the family's largest stroke and a quarter of it at its
/// largest speed, without current, at half of the largest and at that.
std::vector<DrawingTest> tests_of(const NextSettings& settings, const Domain& domain) {
  std::vector<SineMotion> motions;
  for (const std::string& motion : settings.motions) motions.push_back(parse_motion(motion));
  if (motions.empty()) {
    const double stroke = 0.5 * (domain.displacement_max - domain.displacement_min);
    const double speed = std::max(std::abs(domain.velocity_min), std::abs(domain.velocity_max));
    if (!(stroke > 0 && speed > 0))
      throw UsageError("--motions", "is missing, and the family's file tells no stroke and speed",
                       "as 20x0.6");
    for (const double amplitude : {stroke, 0.25 * stroke})
      motions.push_back({amplitude, speed / (2 * std::numbers::pi * amplitude)});
  }
  std::vector<double> levels;
  for (const std::string& level : settings.levels) levels.push_back(parse_level(level));
  const double largest = std::max(std::abs(domain.current_min), std::abs(domain.current_max));
  if (levels.empty())
    levels = largest > 0 ? std::vector{0., 0.5 * largest, largest} : std::vector{0.};

  std::vector<DrawingTest> tests;
  for (const SineMotion& motion : motions)
    for (const double level : levels) tests.push_back({motion, level});
  return tests;
}

std::string motion_text(const SineMotion& motion) {
  return format_number(1e3 * motion.amplitude, 3) + " mm " + format_number(motion.frequency, 3) +
         " Hz";
}
std::string percent(double share) { return format_number(100 * share, 3); }

/// The number of a drawing's tests that leave its band within 5 % of what all of them do.
std::size_t enough_tests(const NextDrawing& drawing) {
  constexpr double kNear = 1.05;
  std::size_t k = 0;
  while (drawing.band_after[k] > kNear * drawing.band_after.back()) ++k;
  return k + 1;
}

std::string table_of(const DesignRequest& request, const NextReport& report, int width) {
  std::vector<std::string> titles{"drawing"};
  for (const DesignVariable& variable : request.variables) {
    const std::string unit = variable.field ? shown_unit(variable.field->unit).unit : "";
    titles.push_back(">" + variable.name() + (unit.empty() ? "" : " " + unit));
  }
  titles.insert(titles.end(), {">band %", ">tests", "outside the family"});
  Table table(titles);
  for (const NextDrawing& drawing : report.drawings) {
    std::vector<std::string> cells{drawing.damper.name};
    for (const DesignVariable& variable : request.variables)
      cells.push_back(variable.field ? format_number(drawing.damper.*variable.field->field /
                                                         shown_unit(variable.field->unit).factor,
                                                     4)
                                     : drawing.damper.fluid->name);

    // The names alone of the fields in which it lies outside: "gap is 2.2 mm, the family ...".
    std::vector<std::string> outside;
    for (const std::string& what : drawing.outside)
      outside.push_back(what.substr(0, what.find(' ')));
    cells.insert(cells.end(), {percent(drawing.band), std::to_string(enough_tests(drawing)),
                               join(outside, ", ")});
    table.row(std::move(cells));
  }
  return table.text(static_cast<std::size_t>(width));
}

}  // namespace

std::vector<Option> next_options(NextSettings& settings) {
  return {{.names = "--next",
           .target = &settings.count,
           .help = "in place of designs: so many drawings whose recording would tell --model, a "
                   "family_physics, most",
           .value = "N",
           .minimum = 1,
           .default_text = "none",
           .idles = {{{"--points", "--generations", "--start-from", "--method", "--second",
                       "--outside-family", "--insist", "--no-report"},
                      ", which searches for no designs"}}},
          {.names = "--motions",
           .target = &settings.motions,
           .help = "sines that --next would record, in mm x Hz",
           .value = "LIST",
           .default_text = "two at the family's speed",
           .needs = "--next"},
          {.names = "--levels",
           .target = &settings.levels,
           .help = "currents that --next would record, A",
           .value = "LIST",
           .default_text = "three",
           .needs = "--next"}};
}

int run_next(const NextSettings& settings, const DesignRequest& request,
             const std::string& model_name, const std::string& folder, std::uint64_t seed,
             int threads, Console& console) {
  constexpr int kMostDrawings = 200;  // the search grows with the square of them
  if (settings.count > kMostDrawings)
    throw UsageError("--next", std::to_string(settings.count) + " is too large",
                     "at most " + std::to_string(kMostDrawings));
  if (!is_path(model_name))
    throw UsageError("--next", "asks what a fitted family does not know yet",
                     "--model FILE, of a family_physics");
  const ModelFile file = load_model(model_name);
  const auto* family = model_as<FamilyModel>(*file.model);
  if (!family)
    throw Error(model_name, "is a model of one damper, not of a family",
                "a file that 'dashpot identify --models family_physics' wrote");

  // The choice.
  NextOptions options;
  options.count = static_cast<std::size_t>(settings.count);
  options.tests = tests_of(settings, file.domain);
  options.seed = seed;
  options.threads = threads;
  options.monitor = console.monitor();
  NextReport report = next_drawings(request, *family, options);

  // The drawings, and the manifest of the recordings to come, each damper's most telling first.
  std::string manifest = "file,damper,name,motion,current_A,band_percent\n";
  Value drawings = Value::array(std::vector<Value>{});
  for (std::size_t k = 0; k < report.drawings.size(); ++k) {
    NextDrawing& drawing = report.drawings[k];
    drawing.damper.name = fmt::format("next_{:02}", k + 1);
    const std::string path = "drawings/" + drawing.damper.name + ".yaml";
    write_file(fs::path(folder) / path, format_description(drawing.damper));
    Value tests = Value::array(std::vector<Value>{});
    for (std::size_t t = 0; t < drawing.tests.size(); ++t) {
      const DrawingTest& test = options.tests[drawing.tests[t]];
      manifest += csv_field(fmt::format("{}_{:02}.csv", drawing.damper.name, t + 1)) + ',' + path +
                  ',' + drawing.damper.name + ',' + csv_field(motion_text(test.motion)) + ',' +
                  format_number(test.current) + ',' + percent(drawing.band_after[t]) + '\n';
      tests.push_back(Value::object({{"amplitude_m", test.motion.amplitude},
                                     {"frequency_Hz", test.motion.frequency},
                                     {"current_A", test.current},
                                     {"band_after", drawing.band_after[t]}}));
    }
    drawings.push_back(Value::object({{"drawing", path},
                                      {"band", drawing.band},
                                      {"outside_family", Value::array(drawing.outside)},
                                      {"tests", std::move(tests)}}));
  }
  write_file(fs::path(folder) / "manifest.csv", manifest);

  console.print(fmt::format(
      "What the family does not know of the force is +-{} % (90 %, over what may vary and {} "
      "tests).\nRecorded one after the other, of {} drawings:\n\n",
      percent(report.before), options.tests.size(), report.candidates));
  console.print(table_of(request, report, console.width()));
  console.print(fmt::format(
      "\n'tests': so many of a drawing's leave what all of them do, within 5 %.\nAs many drawings "
      "by chance leave +-{} %, of an even grid +-{} %. A new build, and what the family\ngets "
      "wrong of a drawing, add +-{} % to the band of a damper, however many are recorded.\n\n"
      "Drawings  {}\nManifest  {}, each drawing's most telling recording first\n",
      percent(report.random), percent(report.grid), percent(report.builds),
      (fs::path(folder) / "drawings").string(), (fs::path(folder) / "manifest.csv").string()));
  if (console.json)
    console.print_json(Value::object({{"band_before", report.before},
                                      {"band_random", report.random},
                                      {"band_grid", report.grid},
                                      {"band_of_builds", report.builds},
                                      {"drawings", std::move(drawings)}}));
  return kDone;
}

}  // namespace dashpot::cli
