#include <algorithm>
#include <filesystem>

#include "damper/kinds/family/example_family.h"
#include "dashpot/damper/kinds/family/line_family.h"
#include "dashpot/design/design.h"
#include "dashpot/error.h"
#include "dashpot/physics/damper_physics.h"
#include "dashpot/report/design_report.h"
#include "resisting_family.h"
#include "support.h"

using namespace dashpot;

namespace {

// Gap and pole length of the family paper's prototype: the family has gaps of 0.5 to 2 mm.
constexpr const char* kRequest = R"(
damper: family_prototype
at: {current: 0.5 A, velocity: 20 mm/s}
vary: {gap: {from: 1.5 mm, to: 3 mm}, pole_length: {from: 6 mm, to: 10 mm}, turns: {from: 3000, to: 4000}}
follow: {gap_area: {gap: 0.02487}, magnetic_gap: {gap: 2}}
goals: [{maximise: gap}]
)";

/// The example's file, of a family that was driven up to 1 A, 50 mm/s and 20 mm.
std::string family_file(const TemporaryFolder& folder, const FamilyModel& model,
                        const std::optional<ForceBand>& band = {}) {
  const auto path = folder.path() / "family.json";
  ModelFile file;
  file.model = model.with_offset(0);
  file.interval = band;
  file.domain = {-0.02, 0.02, -0.05, 0.05, 0, 1};
  save_model(file, path);
  return path.string();
}

DesignReport designed_by_family(const std::string& text, DesignOptions options) {
  options.threads = 1;
  return design(parse_request(text, "request.yaml"), options);
}

}  // namespace

TEST_CASE(
    "design by a family: a model without a memory gives the force of the member that is drawn") {
  const TemporaryFolder folder;
  const FamilyModel family = example_family_network();
  const auto model = make_design_model(family_file(folder, family), "--model");
  CHECK(model->name() == "family_h3x15");
  CHECK(model->is_fitted());
  const DamperDescription drawn = named_description("family_prototype");
  const DamperOperation at{0.7, 0.02, 0.001};
  const DamperPhysics physics = evaluate_physics(drawn, at), told = model->evaluate(drawn, at);
  const FamilyMember member = member_of(drawn, std::vector<double>{0, 0.7});
  const double force = family.with_member(member)->force({0.001, 0.02, 0.7}, {});
  const double off = family.with_member(member)->force({0.001, 0.02, 0}, {});
  CHECK_CLOSE(told.force, force, 1e-12, 0);
  CHECK_CLOSE(told.off_force, off, 1e-12, 0);
  CHECK_CLOSE(told.dynamic_range, (force - physics.spring_force) / (off - physics.spring_force),
              1e-12, 0);
  CHECK(told.flux_density == physics.flux_density);  // the rest is first principles'
}

TEST_CASE(
    "design by a family: one with a memory is told in a sine of the stroke of its recordings") {
  const TemporaryFolder folder;
  const DamperDescription drawn = named_description("family_prototype");
  for (const FamilyModel& family : {resisting_family(), example_family_physics()})
    for (const DamperOperation at :
         {DamperOperation{0.7, 0.02}, {0.7, -0.05}, {0.2, 0.001}, {0.7, 0.02, 0.01}}) {
      CAPTURE(family.name());
      CAPTURE(at.velocity);
      // The same motion, run for twenty cycles in steps a tenth as long or less.
      const auto damper = family.with_member(member_of(drawn, std::vector<double>{0, at.current}));
      const double rate = std::abs(at.velocity) / 0.02, size = std::hypot(0.02, at.displacement);
      const double end = std::atan2(at.displacement, std::copysign(0.02, at.velocity)),
                   step = 2 * 3.14159265358979 / 1000;
      std::vector<double> state(damper->state_size());
      const auto input = [&](int k) {
        return DamperInput{size * std::sin(end + k * step), size * rate * std::cos(end + k * step),
                           at.current};
      };
      damper->rest(input(0), state);
      for (int k = 1; k <= 20000; ++k) damper->advance(input(k - 1), input(k), step / rate, state);
      const auto model = make_design_model(family_file(folder, family), "--model", true);
      CHECK_CLOSE(model->evaluate(drawn, at).force, damper->force(input(0), state), 2e-3, 0);
    }
}

