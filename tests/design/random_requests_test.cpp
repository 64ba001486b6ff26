#include <algorithm>
#include <array>
#include <ctime>
#include <map>
#include <numbers>

#include "asked_cases.h"
#include "damper/kinds/family/example_family.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/family/line_family.h"
#include "dashpot/design/design.h"
#include "dashpot/error.h"
#include "dashpot/report/design_report.h"
#include "drawn_family.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A family, and the drawing that its requests vary.
struct RandomFamily {
  FamilyModel model;
  std::string damper;
  Domain domain;
  std::optional<ForceBand> band = {};
};

// What those about the prototype of the family paper were driven with.
constexpr Domain kDriven{-0.02, 0.02, -0.05, 0.05, 0, 1};

/// N and how far builds differ, where a sine of the half stroke passes a place at a velocity, after
/// as many cycles from rest, in steps of the test's own, as it takes until the force is the same
/// again; a weak spring before a strong resistance takes hundreds. Or, to look only, a few cycles.
struct SineForce {
  double force = 0, spread = 0;
};
struct SineSteps {
  int of_cycle = 400, most_cycles = 1000;
};
SineForce force_of_sine(const DamperModel& model, const DamperOperation& at, double half_stroke,
                        const SineSteps& steps = {}) {
  constexpr int kLeastCycles = 3;
  constexpr double kSame = 1e-6;
  const int of_cycle = steps.of_cycle;
  const double rate = std::abs(at.velocity) / half_stroke,
               amplitude = std::hypot(half_stroke, at.displacement),
               end = std::atan2(at.displacement, std::copysign(half_stroke, at.velocity));
  std::vector<double> state(model.state_size());
  const auto input = [&](int k) {
    const double phase = end + 2 * std::numbers::pi * k / of_cycle;
    return DamperInput{amplitude * std::sin(phase), amplitude * rate * std::cos(phase), at.current};
  };
  model.rest(input(0), state);
  double before = 0, now = model.force(input(0), state);
  for (int cycle = 0; cycle < steps.most_cycles && !state.empty(); ++cycle) {
    for (int k = 1; k <= of_cycle; ++k)
      model.advance(input(k - 1), input(k), 2 * std::numbers::pi / (rate * of_cycle), state);
    before = std::exchange(now, model.force(input(0), state));
    if (cycle >= kLeastCycles && std::abs(now - before) <= kSame * std::abs(now)) break;
  }
  return {now, model.spread(input(0), state)};
}

/// A line of random slopes: forces that fall to nothing, rise without end or help the motion are
/// among them.
std::shared_ptr<const FamilyForce> random_line(Random& random) {
  FamilyLine line;
  line.gap = 1e-3;
  line.pole_length = 6e-3;
  line.viscosity = 0.28;
  line.slow = 1e-3;
  line.size = {2 + random.normal(), 0.7 + random.normal(), 0.3 * random.normal()};
  line.phase = {0.4 * random.normal(), 0.4 * random.normal(), 0.2 * random.normal()};
  for (const double steepness : {0.5, 2., 3.}) {  // in the fluid, the length and the gap
    line.size.push_back(steepness * random.normal());
    line.phase.push_back(0.2 * random.normal());
  }
  return std::make_shared<LineFamily>(line);
}

/// Corrections of physics that are anywhere within their ends.
std::shared_ptr<const FamilyForce> random_physics(Random& random) {
  FamilyPhysics physics;
  physics.reference = {2e-4, 3e-5, 1.2e-3, 8e-3, 0.2, 2e4, 0.5, 15, 0.05, 0.02};
  physics.numbers = FamilyPhysics::priors();
  for (std::size_t k = 0; k < kPhysicsNumbers; ++k) {
    const PhysicsNumber& row = FamilyPhysics::table()[k];
    physics.numbers[k] = std::clamp(row.prior + 1.5 * random.normal(), row.low, row.high);
  }
  return std::make_shared<PhysicsFamily>(physics);
}

/// A network of random weights, whose force of the current may have any sign.
std::shared_ptr<const FamilyForce> random_network(Random& random) {
  Mlp mlp = example_family_mlp();
  initialise(mlp, random.next());
  return std::make_shared<FamilyNetwork>(
      std::vector<std::string>{"gap", "yield_stress", "velocity"}, std::vector{mlp});
}

