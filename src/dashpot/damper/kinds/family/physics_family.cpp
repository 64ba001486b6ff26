#include "dashpot/damper/kinds/family/physics_family.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr double kFree = 1e-5;  // a ridge that does no more than keep a number finite
constexpr double kWide = 9;     // e^9 either way is no limit

// Names stand in model files. A number that is a logarithm says so.
constexpr std::array<PhysicsNumber, kPhysicsNumbers> kTable{{
    {"yield_share", "ln of the share of the plate flow's yielding force", -2.3, kFree, -kWide,
     kWide, false},
    {"viscous_share", "ln of the share of the plate flow's viscous force", 0, 1e-3, -kWide, kWide,
     false},
    {"seal_force", "ln of the seal's friction over the mean force of the fit", -0.36, kFree, -kWide,
     kWide, false},
    {"seal_give", "ln of the way over which the seal gives before it slides, over the half stroke",
     -1.2, kFree, -6, 2, false},
    {"seal_gain", "ln of what a large current multiplies the seal's friction by", 0, 1e-3, 0, 6,
     false},
    {"seal_half", "ln of the current at half of that, over the median current", 0, 1e-4, -3, 3,
     false},
    {"stiffness", "ln of the spring before the flow, over mean force by half stroke", 0, kFree, -3,
     kWide, false},
    {"field_exponent", "power of the yield stress", 1, 1e-2, 0.05, 3, false},
    {"asymmetry", "share by which the flow resists extension more", 0, 1e-3, -0.5, 0.5, false},
    {"roundness", "share of a sine's mean speed in the speed that sets the resistance", 0.5, kFree,
     0, 1, false},
    {"onset", "ln of the speed below which resistance is constant, over the mean speed", -2.3,
     kFree, -5, 1, false},
    {"gap_of_all", "power of the gap in the whole force", 0, 0, -kWide, kWide, true},
    {"length_of_all", "power of the pole length in the whole force", 0, 0, -kWide, kWide, true},
    {"fluid_of_all", "power of the viscosity in the whole force", 0, 0, -kWide, kWide, true},
    {"gap_of_yield", "power of the gap in the flow, beyond physics", 0, 0, -kWide, kWide, true},
    {"length_of_yield", "power of the pole length in the flow, beyond physics", 0, 0, -kWide, kWide,
     true},
    {"area_of_yield", "power of the piston area in the flow, beyond physics", 0, 0, -kWide, kWide,
     true},
    {"fluid_of_yield", "power of the viscosity in the flow, beyond physics", 0, 0, -kWide, kWide,
     true},
    {"gap_of_spring", "power of the gap in the spring before the flow", 0, 0, -kWide, kWide, true},
    {"length_of_spring", "power of the pole length in the spring before the flow", 0, 0, -kWide,
     kWide, true},
    {"area_of_spring", "power of the piston area in the spring before the flow", 1, 0, -kWide,
     kWide, true},
    {"fluid_of_spring", "power of the viscosity in the spring before the flow", 0, 0, -kWide, kWide,
     true},
}};

void require_physics(const FamilyPhysics& physics, const std::string& where) {
  const FamilyPhysics::Reference& r = physics.reference;
  for (const double scale : {r.piston_area, r.gap_area, r.gap, r.pole_length, r.viscosity,
                             r.yield_stress, r.current, r.force, r.speed, r.stroke})
    if (!(scale > 0 && std::isfinite(scale)))
      throw Error(where, "a reference is not a positive number");
  for (std::size_t k = 0; k < kPhysicsNumbers; ++k)
    if (!(physics.numbers[k] >= kTable[k].low && physics.numbers[k] <= kTable[k].high))
      throw Error(where, std::string(kTable[k].name) + " is beyond its ends",
                  "a number of its range");
}

Value array_of(std::span<const double> numbers) {
  return Value::array(std::vector<double>(numbers.begin(), numbers.end()));
}

void read_array(const Value& value, std::span<double> numbers) {
  const std::vector<double> read = value.as_numbers();
  if (read.size() != numbers.size())
    throw Error(value.where(), "has " + std::to_string(read.size()) + " numbers",
                std::to_string(numbers.size()));
  std::ranges::copy(read, numbers.begin());
}

struct ReferenceField {
  std::string_view name;
  double FamilyPhysics::Reference::* field;
};
constexpr ReferenceField kReferences[] = {{"piston_area", &FamilyPhysics::Reference::piston_area},
                                          {"gap_area", &FamilyPhysics::Reference::gap_area},
                                          {"gap", &FamilyPhysics::Reference::gap},
                                          {"pole_length", &FamilyPhysics::Reference::pole_length},
                                          {"viscosity", &FamilyPhysics::Reference::viscosity},
                                          {"yield_stress", &FamilyPhysics::Reference::yield_stress},
                                          {"current", &FamilyPhysics::Reference::current},
                                          {"force", &FamilyPhysics::Reference::force},
                                          {"speed", &FamilyPhysics::Reference::speed},
                                          {"stroke", &FamilyPhysics::Reference::stroke}};