TEST_CASE("design beyond a family: marked, or kept within it by a constraint of its own") {
  const TemporaryFolder folder;
  const std::string file = family_file(folder, resisting_family());
  const DesignReport marked = designed_by_family(kRequest, {.model = file});
  REQUIRE(marked.designs.size() == 1);
  CHECK_CLOSE(marked.designs[0].damper.gap, 3e-3, 1e-6, 0);
  REQUIRE(!marked.designs[0].outside.empty());
  CHECK(marked.designs[0].outside[0].find("the family has") != std::string::npos);
  CHECK(csv_design(marked).find("the family has") != std::string::npos);
  CHECK(design_verdict(marked).find("beyond the dampers") != std::string::npos);

  const DesignReport within = designed_by_family(kRequest, {.model = file, .refuse_outside = true});
  REQUIRE(within.designs.size() == 1);
  CHECK(within.designs[0].outside.empty());
  CHECK_CLOSE(within.designs[0].damper.gap, 2e-3, 1e-4, 0);
}

TEST_CASE("design by two models: constraints and goals of either, and by how much they differ") {
  const TemporaryFolder folder;
  const std::string file = family_file(folder, example_family_network());
  const std::string request =
      std::string(kRequest).substr(0, std::string(kRequest).find("goals")) + R"(
constraints: [{quantity: force, min: 1 N}, {quantity: force, max: 1 MN, by: both}]
goals: [{maximise: force, by: second}]
)";
  const DesignReport report = designed_by_family(request, {.model = "physics", .second = file});
  REQUIRE(report.designs.size() == 1);
  const Design& own = report.designs[0];
  CHECK(report.request.constraints.size() == 3);
  CHECK(own.assessment.goals[0] == own.second[0]);
  CHECK(own.assessment.constraints[0] == own.first[1]);
  CHECK(own.assessment.constraints[2] == own.second[3]);
  CHECK_CLOSE(own.disagreement, std::abs(own.second[0] / own.first[0] - 1), 1e-12, 0);
  CHECK(describe(report.request.goals[0]).ends_with(", by the second model"));
  const DocumentTable table = constraint_table(report, own);
  CHECK(std::ranges::any_of(table.columns, [](const TextColumn& column) {
    return column.title.find("family_h3x15") != std::string::npos;
  }));
  CHECK(message_of([&] { designed_by_family(request, {.model = file}); }).find("second model") !=
        std::string::npos);
}

TEST_CASE("design by a family: what it cannot know is told") {
  const TemporaryFolder folder;
  const std::string file = family_file(folder, resisting_family());
  const std::string request = std::string(kRequest).substr(0, std::string(kRequest).find("goals")) +
                              "goals: [{maximise: force, current: 3 A}]";
  const DesignReport report = designed_by_family(request, {.model = file});
  REQUIRE(!report.notes.empty());
  CHECK(report.notes[0] == "family_gated knows a current up to 1 A, not of 3 A");

  // Within its currents: it reads these, and so does not see the turns.
  std::string within = request;
  within.replace(within.find("3 A"), 3, "0.5 A");
  CHECK(std::ranges::any_of(
      designed_by_family(within, {.model = file}).notes,
      [](const std::string& note) { return contains(note, "does not see turns:"); }));
  CHECK(message_of([&] {
          designed_by_family(request, {.model = file, .refuse_outside = true});
        }).find("3 A") != std::string::npos);
  const std::string law = folder.write("law.json", "{}").string();
  CHECK_THROWS_AS(make_design_model(law, "--model"), Error);
}

TEST_CASE("a design by a family is a member of it, as a file that reads back") {
  const TemporaryFolder folder;
  const auto model = make_design_model(family_file(folder, example_family()), "--model");
  DamperDescription drawn = named_description("family_prototype");
  drawn.gap = 1.7e-3;
  const std::optional<ModelFile> file = model->model_of(drawn);
  REQUIRE(file);
  const ModelFile read = parse_model(format_model(*file), "design");
  const auto& member = dynamic_cast<const FamilyModel&>(*read.model);
  CHECK(member.member().gap == 1.7e-3);
  CHECK(member.member().viscosity == 0.28);
  CHECK(read.domain.current_max == 1);
  // Beside the states of the family stands the current of a coil that lags as drawn.
  CHECK_CLOSE(member.member().lag_rate,
              1 / evaluate_physics(drawn, {.current = read.domain.current_max}).time_constant,
              1e-12, 0);
  const std::vector<double> state{0.2, 0.4, 0.01, 0.5};
  CHECK(member.force({0, 0.02, 0.1}, state) ==
        example_family()
            .specialised({{"gap", 1.7e-3}})
            ->force({0, 0.02, 0.5}, std::span(state).first(3)));
  CHECK(!make_design_model("physics", "")->model_of(drawn));
}

