#include "dashpot/suspension/steps/plant_equations.h"

#include <algorithm>

#include "dashpot/suspension/dampers/damper_state.h"

namespace dashpot {

PlantEquations::PlantEquations(const PlantForces& forces, const PlantState& start)
    : forces_(forces),
      coordinates_(start.acceleration.size()),
      size_(start.x.size()),
      currents_(start.dampers.size()),
      damper_forces_(start.dampers.size()),
      strut_forces_(start.dampers.size()),
      speeds_(start.dampers.size()),
      steady_(start.dampers.size()) {
  for (const DamperState& damper : start.dampers) {
    size_ += damper.model_state().size();
    laws_.push_back({soft_law(damper.model())});
  }
  states_.resize(size_ - start.x.size());
  feet_.resize(forces.sizes().tyres * kInstants);

  // The numbers of a RoadCar.
  is_road_car_ = forces.is_plain_quarter_car() && laws_[0].law.law;
  if (!is_road_car_) return;
  const auto column = [](const std::vector<double>& rows, std::size_t k) {
    return BodyAndWheel{rows[k], rows[rows.size() / 2 + k]};
  };
  road_car_.row = column(forces.plant().struts[0].row, 0);
  for (std::size_t k = 0; k < 4; ++k) road_car_.by_state[k] = column(forces.by_state(), k);
  road_car_.by_strut = column(forces.by_strut(), 0);
  road_car_.by_tyre = column(forces.by_tyre(), 0);
  road_car_.stops = forces.resistance(0);
  road_car_.tyre = forces.contact(0);
  road_car_.ratio = start.dampers[0].mounted().motion_ratio;
  road_car_.factor = start.dampers[0].mounted().force_factor;
  road_car_.law = laws_[0].law;
  road_car_.states = states_.data();
}

void PlantEquations::follow_loops(const PlantState& start, const IntegratorOptions& options) {
  std::size_t first = start.x.size();
  for (std::size_t s = 0; s < start.dampers.size(); ++s) {
    if (const auto loop = loop_of(start.dampers[s].model())) {
      const double tolerance =
          options.absolute_tolerance + options.relative_tolerance * loop->shape.z_max;
      loops_.push_back({{loop->shape, tolerance, false}, s, first + loop->state, {}});
      if (loop->in_series) loops_.back().series = first;
    }
    first += start.dampers[s].model_state().size();
  }
  if (!loops_.empty()) road_car_.loop = loops_.data();
}

void PlantEquations::read(const PlantState& state, double* y) {
  read_currents(state);
  double* z = y + state.x.size();
  forces_.with_sizes([&](auto sizes) { std::copy_n(state.x.data(), 2 * sizes.coordinates, y); });
  for (const DamperState& damper : state.dampers)
    for (const double value : damper.model_state()) *z++ = value;

  // A loop goes on along its branch where z is as it was left.
  for (FollowedLoop& loop : loops_)
    y[loop.place] = y[loop.place] == loop.z ? loop.r : loop.path.folded(y[loop.place]);
}

void PlantEquations::read_currents(const PlantState& state) {
  state_ = &state;
  forces_.with_sizes([&](auto sizes) {
    for (std::size_t s = 0; s < sizes.struts; ++s) {
      const double current = state.dampers[s].current();
      const bool stays = state.dampers[s].is_steady();
      currents_[s] = current;
      steady_[s] = stays;
      SteadyLaw& steady = laws_[s];
      if (!steady.law.law || !stays || current == steady.current) continue;
      steady.current = current;
      steady.law.law->parameters_at(current, steady.parameters.data());
    }
  });
}

void PlantEquations::rates(double after, const double* y, double* dy) noexcept {
  const auto foot_of = [&](std::size_t tyre) { return forces_.foot(tyre, state_->time + after); };
  forces_.with_sizes([&](auto sizes) { rates_of(sizes, after, y, dy, foot_of); });
}

template <class Sizes, class FootOf>
void PlantEquations::rates_of(Sizes sizes, double after, const double* y, double* dy,
                              FootOf foot_of) noexcept {
  const std::size_t n = sizes.coordinates;
  const double t = state_->time + after;
  double* dz = dy + 2 * n;

  // The dampers' states as their laws have them.
  const double* z = y + 2 * n;
  if (!loops_.empty()) {
    std::copy(z, y + size_, states_.begin());
    z = states_.data();
  }
  for (FollowedLoop& loop : loops_) {
    const auto place = loop.path.place(y[loop.place]);
    loop.m = place.m;
    loop.steep = place.steep;
    states_[loop.place - 2 * n] = loop.path.unfolded(place);
  }

  // Each damper's force, and the rates of its states.
  for (std::size_t s = 0; s < sizes.struts; ++s) {
    const DamperState& damper = state_->dampers[s];
    const std::size_t count = damper.model_state().size();
    const double current = steady_[s] ? currents_[s] : damper.current_after(after);
    const DamperInput motion = forces_.strut_motion(sizes, s, t, y, current);
    damper_forces_[s] = laws_[s].law.law && steady_[s]
                            ? damper.flow(laws_[s].law, laws_[s].parameters.data(), motion, z, dz)
                            : damper.flow(motion, {z, count}, {dz, count});
    strut_forces_[s] = damper_forces_[s] + forces_.strut_extra(s, motion);
    speeds_[s] = damper.speed(motion);
    z += count;
    dz += count;
  }
  for (FollowedLoop& loop : loops_) {
    const double travel = speeds_[loop.damper] - (loop.series ? dy[*loop.series] : 0);
    loop.along = loop.path.along(travel);
    dy[loop.place] = loop.path.folded_rate(dy[loop.place], loop.along, {loop.m, loop.steep});
  }

  // The motion under these forces.
  std::copy_n(y + n, n, dy);
  forces_.accelerate(sizes, t, y, strut_forces_.data(), foot_of, dy + n);
}

void PlantEquations::rates_at(std::size_t instant, const double* y, double* dy) noexcept {
  const auto foot_of = [&](std::size_t tyre) { return feet_[tyre * kInstants + instant]; };
  forces_.with_sizes([&](auto sizes) { rates_of(sizes, after_[instant], y, dy, foot_of); });
}

void PlantEquations::look_ahead(std::span<const double> after) noexcept {
  const std::size_t count = ahead_count_ = after.size();
  for (std::size_t k = 0; k < count; ++k) {
    after_[k] = after[k];
    times_[k] = state_->time + after[k];
  }
  forces_.with_sizes([&](auto sizes) {
    for (std::size_t w = 0; w < sizes.tyres; ++w)
      forces_.feet(w, {times_.data(), count}, {feet_.data() + w * kInstants, count});
  });
  if (!is_road_car_ || steady_[0]) return;
  for (std::size_t k = 0; k < count; ++k)
    road_car_.law.law->parameters_at(state_->dampers[0].current_after(after[k]), ahead_[k].data());
}

void PlantEquations::write_forces(const double* dy, PlantState& state) const {
  forces_.with_sizes([&](auto sizes) {
    for (std::size_t s = 0; s < sizes.struts; ++s) {
      state.damper_forces[s] = damper_forces_[s];
      state.strut_forces[s] = strut_forces_[s];
    }
    std::copy_n(dy + sizes.coordinates, sizes.coordinates, state.acceleration.data());
  });
}

void PlantEquations::write(const double* y, const double* dy, double end, PlantState& state) {
  forces_.with_sizes([&](auto sizes) { std::copy_n(y, 2 * sizes.coordinates, state.x.data()); });
  for (FollowedLoop& loop : loops_) {
    loop.r = y[loop.place];
    loop.z = states_[loop.place - state.x.size()];
  }
  y = loops_.empty() ? y + state.x.size() : states_.data();
  for (DamperState& damper : state.dampers) {
    damper.put_model_state(y);
    y += damper.model_state().size();
    damper.advance_coil(end - state.time);
  }
  write_forces(dy, state);

  // The road at the last of the instants ahead, where that is the end.
  state.time = end;
  if (ahead_count_ == 0 || times_[ahead_count_ - 1] != end) return;
  state.road_time = end;
  for (std::size_t w = 0; w < state.road.size(); ++w)
    state.road[w] = feet_[w * kInstants + ahead_count_ - 1];
}

}  // namespace dashpot