PhysicsMember drawing_of(const FamilyMember& m) {
  return {m.piston_area, m.gap_area, m.gap, m.pole_length, m.viscosity};
}

/// One damper, before its current is known.
class PhysicsSteps final : public MemberSteps {
 public:
  PhysicsSteps(const FamilyPhysics& physics, const FamilyMember& member)
      : field_(physics_field(&physics.reference, physics.numbers.data())), yield_(member.yield) {
    const PhysicsMember drawing = drawing_of(member);
    drawn_ = physics_drawn(&physics.reference, physics.numbers.data(), physics.deviation.data(),
                           &drawing);
  }
  void advance(const DamperInput& from, const DamperInput& to, double dt,
               std::span<double> state) const noexcept override {
    FamilyPhysics::Element element = drawn_;
    physics_apply_field(&field_, yield_.at(to.current), to.current, &element);
    physics_advance(&element, from.velocity, to.velocity, dt, state.data());
  }

 private:
  PhysicsField field_;
  YieldCurve yield_;
  FamilyPhysics::Element drawn_;
};

enum Spring : std::size_t { kSeal, kFlow, kSprings };

/// One spring of a damper at a constant current in a sine, as physics_advance() steps it. Neither
/// sees the other: each runs for as long as it takes itself, and a cycle of the seal costs a part
/// of the flow's.
class SpringInSine {
 public:
  SpringInSine(const FamilyPhysics::Element& element, const SteadySine& sine, Spring spring)
      : element_(element),
        stiffness_(spring == kSeal ? element.seal_stiffness : element.stiffness),
        sine_(sine),
        spring_(spring) {
    if (spring == kSeal)
      element_.yielding = element_.viscous = element_.passive = 0;
    else
      element_.seal = 0;
  }

  /// At rest at the turn before a phase, from where it runs to there. Whether it has forgotten it.
  bool begin(double phase) {
    constexpr double kForgotten = 1e-4;
    const double turn = kPi * (std::floor(phase / kPi - 0.5) + 0.5);
    state_ = {0, 0, sine_.follower(turn, element_.rate)};
    phase_ = phase;
    return through(turn, phase, state_) < kForgotten;
  }
  /// A cycle, and where those after it could move the force by more than `little`, N, the one that
  /// returns.
  void settle(double little) {
    const std::array<double, kPhysicsStates> before = state_;
    const double kept = cycle(state_);
    if (kept * std::abs(state_[spring_] - before[spring_]) / (1 - kept) <= little) return;
    find_cycle(state_, [&](std::span<double> cycled) { cycle(cycled); }, before);
  }
  double force() const { return state_[spring_]; }
  double follower() const { return state_[2]; }

 private:
  static constexpr double kPi = std::numbers::pi;

  double cycle(std::span<double> state) const { return through(phase_, phase_ + 2 * kPi, state); }

  /// At most so much is left, by the end, of a change of the force at the beginning.
  double through(double from, double to, std::span<double> state) const {
    constexpr double kOfCycle = 40, kRounding = 1e-9;
    const double count = std::ceil((to - from) / (2 * kPi) * kOfCycle - kRounding);
    const double phase = (to - from) / count, step = phase / sine_.rate;
    double travelled = 0, now = sine_.at(from).velocity;
    for (int k = 1; k <= count; ++k) {
      const double next = sine_.at(from + k * phase).velocity, before = state[spring_];
      physics_advance(&element_, now, next, step, state.data());
      travelled += travel(stiffness_ * 0.5 * (now + next) * step, before, state[spring_]);
      now = next;
    }
    return std::exp(-travelled);
  }

  /// What the resistance was moved by in a step, in ways over which the spring gives by its force.
  /// A spring's force f before a resistance that takes the speed u forgets by K df/du or more, and
  /// df/du is f / u at most, since a resistance falls with the speed. Nothing is counted where the
  /// force turns: there u and f are both small, and what the steps get wrong is not.
  static double travel(double pull, double before, double after) {
    const double largest = std::max(std::abs(before), std::abs(after));
    const double ways = std::copysign(1., before + after) * (pull - (after - before)) / largest;
    return before * after > 0 && ways > 0 ? ways : 0;
  }

  FamilyPhysics::Element element_;
  double stiffness_, phase_ = 0;
  const SteadySine& sine_;
  Spring spring_;
  std::array<double, kPhysicsStates> state_{};
};

}  // namespace

std::span<const PhysicsNumber, kPhysicsNumbers> FamilyPhysics::table() { return kTable; }

FamilyPhysics::Numbers FamilyPhysics::priors() noexcept {
  Numbers numbers{};
  for (std::size_t k = 0; k < kPhysicsNumbers; ++k) numbers[k] = kTable[k].prior;
  return numbers;
}