TEST_CASE("design by a family: a force that does not resist, or leaps from physics, is refused") {
  // A line whose force falls by a power of the gap that physics has not: to nothing at 2 mm.
  const TemporaryFolder folder;
  FamilyLine line;
  line.gap = 1e-3;
  line.pole_length = 6e-3;
  line.viscosity = 0.28;
  line.slow = 1e-3;
  line.size = {3, 0.2, 0, 0, 0, -12};
  line.phase.assign(6, 0.);
  Family family = family_of(std::make_shared<LineFamily>(line));
  const FamilyModel model(std::make_shared<Family>(family), example_member());
  const std::string file = family_file(folder, model);
  DamperDescription drawn = named_description("family_prototype");
  const DamperOperation at{0.5, 0.02};
  CHECK(std::isfinite(make_design_model(file, "--model")->evaluate(drawn, at).force));
  drawn.gap *= 2;
  drawn.gap_area *= 2;
  const auto judge = make_design_model(file, "--model");
  CHECK_FALSE(judge->has_refused());
  CHECK(std::isnan(judge->evaluate(drawn, at).force));
  CHECK(judge->has_refused());
  CHECK(std::isfinite(make_design_model(file, "--model", true)->evaluate(drawn, at).force));

  // A force that helps the motion is refused, whoever insists.
  line.phase[0] = 3;
  family.force = std::make_shared<LineFamily>(line);
  const std::string wrong =
      family_file(folder, FamilyModel(std::make_shared<Family>(family), example_member()));
  CHECK(std::isnan(make_design_model(wrong, "--model", true)->evaluate(drawn, at).force));
}

TEST_CASE(
    "design by a family: a range that leaps where neither force does, or no number, is refused") {
  // Ten turns make hardly a field, which the line does not see: it has currents. A longer pole then
  // makes its forces more than physics has, too.
  const TemporaryFolder folder;
  FamilyLine line;
  line.gap = 1e-3;
  line.pole_length = 6e-3;
  line.viscosity = 0.28;
  line.slow = 1e-3;
  line.size = {1.5, 1, 0, 0, 10, 0};
  line.phase.assign(6, 0.);
  Family family = family_of(std::make_shared<LineFamily>(line));
  const DamperOperation at{0.5, 0.02};
  const auto refusal = [&](DamperDescription drawn, bool insist) {
    const FamilyModel model(std::make_shared<Family>(family), example_member());
    return make_design_model(family_file(folder, model), "--model", insist)
        ->appraise(drawn, at)
        .refusal;
  };
  DamperDescription drawn = named_description("family_prototype");
  CHECK(refusal(drawn, false) == Refusal::None);
  drawn.turns = 10;
  CHECK(refusal(drawn, false) == Refusal::RangeLeap);
  CHECK(refusal(drawn, true) == Refusal::None);
  drawn.pole_length *= 1.2;
  CHECK(refusal(drawn, false) == Refusal::Leap);

  // No number, whoever insists.
  Mlp mlp = example_family_mlp();
  for (double& weight : mlp.parameters) weight = 1e200;
  mlp.output_scale = 1e200;
  family.force = std::make_shared<FamilyNetwork>(
      std::vector<std::string>{"gap", "yield_stress", "velocity"}, std::vector{mlp});
  CHECK(refusal(drawn, true) == Refusal::NoResistance);
}

TEST_CASE(
    "design by a family: whatever the goal, a force that the current takes away is no design's") {
  // None of these asks for a force: mass, a field, and one of another model.
  const TemporaryFolder folder;
  const std::string falling = family_file(folder, resisting_family(-0.5));
  const std::string request = std::string(kRequest).substr(0, std::string(kRequest).find("goals"));
  for (const char* goal : {"minimise: mass", "maximise: gap", "minimise: power", "maximise: force"})
    for (const bool insist : {false, true}) {
      CAPTURE(goal);
      const DesignReport report = designed_by_family(request + "goals: [{" + goal + "}]",
                                                     {.model = falling, .insist = insist});
      CHECK(report.designs.empty());
      REQUIRE(report.conflict);
      CHECK(report.conflict->refused);
      CHECK_FALSE(report.conflict->undrawable);
      CHECK(contains(design_verdict(report), "do not refuse"));
      CHECK(std::ranges::any_of(report.notes, [](const std::string& note) {
        return contains(note, "less with the current than without");
      }));
    }

  // Nor one that stands beside physics; nor where nothing is asked to move.
  CHECK(designed_by_family(request + "goals: [{minimise: mass}]",
                           {.model = "physics", .second = falling})
            .designs.empty());
  std::string still = request + "goals: [{minimise: mass}]";
  still.erase(still.find("at:"), still.find("vary") - still.find("at:"));
  CHECK(designed_by_family(still, {.model = falling}).designs.empty());
  CHECK(designed_by_family(still, {.model = family_file(folder, resisting_family())})
            .designs.size() == 1);
}