/// States of random gates, about a dashpot that stands for what a fit would find.
std::shared_ptr<const FamilyForce> random_gates(Random& random) {
  FamilyGates gates = example_gates();
  for (double& weight : gates.weights) weight = 0.3 * random.normal();
  gates.weights[FamilyGates::kGates] += 2;
  return std::make_shared<GatedFamily>(gates);
}

/// What is fitted on recordings of dampers that are of no model's structure: Bingham or
/// Herschel-Bulkley flow, valves that lean, builds that scatter. Each truth is fitted once.
const FamilyModel& fitted_family(std::size_t truth) {
  static std::map<std::size_t, std::shared_ptr<const FamilyModel>> kept;
  std::shared_ptr<const FamilyModel>& model = kept[truth];
  if (model) return *model;

  Random random(truth + 1);
  const DrawnFamily family{.leans = truth % 2 == 1,
                           .scatter = 0.1 * random.uniform(),
                           .noise = 0.03 * random.uniform(),
                           .tests = {{{8e-3, 2}, 0}, {{8e-3, 2}, 1.5}}};
  std::vector<Record> records;
  for (const DamperDescription& drawing : random_drawings(drawn_family_request(), 4, truth))
    for (Record& record : recorded_drawing(family, drawing, random))
      records.push_back(std::move(record));
  model = fitted_drawings(records);
  REQUIRE(model);
  return *model;
}

/// Half widths of any size, over the speed and the current.
ForceBand random_band(Random& random, double force) {
  ForceBand band{.records = 9, .speeds = {0.02}, .drives = {0, 1}};
  for (int k = 0; k < 4; ++k) band.half_width.push_back(force * std::exp(-2.5 + random.normal()));
  if (random.uniform() < 0.5) band.spread = 1.645;
  return band;
}

std::optional<RandomFamily> random_family_at_all(Random& random) {
  constexpr std::array kForces{random_line, random_physics, random_network, random_gates};
  constexpr std::size_t kTruths = 8;
  const std::size_t kind = random.next() % (kForces.size() + 1);
  if (kind == kForces.size())
    return RandomFamily{fitted_family(random.next() % kTruths), "passenger_car",
                        Domain{-8e-3, 8e-3, -0.1, 0.1, 0, 1.5}};
  Family family = family_of(kForces[kind](random));
  if (kForces[kind] == random_network) family.baseline.target = FamilyTarget::YieldForce;
  if (kForces[kind] == random_physics) family.name = "family_physics";
  return RandomFamily{
      {std::make_shared<Family>(family), example_member()}, "family_prototype", kDriven};
}

/// Whether its own damper is one: most that a fit would leave are.
bool is_damper(const RandomFamily& family) {
  constexpr SineSteps kLook{60, 2};
  const double half = family.domain.displacement_max;
  for (const double share : {0.1, 0.5, 1.})
    for (const double side : {-1., 1.}) {
      const double velocity = side * share * family.domain.velocity_max,
                   current = share * family.domain.current_max;
      const double off = side * force_of_sine(family.model, {0, velocity}, half, kLook).force;
      if (!(off > 0)) return false;
      const double on = side * force_of_sine(family.model, {current, velocity}, half, kLook).force;
      if (!(on > off)) return false;
    }
  return true;
}

RandomFamily random_family(Random& random) {
  constexpr int kTries = 30;
  const bool any = random.uniform() < 0.15;
  std::optional<RandomFamily> made = random_family_at_all(random);
  for (int k = 0; k < kTries && !any && !is_damper(*made); ++k)
    made.emplace(*random_family_at_all(random));
  if (random.uniform() < 0.6)
    made->band = random_band(random, made->damper == "passenger_car" ? 300 : 10);
  return *made;
}

/// What varies in a request, and from where to where at most.
struct VariedField {
  std::string name;
  double from, to;
};
const std::vector<VariedField> kPrototypeFields{
    {"gap", 4e-4, 4e-3},         {"pole_length", 2e-3, 3e-2},   {"turns", 500, 6000},
    {"piston_area", 5e-5, 8e-4}, {"wire_diameter", 1e-4, 4e-4}, {"core_area", 5e-6, 2e-4},
    {"friction", 0, 20},         {"passive_length", 0, 1e-2}};