FamilyPhysics::Element FamilyPhysics::element(const FamilyMember& member,
                                              double current) const noexcept {
  return element(member, deviation, current);
}

FamilyPhysics::Element FamilyPhysics::element(const FamilyMember& m, const Deviation& build,
                                              double current) const noexcept {
  const PhysicsMember member = drawing_of(m);
  return physics_element(&reference, numbers.data(), build.data(), &member, m.yield.at(current),
                         current);
}

PhysicsFamily::PhysicsFamily(FamilyPhysics physics, const std::string& where)
    : physics_(std::move(physics)) {
  require_physics(physics_, where);
}

void PhysicsFamily::rest(const DamperInput&, std::span<double> state) const noexcept {
  std::ranges::fill(state, 0.);
}

std::shared_ptr<const MemberSteps> PhysicsFamily::steps_of(const FamilyMember& member) const {
  return std::make_shared<PhysicsSteps>(physics_, member);
}

void PhysicsFamily::settle(const FamilyMember& member, const SteadySine& sine, double phase,
                           std::span<double> state) const {
  constexpr double kSettled = 5e-4;  // of the whole force, by each
  const FamilyPhysics::Element element = physics_.element(member, sine.current);
  std::array<SpringInSine, kSprings> springs{SpringInSine(element, sine, kSeal),
                                             SpringInSine(element, sine, kFlow)};
  std::array<bool, kSprings> forgotten{};
  for (std::size_t k = 0; k < kSprings; ++k) forgotten[k] = springs[k].begin(phase);

  for (std::size_t k = 0; k < kSprings; ++k) {
    const double whole = std::abs(springs[kSeal].force() + springs[kFlow].force());
    if (!forgotten[k]) springs[k].settle(kSettled * whole);
    state[k] = springs[k].force();
  }
  state[2] = springs[kFlow].follower();
}

double PhysicsFamily::force(const FamilyMember&, const DamperInput&,
                            std::span<const double> state) const noexcept {
  return state[0] + state[1] + physics_.reference.force * physics_.deviation[3];
}

std::vector<double> run_family_physics(const FamilyPhysics& physics, const FamilyMember& member,
                                       std::span<const DamperInput> inputs,
                                       std::span<const double> time) {
  std::vector<double> force(inputs.size());
  double state[kPhysicsStates] = {};
  FamilyPhysics::Element element;
  double current = NAN;
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    // A damper at a constant current is one element for all samples.
    if (inputs[k].current != current) {
      current = inputs[k].current;
      element = physics.element(member, current);
    }
    if (k > 0)
      physics_advance(&element, inputs[k - 1].velocity, inputs[k].velocity, time[k] - time[k - 1],
                      state);
    force[k] = state[0] + state[1] + element.offset;
  }
  return force;
}

std::vector<double> FamilyPhysics::deviation_covariance() const {
  constexpr double kLeast = 1e-6;
  std::vector<double> all(covariance.begin(), covariance.end());
  for (std::size_t k = 0; k < kDeviations; ++k) all[k * kDeviations + k] += kLeast;
  return all;
}

Value PhysicsFamily::to_json() const {
  Value reference = Value::object(), numbers = Value::object();
  for (const ReferenceField& field : kReferences)
    reference.add(std::string(field.name), physics_.reference.*field.field);
  for (std::size_t k = 0; k < kPhysicsNumbers; ++k)
    numbers.add(std::string(kTable[k].name), physics_.numbers[k]);
  Value value = Value::object({{"kind", kPhysicsFamily},
                               {"reference", std::move(reference)},
                               {"numbers", std::move(numbers)},
                               {"deviation", array_of(physics_.deviation)},
                               {"covariance", array_of(physics_.covariance)},
                               {"record_error", physics_.record_error}});
  if (!physics_.information.empty()) value.add("information", array_of(physics_.information));
  return value;
}

std::unique_ptr<FamilyForce> read_physics_family(const Value& value, ObjectReader& reader) {
  FamilyPhysics physics;

  // The drawing in the middle of the data, and the numbers there.
  ObjectReader reference(reader.required("reference"), "the middle of a family");
  for (const ReferenceField& field : kReferences)
    physics.reference.*field.field = reference.number(field.name);
  reference.finish();
  ObjectReader numbers(reader.required("numbers"), "the numbers of a family");
  for (std::size_t k = 0; k < kPhysicsNumbers; ++k)
    physics.numbers[k] = numbers.number(kTable[k].name);
  numbers.finish();

  // How builds differ, and what the fit knows of all.
  read_array(reader.required("deviation"), physics.deviation);
  read_array(reader.required("covariance"), physics.covariance);
  physics.record_error = reader.number("record_error");
  if (const Value* information = reader.optional("information")) {
    physics.information.resize((kPhysicsNumbers + 1) * (kPhysicsNumbers + 1));
    read_array(*information, physics.information);
  }
  reader.finish();
  return std::make_unique<PhysicsFamily>(std::move(physics), value.where());
}

}  // namespace dashpot
