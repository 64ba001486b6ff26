#include "bench_family.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "dashpot/base/escape.h"
#include "dashpot/base/file.h"
#include "dashpot/base/parallel.h"
#include "dashpot/base/random.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/damper/drawn_damper.h"
#include "dashpot/physics/damper_physics.h"

namespace dashpot::cli {
namespace {

namespace fs = std::filesystem;

/// A drawing of the family, with one of its fluids.
struct FamilyDrawing {
  std::string name;
  DamperDescription damper;
};
/// One damper of the virtual family, and its recordings.
struct BuiltDamper {
  const FamilyDrawing* drawing;
  std::size_t build;
  DrawnBuild truth;
  Dataset campaign = {};
};

/// The drawings' files, in the order of their names.
std::vector<fs::path> drawing_files(const std::vector<std::string>& named) {
  std::vector<fs::path> files;
  for (const std::string& name : named) {
    if (!fs::is_directory(name)) {
      files.emplace_back(name);
      continue;
    }
    std::vector<fs::path> inside;
    for (const fs::directory_entry& entry : fs::directory_iterator(name))
      if (entry.path().extension() == ".yaml" || entry.path().extension() == ".yml")
        inside.push_back(entry.path());
    if (inside.empty())
      throw Error(name, "holds no drawing", "files NAME.yaml, as 'dashpot physics' takes them");
    std::ranges::sort(inside);
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

/// Every drawing with every fluid, or with its own.
std::vector<FamilyDrawing> drawings_of(const FamilyBenchSettings& family) {
  std::vector<std::shared_ptr<const Fluid>> fluids;
  for (const std::string& fluid : family.fluids) fluids.push_back(find_fluid(fluid, "--fluid"));

  std::vector<FamilyDrawing> drawings;
  for (const fs::path& file : drawing_files(family.drawings)) {
    const FamilyDrawing drawn{file.stem().string(), find_description(file.string())};
    require_field(drawn.damper, file.string());
    if (fluids.empty()) drawings.push_back(drawn);
    for (const std::shared_ptr<const Fluid>& fluid : fluids) {
      FamilyDrawing other = drawn;
      other.name += "_" + fluid->name;
      other.damper.fluid = fluid;
      if (!fluid->law(other.damper.yield_law)) other.damper.yield_law.clear();
      require_possible(other.damper, file.string() + " with " + fluid->name);
      drawings.push_back(std::move(other));
    }
  }

  std::set<std::string> names;
  for (FamilyDrawing& drawing : drawings) {
    std::ranges::replace_if(
        drawing.name, [](char c) { return c == '/' || c == ' ' || c == ','; }, '_');
    if (!names.insert(drawing.name).second)
      throw Error("--family", "two drawings are called " + drawing.name,
                  "files, and fluids, of different names");
    drawing.damper.name = drawing.name;
  }
  return drawings;
}

/// The geometry that differs between drawings, by which a design is left out; else the fluid.
std::string leave_out_of(const std::vector<FamilyDrawing>& drawings) {
  std::vector<std::string> varied;
  for (const MemberField& field : member_fields()) {
    if (!field.required || field.field == &FamilyMember::gap_area) continue;
    const auto value = [&](const FamilyDrawing& drawing) {
      constexpr double kNoCurrent[] = {0.};
      return member_of(drawing.damper, kNoCurrent).*field.field;
    };
    const bool differs = std::ranges::any_of(drawings, [&](const FamilyDrawing& drawing) {
      return std::abs(value(drawing) - value(drawings.front())) > 1e-9 * value(drawings.front());
    });
    const bool is_fluid = field.field == &FamilyMember::viscosity;
    if (differs && (!is_fluid || varied.empty())) varied.emplace_back(field.name);
  }
  // Areas follow from the gap where the bore is the same: then the drawing's own numbers say it.
  if (varied.size() > 1 && varied.front() == "piston_area" &&
      std::ranges::all_of(drawings, [&](const FamilyDrawing& drawing) {
        return drawing.damper.bore_diameter == drawings.front().damper.bore_diameter &&
               drawing.damper.rod_diameter == drawings.front().damper.rod_diameter;
      }))
    varied.erase(varied.begin());
  return varied.empty() ? "condition" : "each=" + join(varied, ",");
}

/// N/m, at which the spring gives that way under the yielding force at the largest current.
double series_stiffness(const DamperDescription& damper, double largest, double give) {
  const DamperPhysics p = evaluate_physics(damper, {.current = largest, .velocity = 0.1});
  return p.plate_force / give;
}

/// Every build of every drawing, drawn by chance.
std::vector<BuiltDamper> builds_of(const std::vector<FamilyDrawing>& drawings,
                                   const FamilyBenchSettings& family, double largest,
                                   std::uint64_t seed) {
  constexpr double kLeast = 0.1;  // of the strength: no build is weaker, however wide the scatter
  const double give = parse_quantity(family.give, "m", "--give");
  if (!(give > 0)) throw UsageError("--give", "is not more than 0", "as 0.3mm");

  // Strength and friction scatter about the drawing; what gives is the drawing's.
  Random random(seed);
  std::vector<BuiltDamper> built;
  for (const FamilyDrawing& drawing : drawings) {
    const double stiffness = series_stiffness(drawing.damper, largest, give);
    for (std::size_t build = 1; build <= family.builds; ++build) {
      const auto chance = [&] { return std::max(kLeast, 1 + family.scatter * random.normal()); };
      const double strength = chance();
      built.push_back(
          {&drawing,
           build,
           {strength, drawing.damper.friction * chance(), stiffness, family.asymmetry}});
    }
  }
  return built;
}

/// Which drawings were moved further than they are drawn for.
std::vector<std::string> beyond_stroke(const std::vector<BuiltDamper>& built) {
  constexpr double kMillimetres = 1e3, kNoise = 1.01;
  std::map<std::string, double> furthest;  // m, from end to end
  std::map<std::string, double> strokes;
  for (const BuiltDamper& damper : built)
    for (const Record& record : damper.campaign.records) {
      const auto [low, high] = std::ranges::minmax(record.channel("displacement").samples);
      const double stroke = damper.drawing->damper.stroke;
      if (high - low <= kNoise * stroke) continue;
      double& most = furthest[damper.drawing->name];
      most = std::max(most, high - low);
      strokes[damper.drawing->name] = stroke;
    }

  std::vector<std::string> warnings;
  for (const auto& [name, most] : furthest)
    warnings.push_back(name + " was moved over " + format_number(kMillimetres * most, 3) +
                       " mm; its stroke is drawn as " +
                       format_number(kMillimetres * strokes[name], 3) + " mm");
  return warnings;
}

std::string manifest_of(const std::vector<BuiltDamper>& built) {
  std::string text = "file,damper,name,build,motion,current_A\n";
  for (const BuiltDamper& damper : built)
    for (const Record& record : damper.campaign.records)
      text += csv_field(recording_file(record)) + ",drawings/" + damper.drawing->name + ".yaml," +
              csv_field(damper.drawing->name) + ',' + std::to_string(damper.build) + ',' +
              csv_field(record.condition) + ',' + format_exact(*record.drive_level) + '\n';
  return text;
}

std::string statement_of(const std::vector<BuiltDamper>& built, const std::string& leave_out,
                         const std::string& command) {
  std::string text = "# Written by " + yaml_comment(command) + "\n# The truth:\n";
  for (const BuiltDamper& damper : built)
    text += "#   " + yaml_comment(damper.drawing->name) + ", build " +
            std::to_string(damper.build) + ": strength " + format_number(damper.truth.strength) +
            ", friction " + format_number(damper.truth.friction) + " N, series spring " +
            format_number(damper.truth.stiffness) + " N/m\n";
  const bool builds_repeat =
      std::ranges::any_of(built, [](const BuiltDamper& damper) { return damper.build > 1; });
  return text + "name: virtual family\ncitation: " + yaml_string(built.front().campaign.citation) +
         "\ndrive: A\nleave_out: " + yaml_string(leave_out) +
         "\nnotes: simulated, not measured\nfiles:\n"
         "  - match: \"*.csv\"\n    damper: {manifest: damper}\n    level: {manifest: current_A}\n"
         "    condition: \"{name}, build {build}, {motion}\"\n" +
         (builds_repeat ? "    conditions: {specimen: {manifest: build}}\n" : "");
}

}  // namespace

std::vector<Option> family_bench_options(FamilyBenchSettings& family) {
  return {{.names = "--family",
           .target = &family.drawings,
           .help = "drawings in place of one damper, files or folders, as 'dashpot physics' takes "
                   "them: each is built, and its yield stress follows from coil and fluid",
           .value = "LIST",
           .takes = Takes::File},
          {.names = "--fluid",
           .target = &family.fluids,
           .help = "fluids in place of the drawings' own, by name or file: each drawing with each",
           .value = "LIST"},
          {.names = "--builds",
           .target = &family.builds,
           .help = "builds of each drawing",
           .value = "N",
           .minimum = 1},
          {.names = "--asymmetry",
           .target = &family.asymmetry,
           .help = "share by which the valves resist extension more, and compression less",
           .value = "SHARE"},
          {.names = "--give",
           .target = &family.give,
           .help = "way by which what is in series with the flow gives at the largest current",
           .value = "MM"}};
}

FamilyBench bench_family(const FamilyBenchSettings& family, const CampaignSettings& settings,
                         const fs::path& folder, const std::string& command) {
  if (!(settings.drive.empty() && settings.experiment.empty()))
    throw UsageError(settings.drive.empty() ? "--experiment" : "--drive",
                     "is not run by a family, whose yield stress is stated per record", "--levels");
  if (!(std::abs(family.asymmetry) < 1))
    throw UsageError("--asymmetry", "is not between -1 and 1", "as 0.1");

  // What is built, and the tests that each of them goes through.
  const std::vector<FamilyDrawing> drawings = drawings_of(family);
  BenchOptions options = settings.bench;
  if (settings.sample_rate > 0) options.sample_rate = settings.sample_rate;
  std::vector<double> levels = stated_levels(settings);
  if (levels.empty()) levels = options.drive_levels;
  double largest = 0;
  for (const double level : levels) largest = std::max(largest, std::abs(level));
  std::vector<BenchTest> tests;
  for (const BenchTest& motion : campaign_motions(settings, options))
    for (const double level : levels) tests.push_back(at_level(motion, level, DriveUnit::Ampere));
  std::vector<BuiltDamper> built = builds_of(drawings, family, largest, options.seed);

  // Every damper is recorded before the first file is written; each has noise of its own.
  parallel_for(built.size(), 0, [&](std::size_t k) {
    BenchOptions own = options;
    own.seed = options.seed + 1 + k;
    const DrawnDamper damper(built[k].drawing->damper, built[k].truth, largest);
    built[k].campaign = run_virtual_bench(damper, DriveUnit::Ampere, tests, own);
    for (Record& record : built[k].campaign.records)
      record.name =
          built[k].drawing->name + ", build " + std::to_string(built[k].build) + ", " + record.name;
  });

  FamilyBench made{drawings.size(), built.size(), 0, folder / "dataset.yaml", beyond_stroke(built)};
  for (const BuiltDamper& damper : built)
    for (const Record& record : damper.campaign.records) {
      write_file(folder / recording_file(record),
                 recording_csv(record, DriveUnit::Ampere, settings.units));
      ++made.records;
    }
  for (const FamilyDrawing& drawing : drawings)
    write_file(folder / "drawings" / (drawing.name + ".yaml"), format_description(drawing.damper));
  write_file(folder / "manifest.csv", manifest_of(built));
  write_file(made.statement, statement_of(built, leave_out_of(drawings), command));
  return made;
}

}  // namespace dashpot::cli