const std::vector<VariedField> kCarFields{{"gap", 5e-4, 3e-3},
                                          {"pole_length", 3e-3, 3e-2},
                                          {"turns", 40, 400},
                                          {"bore_diameter", 2.2e-2, 5e-2},
                                          {"wire_diameter", 2e-4, 8e-4},
                                          {"core_area", 5e-5, 8e-4},
                                          {"friction", 0, 60},
                                          {"passive_length", 0, 2e-2}};

/// The YAML of a request: what varies, and bounds near the figures of the damper as it is drawn.
class RandomRequest {
 public:
  RandomRequest(Random& random, const RandomFamily& family, bool two_models)
      : random_(random), family_(family), two_models_(two_models) {
    const std::string at = place();
    add("damper: " + family.damper + "\nat: {" + at + "}\nvary:\n");
    vary();
    if (is_prototype() && random_.uniform() < 0.5)
      add("follow: {gap_area: {gap: 0.02487}, magnetic_gap: {gap: 2}}\n");
    if (random_.uniform() < 0.3)
      add("tolerances: {gap: 0.05 mm}\nrobust: {share: 0.9, samples: 6}\n");
    constrain();
    const std::string first = goal();
    add("goals: [{" + first + "}");
    if (random_.uniform() < 0.2) add(", {" + goal_beside(first) + "}");
    add("]\n");
  }

  const std::string& text() const { return text_; }

 private:
  void add(const std::string& text) { text_ += text; }
  bool is_prototype() const { return family_.damper == "family_prototype"; }
  double uniform(double from, double to) { return from + random_.uniform() * (to - from); }
  double logarithmic(double from, double to) {
    return from * std::pow(to / from, random_.uniform());
  }
  static std::string number(double value) { return format_number(value, 6); }

  /// Up to half as much again as the family was driven with; at times compressed, or off the
  /// middle. A bound of a force has the side of the request.
  std::string place(bool of_a_bound = false) {
    const bool is_compressed = random_.uniform() < 0.2;
    if (text_.empty()) is_compressed_ = is_compressed;
    const double side = (of_a_bound ? is_compressed_ : is_compressed) ? -1 : 1,
                 most = family_.domain.velocity_max;
    std::string text = "current: " + number(uniform(0.05, 1.5) * family_.domain.current_max) +
                       ", velocity: " + number(side * logarithmic(0.02, 1.5) * most);
    if (random_.uniform() < 0.1)
      text += ", displacement: " + number(uniform(-0.5, 0.5) * family_.domain.displacement_max);
    return text;
  }

  void vary() {
    bool any = false;
    for (const VariedField& field : is_prototype() ? kPrototypeFields : kCarFields) {
      if (random_.uniform() < 0.6) continue;
      any = true;
      const double a = uniform(field.from, field.to), b = uniform(field.from, field.to);
      const double from = std::min(a, b), to = std::max(a, b);
      std::string range = "{from: " + number(from) + ", to: " + number(to) + "}";
      if (random_.uniform() < 0.1) range = "[" + number(from) + ", " + number(to) + "]";
      add("  " + field.name + ": " + range + "\n");
    }
    if (!any || random_.uniform() < 0.3) add("  fluid: [122EG, 140CG]\n");
  }

  void constrain() {
    // Forces near those of the family's own damper in the middle of what it knows.
    const DamperOperation middle{0.7 * family_.domain.current_max,
                                 0.5 * family_.domain.velocity_max};
    const double half = family_.domain.displacement_max;
    const double force = std::abs(force_of_sine(family_.model, middle, half).force),
                 off = std::abs(force_of_sine(family_.model, {0, middle.velocity}, half).force);
    const DamperPhysics usual = evaluate_physics(named_description(family_.damper), middle);
    const auto near = [&](double value) {
      return number(value * std::exp(0.7 * random_.normal()));
    };
    std::vector<std::string> all;
    const auto maybe = [&](const std::string& text) {
      if (random_.uniform() > 0.2) return;
      std::string own = text;
      if (random_.uniform() < 0.2) own += ", " + place(true);
      if (two_models_ && random_.uniform() < 0.3)
        own += random_.uniform() < 0.5 ? ", by: second" : ", by: both";
      all.push_back("{quantity: " + own + "}");
    };
    maybe("force, min: " + near((is_compressed_ ? -3 : 0.3) * force));
    maybe("force, max: " + near((is_compressed_ ? -0.3 : 3) * force));
    maybe("off_force, max: " + near((is_compressed_ ? -0.3 : 2) * off));
    maybe("dynamic_range, min: " + near(0.6 * force / off));
    maybe("dynamic_range, max: " + near(5 * force / off));
    maybe("outside_family, max: " + number(uniform(0, 1)));
    maybe("coil_fill, max: 2");
    maybe("time_constant, max: " + near(4 * usual.time_constant));
    if (random_.uniform() < 0.3) maybe("response_time, max: " + near(4 * usual.time_constant));
    if (!all.empty()) add("constraints: [" + join(all, ", ") + "]\n");
  }

