#include "dashpot/suspension/trace.h"

#include <algorithm>

namespace dashpot {
namespace {

std::string per_time(const std::string& unit, const char* time) { return unit + "/" + time; }

/// Share of the samples from `first` on that some part marks: is_marked(part, its channel's value).
template <class Part, class Mark>
double share_marked(const Record& trace, const std::vector<Part>& parts, const char* channel,
                    std::size_t first, Mark is_marked) {
  if (first >= trace.size()) return 0;
  std::vector<char> marked(trace.size() - first);
  for (const Part& part : parts) {
    const std::vector<double>& values = trace.channel(part.name + channel).samples;
    for (std::size_t k = 0; k < marked.size(); ++k) marked[k] |= is_marked(part, values[first + k]);
  }
  return static_cast<double>(std::ranges::count(marked, 1)) / static_cast<double>(marked.size());
}

}  // namespace

TraceWriter::TraceWriter(const Setting& setting, const PlantForces& forces, std::size_t samples)
    : plant_(setting.plant), forces_(forces), ground_(setting.ground) {
  const Plant& plant = setting.plant;
  const auto channel = [&](const std::string& name, const std::string& unit) {
    record_.channels.push_back({.name = name, .unit = unit, .origin = "simulated"});
    record_.channels.back().samples.reserve(samples + kRows);
  };

  // Channels in the order in which write() adds their samples.
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
    channel(strut.name + "_current", unit_of(setting.drive_unit));
    channel(strut.name + "_command", unit_of(setting.drive_unit));
  }
  for (const Tyre& tyre : plant.tyres) {
    channel(tyre.name + "_road", "m");
    channel(tyre.name + "_deflection", "m");
    channel(tyre.name + "_load", "N");
  }
  if (!plant.ground.empty()) channel("ground_acceleration", "m/s^2");

  record_.time.reserve(samples + kRows);
  columns_.resize(1 + record_.channels.size());
  record_.name = plant.name;
  record_.condition = setting.ground.description();
  record_.source = "simulation";
}

double contact_lost(const Record& trace, const Plant& plant, std::size_t first) {
  return share_marked(trace, plant.tyres, "_load", first,
                      [](const Tyre&, double load) { return load <= 0; });
}

double stops_met(const Record& trace, const Plant& plant, std::size_t first) {
  return share_marked(trace, plant.struts, "_deflection", first, [](const Strut& strut, double x) {
    return (strut.extension_stop > 0 && x > strut.extension_stop) ||
           (strut.compression_stop > 0 && x < -strut.compression_stop);
  });
}

void TraceWriter::make_room() {
  const auto grow = [](std::vector<double>& samples) {
    samples.resize(samples.size() + kRows);
    return &*(samples.end() - kRows);
  };
  columns_[0] = grow(record_.time);
  for (std::size_t c = 0; c < record_.channels.size(); ++c)
    columns_[1 + c] = grow(record_.channels[c].samples);
  row_ = 0;
}

Record TraceWriter::take() {
  const std::size_t written = record_.time.size() + row_ - kRows;
  record_.time.resize(written);
  for (Channel& channel : record_.channels) channel.samples.resize(written);
  return std::move(record_);
}

template <class Sizes>
void TraceWriter::write_row(Sizes sizes, const PlantState& state, std::span<const FootMotion> road,
                            std::span<const DamperInput> motions) {
  const double *q = state.x.data(), *v = q + sizes.coordinates, *a = state.acceleration.data();
  double* const* column = columns_.data();
  const auto add = [&column, row = row_](double value) { (*column++)[row] = value; };

  // The time, then samples in the order of the channels.
  add(state.time);
  for (std::size_t k = 0; k < sizes.coordinates; ++k) {
    add(q[k]);
    add(v[k]);
    add(a[k]);
  }
  for (const PlantPoint& point : plant_.points) {
    add(along(sizes, point.row, q));
    add(along(sizes, point.row, a));
  }
  for (std::size_t s = 0; s < sizes.struts; ++s) {
    const DamperState& damper = state.dampers[s];
    add(motions[s].displacement);
    add(motions[s].velocity);
    add(state.damper_forces[s]);
    add(damper.current());
    add(damper.command());
  }
  for (std::size_t w = 0; w < sizes.tyres; ++w) {
    add(road[w].height);
    add(along(sizes, plant_.tyres[w].row, q) - road[w].height);
    add(forces_.tyre_load(sizes, w, road[w], q));
  }
  if (!plant_.ground.empty()) add(ground_.acceleration(state.time));
}

void TraceWriter::write(const PlantState& state, std::span<const FootMotion> road,
                        std::span<const DamperInput> motions) {
  if (row_ == kRows) make_room();
  forces_.with_sizes([&](auto sizes) { write_row(sizes, state, road, motions); });
  ++row_;
}

double damper_energy(const Record& trace, const Strut& strut, std::size_t first) {
  const std::vector<double>&force = trace.channel(strut.name + "_force").samples,
        &velocity = trace.channel(strut.name + "_velocity").samples;
  double energy = 0;
  for (std::size_t k = first + 1; k < trace.size(); ++k)
    energy += 0.5 * (force[k - 1] * velocity[k - 1] + force[k] * velocity[k]) *
              (trace.time[k] - trace.time[k - 1]);
  return energy;
}

std::string foot_of(const Plant& plant) {
  const bool on_tyres = std::ranges::all_of(
      plant.tyres, [](const Tyre& tyre) { return tyre.name.ends_with("tyre"); });
  return on_tyres ? "tyre" : plant.tyres.front().name;
}

}  // namespace dashpot
