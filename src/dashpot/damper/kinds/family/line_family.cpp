#include "dashpot/damper/kinds/family/line_family.h"

#include <algorithm>
#include <cmath>

#include "dashpot/error.h"

namespace dashpot {
namespace {

void require_line(const FamilyLine& line, const std::string& where) {
  for (const double scale : {line.current, line.yield_stress, line.pole_length, line.gap,
                             line.viscosity, line.frequency, line.slow})
    if (!(scale > 0)) throw Error(where, "a scale of the line is not a positive number");
  if (line.size.size() != line.feature_count() || line.phase.size() != line.feature_count())
    throw Error(where,
                "a line has " + std::to_string(line.size.size()) + " and " +
                    std::to_string(line.phase.size()) + " numbers",
                std::to_string(line.feature_count()) + " for the size and as many for the phase");
}

}  // namespace

FamilyLine::Features FamilyLine::features(const FamilyMember& member,
                                          double input_current) const noexcept {
  const double along = std::log(member.pole_length / pole_length),
               across = std::log(member.gap / gap);
  if (!by_current) return {1, member.yield.at(input_current) / yield_stress, along, across};
  const double i = std::abs(input_current) / current;
  return {1, i, i * i, std::log(member.viscosity / viscosity), along, across};
}

LineFamily::LineFamily(FamilyLine line, const std::string& where) : line_(std::move(line)) {
  require_line(line_, where);
}

double FamilyLine::amplitude(const DamperInput& input, double follower) const noexcept {
  const double v = input.velocity, u = frequency * (input.displacement - centre);
  const double ahead = v - follower;
  return std::sqrt(std::max(2 * (follower * follower + ahead * ahead), 0.5 * (v * v + u * u)) +
                   slow * slow);
}

double FamilyLine::follow(double before, double from, double to, double dt) const noexcept {
  const double keep = std::exp(-frequency * dt);
  return before * keep + 0.5 * (from + to) * (1 - keep);
}

void LineFamily::advance(const FamilyMember&, const DamperInput& from, const DamperInput& to,
                         double dt, std::span<double> state) const noexcept {
  state[0] = line_.follow(state[0], from.velocity, to.velocity, dt);
}

void LineFamily::settle(const FamilyMember&, const SteadySine& sine, double phase,
                        std::span<double> state) const {
  state[0] = sine.follower(phase, line_.frequency);
}

void LineFamily::flow(const DamperInput& input, std::span<const double> state,
                      std::span<double> rates) const noexcept {
  rates[0] = line_.frequency * (input.velocity - state[0]);
}

double LineFamily::force(const FamilyMember& member, const DamperInput& input,
                         std::span<const double> state) const noexcept {
  constexpr double kMostLog = 100;  // e^100 N is past any use, and still a number
  const FamilyLine::Features f = line_.features(member, input.current);
  double log_size = 0, phase = 0;
  for (std::size_t k = 0; k < line_.feature_count(); ++k) {
    log_size += line_.size[k] * f[k];
    phase += line_.phase[k] * f[k];
  }

  const double turned = std::cos(phase) * input.velocity +
                        std::sin(phase) * line_.frequency * (input.displacement - line_.centre);
  return std::exp(std::min(log_size, kMostLog)) * turned / line_.amplitude(input, state[0]) +
         line_.offset;
}

Value LineFamily::to_json() const {
  return Value::object({{"kind", kLineFamily},
                        {"by_current", line_.by_current},
                        {"current", line_.current},
                        {"yield_stress", line_.yield_stress},
                        {"pole_length", line_.pole_length},
                        {"gap", line_.gap},
                        {"viscosity", line_.viscosity},
                        {"frequency", line_.frequency},
                        {"centre", line_.centre},
                        {"slow", line_.slow},
                        {"offset", line_.offset},
                        {"size", Value::array(line_.size)},
                        {"phase", Value::array(line_.phase)}});
}

std::unique_ptr<FamilyForce> read_line_family(const Value& value, ObjectReader& reader) {
  FamilyLine line;
  line.by_current = reader.required("by_current").as_bool();
  line.current = reader.number("current");
  line.yield_stress = reader.number("yield_stress");
  line.pole_length = reader.number("pole_length");
  line.gap = reader.number("gap");
  line.viscosity = reader.number("viscosity");
  line.frequency = reader.number("frequency");
  line.centre = reader.number("centre");
  line.slow = reader.number("slow");
  line.offset = reader.number("offset");
  line.size = reader.required("size").as_numbers();
  line.phase = reader.required("phase").as_numbers();
  reader.finish();
  return std::make_unique<LineFamily>(std::move(line), value.where());
}

}  // namespace dashpot