  std::string goal() {
    constexpr std::array kGoals{"maximise: dynamic_range", "maximise: force",
                                "minimise: off_force",     "minimise: mass",
                                "maximise: gap",           "minimise: power",
                                "minimise: response_time", "minimise: body_length",
                                "maximise: control_ratio", "maximise: controllable_force",
                                "minimise: time_constant", "minimise: outside_family"};
    std::string text = kGoals[random_.next() % kGoals.size()];
    if (random_.uniform() < 0.1) text += ", " + place();
    if (two_models_ && random_.uniform() < 0.2) text += ", by: second";
    return text;
  }

  /// Of another quantity than this one.
  std::string goal_beside(const std::string& first) {
    const auto asked = [](const std::string& text) { return text.substr(0, text.find(',')); };
    for (;;) {
      std::string text = goal();
      if (asked(text) != asked(first)) return text;
    }
  }

  Random& random_;
  const RandomFamily& family_;
  bool two_models_, is_compressed_ = false;
  std::string text_;
};

/// The force of a slot of plate flow and a seal.
double plate_force(const FamilyMember& m, double velocity, double current, double seal) {
  const PlateGap gap{m.pole_length, m.gap_area / m.gap, m.gap};
  const double viscous =
                   plate_newtonian_pressure(&gap, m.viscosity, m.piston_area * std::abs(velocity)),
               yield = plate_yield_pressure(&gap, m.yield.at(current));
  return seal + plate_bingham_pressure(m.piston_area * viscous, m.piston_area * yield);
}

/// Judges one design by its drawing alone, with nothing of how it was found.
class Judge {
 public:
  Judge(const DesignReport& report, const RandomFamily& family, const std::string& file)
      : report_(report), family_(family), file_(file) {}

  void judge(const Design& design) const {
    CAPTURE(design.name);
    within_ranges(design);
    for (const double goal : design.assessment.goals) CHECK(std::isfinite(goal));
    for (const double slack : design.assessment.slack) CHECK(slack >= 0);

    // Every operating point of whatever was asked, by physics and by the family, asked or not.
    const DesignRequest& request = report_.request;
    for (const DesignGoal& goal : request.goals) at_place(design, goal.at);
    for (const DesignConstraint& constraint : request.constraints) at_place(design, constraint.at);
    if (request.share == 0)
      for (const DesignConstraint& constraint : request.constraints) holds(design, constraint);

    // Dissipation: the model of the design, as every command judges it.
    if (uses_family()) CHECK(dissipation(*member(design), family_.domain, 1).dissipates());
  }

 private:
  bool uses_family() const {
    return report_.options.model == file_ || report_.options.second == file_;
  }
  /// The damper that the design's file describes, whose coil follows at once and whose spring is
  /// left out, as the figures have it; with the yield stress at this current as its drawing has it,
  /// or as the file has it over all currents.
  std::unique_ptr<FamilyModel> member(const Design& design,
                                      std::optional<double> current = {}) const {
    FamilyMember own = current
                           ? member_of(design.damper, std::vector<double>{0, std::abs(*current)})
                           : member_of(design.damper, family_.domain.current_max);
    own.spring_stiffness = own.lag_rate = 0;
    return std::make_unique<FamilyModel>(*family_.model.with_member(own));
  }

