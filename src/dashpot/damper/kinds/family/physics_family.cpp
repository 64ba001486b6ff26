#include "dashpot/damper/kinds/family/physics_family.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dashpot/error.h"
#include "dashpot/physics/plate_flow.h"

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
    {"stiffness", "ln of the spring before the flow, over mean force by half stroke", 0, kFree, -3,
     kWide, false},
    {"field_exponent", "power of the yield stress", 1, 1e-2, 0.05, 3, false},
    {"field_gain", "ln of what a large current adds beyond its yield stress", 0, 1e-3, 0, 6, false},
    {"field_half", "ln of the current at half of that, over the median current", 0, 1e-4, -3, 3,
     false},
    {"asymmetry", "share by which the flow resists extension more", 0, 1e-3, -0.5, 0.5, false},
    {"memory", "share of the motion just past in the speed that sets the resistance", 0.5, kFree, 0,
     1, false},
    {"onset", "ln of the speed below which resistance is constant, over the mean speed", -2.3,
     kFree, -5, 1, false},
    {"geometry_share", "power of the plate flow's dependence on geometry: 1 is physics", 1, kFree,
     0, 1.5, false},
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
}};

/// A friction or a plate flow: the force it has at a speed, over that speed.
struct Resistance {
  double yielding, viscous;  // N, N s/m; a seal has no viscous part
  double passive = 0;        // N s/m, beside them in the same flow
  struct Value {
    double value, slope;  // N s/m, and its derivative by the speed
  };
  Value at(double speed) const noexcept {
    if (!(viscous > 0)) return {yielding / speed, -yielding / (speed * speed)};
    // The slope of the pressure p follows from its cubic, p^3 - (N + 3/2 Y) p^2 + Y^3 / 2 = 0.
    const double newtonian = viscous * speed, p = plate_bingham_pressure(newtonian, yielding);
    const double slope = p / (3 * p - 2 * (newtonian + 1.5 * yielding));
    return {p / speed + passive, (viscous * slope - p / speed) / speed};
  }
};

/// The force f = u R(s) of a resistance that takes the speed u, s^2 = rest + own u^2, where f +
/// spring u = pull, pull >= 0. The left side grows with u, so that a bracketed Newton step ends.
double balanced_force(const Resistance& resistance, double pull, double spring, double rest,
                      double own) noexcept {
  constexpr int kSteps = 50;
  constexpr double kTolerance = 1e-9;
  double low = 0, high = pull / spring;
  double u = pull / (spring + resistance.at(std::sqrt(rest)).value);
  if (!(own > 0)) return u * resistance.at(std::sqrt(rest)).value;

  // A resistance that has yielded leaves the rest of the pull to spring and viscous flow.
  u = std::max(u, (pull - resistance.yielding / std::sqrt(own)) /
                      (spring + resistance.viscous + resistance.passive));
  for (int k = 0; k < kSteps; ++k) {
    const double s = std::sqrt(rest + own * u * u);
    const Resistance::Value r = resistance.at(s);
    const double excess = u * r.value + spring * u - pull;
    (excess > 0 ? high : low) = u;
    double next = u - excess / (r.value + u * r.slope * own * u / s + spring);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double step = std::abs(next - u);
    u = next;
    if (step <= kTolerance * u) break;
  }
  return u * resistance.at(std::sqrt(rest + own * u * u)).value;
}

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

}  // namespace

std::span<const PhysicsNumber, kPhysicsNumbers> FamilyPhysics::table() { return kTable; }

FamilyPhysics::Numbers FamilyPhysics::priors() noexcept {
  Numbers numbers{};
  for (std::size_t k = 0; k < kPhysicsNumbers; ++k) numbers[k] = kTable[k].prior;
  return numbers;
}

FamilyPhysics::Element FamilyPhysics::element(const FamilyMember& m,
                                              double current) const noexcept {
  const Reference& r = reference;
  const Numbers& n = numbers;
  const auto log_ratio = [](double a, double b) { return std::log(a / b); };

  // Logarithms over the middle of the family.
  const double gap = log_ratio(m.gap, r.gap), length = log_ratio(m.pole_length, r.pole_length);
  const double area = log_ratio(m.piston_area, r.piston_area);
  const double width = log_ratio(m.gap_area / m.gap, r.gap_area / r.gap);
  const double fluid = 0.5 * log_ratio(m.viscosity, r.viscosity);

  // What multiplies the whole force, and the flow beside.
  const double all = std::exp(deviation[0] + n[kGapOfAll] * gap + n[kLengthOfAll] * length +
                              n[kFluidOfAll] * fluid);
  const double flow = deviation[1] + n[kGapOfYield] * gap + n[kLengthOfYield] * length +
                      n[kAreaOfYield] * area + n[kFluidOfYield] * fluid;

  // The field: by the yield stress, and by a share of the current that saturates.
  const double i = std::min(std::abs(current), 1e6 * r.current);
  const double field = std::pow(m.yield.at(current) / r.yield_stress, n[kFieldExponent]) *
                       std::exp(n[kFieldGain] * i / (i + r.current * std::exp(n[kFieldHalf])));

  // Plate flow at the middle of the family, and the power of geometry that the data ask for.
  const PlateGap middle{r.pole_length, r.gap_area / r.gap, r.gap};
  const double yielding = r.piston_area * plate_yield_pressure(&middle, r.yield_stress);
  const double viscous =
      r.piston_area * plate_newtonian_pressure(&middle, m.viscosity, r.piston_area);
  const double yield_geometry = length - gap + area;
  const double viscous_geometry = length + 2 * area - width - 3 * gap;

  Element e;
  e.seal = all * r.force * std::exp(n[kSealForce]);
  e.seal_stiffness = e.seal / r.stroke * std::exp(deviation[2] - n[kSealGive]);
  e.yielding =
      all * yielding * field * std::exp(n[kYieldShare] + flow + n[kGeometryShare] * yield_geometry);
  e.viscous =
      all * viscous * std::exp(n[kViscousShare] + flow + n[kGeometryShare] * viscous_geometry);
  e.stiffness = all * r.force / r.stroke * std::exp(deviation[2] + n[kStiffness]);
  e.asymmetry = n[kAsymmetry];
  e.memory = n[kMemory];
  e.slow = r.speed * std::exp(n[kOnset]);
  e.time = 2 * std::numbers::pi * r.stroke / r.speed;
  e.offset = r.force * deviation[3];
  return e;
}