TEST_CASE("design by a family: one that feeds energy in at some other current is none") {
  // At 0.3 A it resists; at 1 A its force has turned with the motion.
  const TemporaryFolder folder;
  FamilyLine line;
  line.gap = 1e-3;
  line.pole_length = 6e-3;
  line.viscosity = 0.28;
  line.size = {2, 1, 0, 0, 0.1, -0.5};
  line.phase = {0.2, 0, 2.2, 0, 0, 0};
  const std::string file = family_file(
      folder,
      {std::make_shared<Family>(family_of(std::make_shared<LineFamily>(line))), example_member()});
  const std::string request = std::string(kRequest).substr(0, std::string(kRequest).find("goals")) +
                              "goals: [{minimise: mass, current: 0.3 A}]";
  const DesignReport report = designed_by_family(request, {.model = file});
  CHECK(report.designs.empty());
  CHECK(report.rejected == 1);
  CHECK(std::ranges::any_of(
      report.notes, [](const std::string& note) { return contains(note, "feeds energy in"); }));
  CHECK(contains(design_verdict(report), "No design is left"));
  CHECK(designed_by_family(request, {.model = file, .insist = true}).designs.size() == 1);
}

TEST_CASE(
    "design by a family: what is asked of a force is met at the pessimistic end of its band") {
  const TemporaryFolder folder;
  const FamilyModel family = resisting_family();
  const ForceBand band{.records = 9, .drives = {0, 1}, .half_width = {0.1, 0.5}, .spread = 2};
  const std::string file = family_file(folder, family, band);
  const std::string request = std::string(kRequest).substr(0, std::string(kRequest).find("goals")) +
                              R"(
constraints:
  - {quantity: force, min: 0.1 N, max: 100 N}
  - {quantity: off_force, min: 0.1 N, max: 100 N}
  - {quantity: dynamic_range, min: 0.1, max: 100}
  - {quantity: controllable_force, min: -100 N}
goals: [{maximise: dynamic_range}, {minimise: force}]
)";
  const DesignReport report =
      designed_by_family(request, {.points = 4, .generations = 2, .model = file});
  REQUIRE(!report.designs.empty());
  CHECK(contains(report.notes.front(), "pessimistic end of its band"));
  const Design& design = report.designs.front();

  // The middle, and half the widths with those of the family's builds.
  const DamperOperation at = report.request.goals.front().at;
  const DamperPhysics told = make_design_model(file, "--model")->evaluate(design.damper, at);
  const double spread = family.family().build_spread;
  const double on = std::hypot(0.3, 2 * spread * told.force),
               off = std::hypot(0.1, 2 * spread * told.off_force);
  const double low = (told.force - on) / (told.off_force + off),
               high = (told.force + on) / (told.off_force - off);
  const std::vector<double> expected{told.force - on,
                                     told.force + on,
                                     told.off_force - off,
                                     told.off_force + off,
                                     low,
                                     high,
                                     told.force - on - told.off_force - off};
  REQUIRE(design.assessment.constraints.size() == expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k)
    CHECK_CLOSE(design.assessment.constraints[k], expected[k], 1e-9, 1e-12);
  CHECK_CLOSE(design.assessment.goals[0], low, 1e-9, 0);
  CHECK_CLOSE(design.assessment.goals[1], told.force + on, 1e-9, 0);
}

TEST_CASE("design by a family: what cannot be reached is said without the robust search") {
  const TemporaryFolder folder;
  const std::string file = family_file(folder, resisting_family());
  DesignOptions options{.model = file, .second = "physics", .refuse_outside = true};
  const DesignReport report = design(named_request("family_prototype"), options);
  CHECK(report.designs.empty());
  REQUIRE(report.conflict);
  CHECK(contains(describe(*report.conflict, report.request), "force at least 50 N"));
  CHECK(report.wall_seconds < 30);
  CHECK(std::ranges::any_of(report.notes, [](const std::string& note) {
    return contains(note, "judged by the drawn damper alone");
  }));
}