  void within_ranges(const Design& design) const {
    constexpr double kRounding = 1e-9;
    for (const DesignVariable& v : report_.request.variables) {
      if (!v.field) {
        CHECK(std::ranges::any_of(
            v.fluids, [&](const auto& fluid) { return fluid->name == design.damper.fluid->name; }));
        continue;
      }
      const double value = design.damper.*v.field->field;
      if (v.values.empty()) {
        CHECK(value >= v.from * (1 - kRounding));
        CHECK(value <= v.to * (1 + kRounding));
      } else {
        CHECK(std::ranges::any_of(
            v.values, [&](double one) { return std::abs(value - one) <= kRounding * one; }));
      }
    }
    for (const FollowingField& f : report_.request.following) {
      double value = f.constant;
      for (const auto& [field, factor] : f.terms) value += factor * design.damper.*field->field;
      CHECK_CLOSE(design.damper.*f.field->field, value, kRounding, 0);
    }
  }

  void at_place(const Design& design, const DamperOperation& at) const {
    if (at.velocity == 0) return;
    CAPTURE(at.current);
    CAPTURE(at.velocity);
    const double side = std::copysign(1., at.velocity);

    // By physics, all are what physics allows.
    const DamperPhysics physics = evaluate_physics(design.damper, at);
    const double off = side * (physics.off_force - physics.spring_force),
                 on = side * (physics.force - physics.spring_force);
    CHECK(off > 0);
    CHECK(on >= off);
    if (!uses_family()) return;

    // By the family: it resists, the current takes nothing away, and it is no further from plate
    // flow than is allowed. What another integrator makes of it may differ by a little.
    constexpr double kOtherSteps = 0.02;
    const auto damper = member(design, at.current);
    const double half = family_.domain.displacement_max;
    const double told = side * force_of_sine(*damper, at, half).force,
                 without =
                     side * force_of_sine(*damper, {0, at.velocity, at.displacement}, half).force;
    CHECK(told > 0);
    CHECK(without > 0);
    CHECK(told >= without * (1 - kOtherSteps));
    if (report_.options.insist) return;
    const double times = further(damper->member(), at, told, half),
                 times_without =
                     further(damper->member(), {0, at.velocity, at.displacement}, without, half);
    constexpr double kMost = kMostLeap * (1 + kOtherSteps);
    for (const double leap : {times, times_without, times / times_without}) {
      CHECK(leap < kMost);
      CHECK(leap * kMost > 1);
    }
  }

  /// N, of the damper of the file; every design of a request is held against the same few.
  double usual_force(const DamperOperation& at, double half) const {
    const auto [kept, is_new] = usual_.try_emplace({at.current, at.velocity, at.displacement});
    if (is_new) kept->second = std::abs(force_of_sine(family_.model, at, half).force);
    return kept->second;
  }

  /// How many times further from plate flow than the damper of the file.
  double further(const FamilyMember& member, const DamperOperation& at, double force,
                 double half) const {
    DamperOperation known = at;
    known.velocity =
        std::clamp(at.velocity, family_.domain.velocity_min, family_.domain.velocity_max);
    const double usual = usual_force(known, half), seal = 0.1 * usual;
    return force / plate_force(member, at.velocity, at.current, seal) /
           (usual / plate_force(family_.model.member(), known.velocity, at.current, seal));
  }

  /// A bound on a force holds at the pessimistic end of the band, as far as another integrator can
  /// tell; one on a figure of the drawing is looked up.
  void holds(const Design& design, const DesignConstraint& asked) const {
    const bool by_family =
        (asked.by == ToldBy::First ? report_.options.model : report_.options.second) == file_;
    const std::string name(asked.quantity->name);
    const bool is_range = name == "dynamic_range";
    CAPTURE(describe(asked));
    if (!by_family || !(is_range || name == "force" || name == "off_force")) return;
    const DamperOperation off_at{0, asked.at.velocity, asked.at.displacement};
    const auto damper = member(design, asked.at.current);
    const auto end = [&](const DamperOperation& at, bool upper) {
      const SineForce told = force_of_sine(*damper, at, family_.domain.displacement_max);
      const double half =
          family_.band
              ? family_.band->half_width_at({at.displacement, at.velocity, at.current}, told.spread)
              : 0;
      const double spring =
          is_range || family_.model.family().baseline.target == FamilyTarget::Total
              ? 0
              : evaluate_physics(design.damper, at).spring_force;
      const double side = std::copysign(1., at.velocity);
      return told.force + (is_range ? side : 1) * (upper ? half : -half) + spring;
    };
    if (is_range && !asked.at_least)
      CHECK(std::copysign(1., asked.at.velocity) * end(off_at, false) > 0);

    // Much is wanted: the force low. A range is low where the force without current is high.
    const bool upper = !asked.at_least;
    const double figure = is_range          ? end(asked.at, upper) / end(off_at, !upper)
                          : name == "force" ? end(asked.at, upper)
                                            : end(off_at, upper);
    const double room = 0.02 * (std::abs(asked.bound) + std::abs(figure));
    CHECK((asked.at_least ? figure - asked.bound : asked.bound - figure) >= -room);
  }

