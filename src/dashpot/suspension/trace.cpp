#include "dashpot/suspension/trace.h"

namespace dashpot {
namespace {

std::string per_time(const std::string& unit, const char* time) { return unit + "/" + time; }

}  // namespace

TraceWriter::TraceWriter(const Plant& plant, const PlantForces& forces, const GroundMotion& ground,
                         std::size_t samples)
    : plant_(plant), forces_(forces), ground_(ground), acceleration_(plant.size()) {
  const auto channel = [&](const std::string& name, const std::string& unit) {
    record_.channels.push_back({.name = name, .unit = unit, .origin = "simulated"});
    record_.channels.back().samples.reserve(samples);
  };
  for (const Coordinate& c : plant.coordinates) {
    channel(c.name, c.unit);
    channel(c.name + "_velocity", per_time(c.unit, "s"));
    channel(c.name + "_acceleration", per_time(c.unit, "s^2"));
  }
  for (const PlantPoint& point : plant.points) {
    channel(point.name, "m");
    channel(point.name + "_acceleration", "m/s^2");
  }
  for (const Strut& strut : plant.struts) {
    channel(strut.name + "_deflection", "m");
    channel(strut.name + "_velocity", "m/s");
    channel(strut.name + "_force", "N");
    channel(strut.name + "_current", "A");
    channel(strut.name + "_command", "A");
  }
  for (const Tyre& tyre : plant.tyres) {
    channel(tyre.name + "_road", "m");
    channel(tyre.name + "_deflection", "m");
    channel(tyre.name + "_load", "N");
  }
  if (!plant.ground.empty()) channel("ground_acceleration", "m/s^2");
  record_.time.reserve(samples);
  record_.name = plant.name;
  record_.condition = ground.description();
  record_.source = "simulation";
}

void TraceWriter::write(const PlantState& state) {
  const std::size_t n = plant_.size();
  const double *q = state.x.data(), *v = q + n;
  forces_.acceleration(state.x, state.g, acceleration_);
  record_.time.push_back(state.time);
  place_ = 0;
  for (std::size_t k = 0; k < n; ++k) {
    add(q[k]);
    add(v[k]);
    add(acceleration_[k]);
  }
  for (const PlantPoint& point : plant_.points) {
    add(along(point.row, q));
    add(along(point.row, acceleration_.data()));
  }
  for (std::size_t s = 0; s < plant_.struts.size(); ++s) {
    const DamperState& damper = state.dampers[s];
    const DamperInput motion = forces_.strut_motion(s, state.time, state.x, damper.current());
    add(motion.displacement);
    add(motion.velocity);
    add(damper.force(motion));
    add(damper.current());
    add(damper.command());
  }
  for (std::size_t w = 0; w < plant_.tyres.size(); ++w) {
    const double road = forces_.foot(w, state.time).height;
    add(road);
    add(along(plant_.tyres[w].row, q) - road);
    add(forces_.tyre_load(w, state.time, state.x));
  }
  if (!plant_.ground.empty()) add(ground_.acceleration(state.time));
}

}  // namespace dashpot