void advance_element(const FamilyPhysics::Element& e, double from, double to, double dt,
                     double* state) noexcept {
  if (!(dt > 0)) return;
  const double kStage = 1 - std::sqrt(0.5);  // of the step: where the first stage stands

  // The remembered square of the speed, its drive taken at its mean over the step.
  const double keep = std::exp(-dt / e.time), before = state[2];
  state[2] = before * keep + (from * from + from * to + to * to) / 3 * (1 - keep);
  const double floor = e.slow * e.slow;
  const double first = e.memory * (before + kStage * (state[2] - before)) + floor;
  const double second = e.memory * state[2] + floor;

  // Each force with its spring: both stages are a balance of the same shape.
  const auto step = [&](double& force, double stiffness, double yielding, double viscous,
                        double asymmetry, double passive) {
    const double spring = kStage * dt * stiffness;
    const auto balance = [&](double pull, double rest) {
      const double side = pull < 0 ? -1 : 1, factor = 1 + side * asymmetry;
      const Resistance resistance{yielding * factor, viscous * factor, passive * factor};
      return side * balanced_force(resistance, std::abs(pull), spring, rest, 1 - e.memory);
    };
    const double middle = balance(force + spring * (from + kStage * (to - from)), first);
    const double rate = (middle - force) / (kStage * dt);
    force = balance(force + (1 - kStage) * dt * rate + spring * to, second);
  };
  step(state[0], e.seal_stiffness, e.seal, 0, 0, 0);
  step(state[1], e.stiffness, e.yielding, e.viscous, e.asymmetry, e.passive);
}

PhysicsFamily::PhysicsFamily(FamilyPhysics physics, const std::string& where)
    : physics_(std::move(physics)) {
  require_physics(physics_, where);
}

void PhysicsFamily::rest(const DamperInput&, std::span<double> state) const noexcept {
  std::ranges::fill(state, 0.);
}

void PhysicsFamily::advance(const FamilyMember& member, const DamperInput& from,
                            const DamperInput& to, double dt,
                            std::span<double> state) const noexcept {
  advance_element(physics_.element(member, to.current), from.velocity, to.velocity, dt,
                  state.data());
}

double PhysicsFamily::force(const FamilyMember&, const DamperInput&,
                            std::span<const double> state) const noexcept {
  return state[0] + state[1] + physics_.reference.force * physics_.deviation[3];
}

Value PhysicsFamily::to_json() const {
  Value reference = Value::object(), numbers = Value::object();
  for (const ReferenceField& field : kReferences)
    reference.add(std::string(field.name), physics_.reference.*field.field);
  for (std::size_t k = 0; k < kPhysicsNumbers; ++k)
    numbers.add(std::string(kTable[k].name), physics_.numbers[k]);
  return Value::object({{"kind", kPhysicsFamily},
                        {"reference", std::move(reference)},
                        {"numbers", std::move(numbers)},
                        {"deviation", array_of(physics_.deviation)},
                        {"covariance", array_of(physics_.covariance)},
                        {"record_error", physics_.record_error}});
}

std::unique_ptr<FamilyForce> read_physics_family(const Value& value, ObjectReader& reader) {
  FamilyPhysics physics;
  ObjectReader reference(reader.required("reference"), "the middle of a family");
  for (const ReferenceField& field : kReferences)
    physics.reference.*field.field = reference.number(field.name);
  reference.finish();
  ObjectReader numbers(reader.required("numbers"), "the numbers of a family");
  for (std::size_t k = 0; k < kPhysicsNumbers; ++k)
    physics.numbers[k] = numbers.number(kTable[k].name);
  numbers.finish();
  read_array(reader.required("deviation"), physics.deviation);
  read_array(reader.required("covariance"), physics.covariance);
  physics.record_error = reader.number("record_error");
  reader.finish();
  return std::make_unique<PhysicsFamily>(std::move(physics), value.where());
}

}  // namespace dashpot