  const DesignReport& report_;
  const RandomFamily& family_;
  const std::string& file_;
  mutable std::map<std::array<double, 3>, double> usual_;
};

/// Requests that were answered, and how long each took this process.
struct RandomDesigns {
  int found = 0, without = 0, unknown = 0, designs = 0, by_family = 0;
  double slowest = 0, all = 0;

  std::string text() const {
    return std::to_string(found) + " requests with designs (" + std::to_string(by_family) +
           " by a family), " + std::to_string(without) + " without, " + std::to_string(unknown) +
           " beyond what the family knows, " + std::to_string(designs) + " designs; " +
           format_number(all, 3) + " CPU s, at most " + format_number(slowest, 3);
  }

  void add(std::uint64_t seed) {
    constexpr double kMostSeconds = 30;
    Random random(seed + 1);
    const RandomFamily family = random_family(random);
    const TemporaryFolder folder;
    const std::string file = (folder.path() / "family.json").string();
    save_model(
        {.model = family.model.with_offset(0), .domain = family.domain, .interval = family.band},
        file);

    // By the family, mostly beside physics, or physics beside the family; or by physics alone.
    DesignOptions options{.seed = seed, .threads = 1, .points = 8, .generations = 4};
    const double by = random.uniform();
    if (by < 0.8) options.model = file;
    if (by < 0.4) options.second = "physics";
    if (by > 0.9) options.second = file;
    options.refuse_outside = random.uniform() < 0.3;
    options.insist = random.uniform() < 0.1;
    const RandomRequest request(random, family, !options.second.empty());
    CAPTURE(request.text());
    CAPTURE(options.model == file);
    CAPTURE(options.second);

    const std::clock_t start = std::clock();
    const std::optional<DesignReport> report = answer(request.text(), options);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    all += seconds;
    slowest = std::max(slowest, seconds);
    CHECK(seconds < kMostSeconds);
    if (report) judge(*report, family, file);
  }

 private:
  void judge(const DesignReport& report, const RandomFamily& family, const std::string& file) {
    (report.designs.empty() ? without : found) += 1;
    by_family += !report.designs.empty() && report.options.model == file;
    designs += static_cast<int>(report.designs.size());
    CHECK((report.conflict || !report.designs.empty() || report.rejected > 0));
    CHECK(!design_verdict(report).empty());
    const Judge judge(report, family, file);
    for (const Design& design : report.designs) judge.judge(design);
  }

  /// Nothing where a current or a speed is asked that the family does not know, and is refused.
  std::optional<DesignReport> answer(const std::string& text, const DesignOptions& options) {
    try {
      return design(parse_request(text, "request.yaml"), options);
    } catch (const Error& error) {
      CAPTURE(std::string(error.what()));
      CHECK(contains(error.what(), "knows a "));
      CHECK(options.refuse_outside);
      ++unknown;
      return std::nullopt;
    }
  }
};

}  // namespace

TEST_CASE("no random request finds a design that physics forbids" * doctest::test_suite("long")) {
  // DASHPOT_DESIGN_REQUESTS=10000 for more of them, or 2000-4000 for a part.
  const auto [first, last] = asked_cases("DASHPOT_DESIGN_REQUESTS", 12);
  RandomDesigns all;
  for (int k = first; k < last; ++k) {
    CAPTURE(k);
    all.add(static_cast<std::uint64_t>(k));
    if ((k + 1 - first) % 100 == 0) MESSAGE(std::to_string(k + 1) << ": " << all.text());
  }
  CHECK(all.found > 0);
  MESSAGE(all.text());
}
