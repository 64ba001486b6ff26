#pragma once
#include <cmath>
#include <numbers>

#include "dashpot/base/random.h"
#include "dashpot/dataset.h"
#include "dashpot/physics/plate_flow.h"

namespace dashpot {

/// A family of dampers that are not of any model's structure: exact plate flow behind one spring,
/// Coulomb friction beside, builds that differ, noise, and a field of its own.
struct VirtualFamily {
  std::vector<double> gaps{1e-3, 1.4e-3, 1.8e-3}, lengths{6e-3, 9e-3, 12e-3}, bores{1};
  std::vector<double> viscosities{0.09, 0.25};
  std::vector<double> currents{0, 0.25, 0.5, 1, 1.5};
  int samples = 250;                     // of a record, over three cycles
  double scatter = 0.03, noise = 0.005;  // of the force: builds; of its greatest: the sensor
  double amperes = 1;                    // times which every current stands in the records
  double spring_of_gap = 0;              // power of the gap in the spring, 0: one for all
};

/// Yield stress of the truth, Pa: of neither the shape nor the scale of the family paper's.
inline double virtual_yield_stress(double current, double viscosity) {
  return 300 + (viscosity > 0.1 ? 34e3 : 22e3) * std::pow(std::tanh(0.9 * current), 1.4);
}

inline Record virtual_record(const VirtualFamily& family, double bore, double gap, double length,
                             double viscosity, double current, int motion, double build,
                             Random& random) {
  constexpr double kFriction = 15, kDiameter = 26e-3;
  const double stiffness = 1.2e6 * std::pow(gap / 1e-3, family.spring_of_gap);
  const double area = bore * 5e-4, width = std::sqrt(bore) * std::numbers::pi * kDiameter;
  const PlateGap plate{length, width, gap};
  const double newtonian = build * area * plate_newtonian_pressure(&plate, viscosity, area);
  const double yielding =
      build * area * plate_yield_pressure(&plate, virtual_yield_stress(current, viscosity));

  Record record;
  record.condition = std::to_string(bore) + " " + std::to_string(gap * 1e3) + " " +
                     std::to_string(length * 1e3) + " " + std::to_string(viscosity);
  record.name = record.condition + " " + std::to_string(current) + " " + std::to_string(motion);
  record.drive_level = family.amperes * current;
  record.conditions = {{"piston_area", area},
                       {"gap_area", width * gap},
                       {"gap", gap},
                       {"pole_length", length},
                       {"viscosity", viscosity},
                       {"yield_stress", virtual_yield_stress(current, viscosity)}};

  // A sine from rest at its end, in steps much finer than the samples. The spring's force is that
  // at which what the spring gives and what flows make up the motion.
  constexpr int kParts = 20;
  const double half_stroke = motion ? 8e-3 : 20e-3,
               rate = 2 * std::numbers::pi * (motion ? 2. : 0.6);
  const double step = 3. / (rate / (2 * std::numbers::pi)) / family.samples / kParts;
  double spring = 0, most = 0;
  std::vector<double> x, v, i, force;
  for (int k = 0; k < family.samples * kParts; ++k) {
    const double t = k * step, speed = half_stroke * rate * std::sin(rate * t);
    const double pull = spring + stiffness * step * speed;
    double low = 0, high = std::abs(pull);
    for (int n = 0; n < 40; ++n) {
      const double f = 0.5 * (low + high);
      const double flow = f > 0 ? plate_bingham_newtonian(f, yielding) / newtonian : 0;
      (f + stiffness * step * flow > std::abs(pull) ? high : low) = f;
    }
    spring = std::copysign(0.5 * (low + high), pull);
    if (k % kParts) continue;
    record.time.push_back(t);
    x.push_back(-half_stroke * std::cos(rate * t));
    v.push_back(speed);
    i.push_back(family.amperes * current);
    force.push_back(spring + build * kFriction * std::tanh(speed / 1e-3));
    most = std::max(most, std::abs(force.back()));
  }
  for (double& f : force) f += family.noise * most * random.normal();
  record.channels = {{"displacement", "m", x, ""},
                     {"velocity", "m/s", v, ""},
                     {"current", "A", i, ""},
                     {"force", "N", force, ""}};
  record.sample_time = step * kParts;
  return record;
}

inline Dataset virtual_family(const VirtualFamily& family) {
  Dataset data;
  data.name = "virtual family";
  Random random(7);
  for (const double bore : family.bores)
    for (const double gap : family.gaps)
      for (const double length : family.lengths)
        for (const double viscosity : family.viscosities) {
          const double build = 1 + family.scatter * random.normal();
          for (const double current : family.currents)
            for (const int motion : {0, 1})
              data.records.push_back(virtual_record(family, bore, gap, length, viscosity, current,
                                                    motion, build, random));
        }
  return data;
}

/// Every third sample, which fits are as good on where the motion is slow, in a third of the time.
inline std::vector<Record> every_third(std::vector<Record> records) {
  const auto thin = [](std::vector<double>& values) {
    for (std::size_t k = 0; 3 * k < values.size(); ++k) values[k] = values[3 * k];
    values.resize((values.size() + 2) / 3);
  };
  for (Record& record : records) {
    record.sample_time *= 3;
    record.warm_up /= 3;
    thin(record.time);
    for (Channel& channel : record.channels) thin(channel.samples);
  }
  return records;
}

}  // namespace dashpot
