#include "dashpot/machine/disagreeing_sensors.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/numerics/filter.h"
#include "dashpot/numerics/linear_algebra.h"

namespace dashpot {
namespace {

/// A deflection, and the accelerations that make it: places among the sensors.
struct Joint {
  std::size_t deflection = 0;
  std::vector<std::size_t> accelerations;
  std::vector<double> row;  ///< how many times each acceleration goes into its bend
};

bool is_plain(const PlantSensor& sensor) {
  return sensor.filter == SensorFilter{} && !sensor.finds_cutoff;
}

/// The plant where its unknown numbers are at one or the other end of where they are looked for.
Plant plant_at(const InPlantSetup& setup, double PlantUnknown::* end) {
  NamedValues values = setup.known;
  for (const PlantUnknown& unknown : setup.unknown) values.emplace_back(unknown.name, unknown.*end);
  return make_plant(*setup.model, values, "plant");
}

/// The deflections of which all is measured, in a plant whose shape is known: `other` is the same
/// one with other numbers.
std::vector<Joint> joints_of(const InPlantSetup& setup, const Plant& plant, const Plant& other) {
  std::vector<Joint> joints;
  if (!plant.ground.empty()) return joints;  // its displacements are beside a ground that shakes
  for (std::size_t s = 0; s < setup.sensors.size(); ++s) {
    const PlantSensor& sensor = setup.sensors[s];
    if (sensor.place.quantity != PlantQuantity::Deflection || !is_plain(sensor)) continue;
    const Strut& strut = plant.struts[sensor.place.strut];
    if (strut.track || strut.row != other.struts[sensor.place.strut].row) continue;

    Joint joint{.deflection = s};
    std::size_t parts = 0;
    for (std::size_t c = 0; c < strut.row.size(); ++c) {
      if (strut.row[c] == 0) continue;
      ++parts;
      const auto found = std::ranges::find_if(setup.sensors, [&](const PlantSensor& one) {
        return one.place.quantity == PlantQuantity::Acceleration && one.place.coordinate == c &&
               is_plain(one);
      });
      if (found == setup.sensors.end()) continue;
      joint.accelerations.push_back(static_cast<std::size_t>(found - setup.sensors.begin()));
      joint.row.push_back(strut.row[c]);
    }
    if (parts == joint.row.size()) joints.push_back(std::move(joint));
  }
  return joints;
}

/// Sums over all recordings for a fit of the bend by the accelerations.
struct Sums {
  std::vector<double> matrix, right;
  double power = 0;
  double independent = 0;  ///< how many samples would be so without the low-pass
};

/// Adds what a recording shows below the cut-off, where both are well above their noise.
void add(Sums& sums, const Joint& joint, const InPlantTrace& trace) {
  constexpr double kCutoff = 15, kOfRate = 0.1;  // Hz
  constexpr int kOrder = 4;
  const double dt = trace.sample_time, cutoff = std::min(kCutoff, kOfRate / dt);
  const auto sections = butterworth_lowpass(kOrder, cutoff, dt);
  const auto low = [&](std::size_t sensor) {
    return filter_zero_phase(
        sections,
        std::span(trace.measured[sensor]).subspan(trace.first, trace.training - trace.first));
  };
  const std::vector<double> deflection = low(joint.deflection);
  std::vector<std::vector<double>> columns;
  for (const std::size_t sensor : joint.accelerations) columns.push_back(low(sensor));

  // Away from both ends, where the filter guesses; without the sensors' zeros.
  const auto margin = static_cast<std::size_t>(2 / (cutoff * dt)) + 1;
  if (deflection.size() < 4 * margin) return;
  std::vector<double> bend;
  for (std::size_t k = margin; k + margin < deflection.size(); ++k)
    bend.push_back((deflection[k + 1] - 2 * deflection[k] + deflection[k - 1]) / (dt * dt));
  const auto without_mean = [](std::vector<double>& values) {
    double mean = 0;
    for (const double value : values) mean += value / static_cast<double>(values.size());
    for (double& value : values) value -= mean;
  };
  without_mean(bend);
  for (std::vector<double>& column : columns) {
    column.erase(column.end() - static_cast<std::ptrdiff_t>(margin), column.end());
    column.erase(column.begin(), column.begin() + static_cast<std::ptrdiff_t>(margin));
    without_mean(column);
  }

  const std::size_t n = columns.size();
  for (std::size_t k = 0; k < bend.size(); ++k) {
    sums.power += bend[k] * bend[k];
    for (std::size_t i = 0; i < n; ++i) {
      sums.right[i] += columns[i][k] * bend[k];
      for (std::size_t j = 0; j < n; ++j) sums.matrix[i * n + j] += columns[i][k] * columns[j][k];
    }
  }
  sums.independent += 2 * cutoff * dt * static_cast<double>(bend.size());
}

/// How many times what it should each acceleration shows, beside the deflection; nothing where they
/// do not make its bend, or where one of them tells too little.
std::optional<std::vector<double>> gains_of(const Joint& joint,
                                            const std::vector<InPlantTrace>& traces) {
  constexpr double kExplained = 0.8, kSure = 0.15;  // of the power; of a gain, as 2 deviations
  const std::size_t n = joint.row.size();
  Sums sums{std::vector<double>(n * n), std::vector<double>(n)};
  for (const InPlantTrace& trace : traces) add(sums, joint, trace);
  std::vector<double> x(n);
  if (!solve_positive_definite(sums.matrix, sums.right, x)) return std::nullopt;
  double explained = 0;
  for (std::size_t i = 0; i < n; ++i) explained += x[i] * sums.right[i];
  if (!(explained > kExplained * sums.power) || sums.independent <= n) return std::nullopt;

  const double left = (sums.power - explained) / (sums.independent - static_cast<double>(n));
  const std::vector<double> spread = inverse(sums.matrix, n);
  std::vector<double> gains;
  for (std::size_t i = 0; i < n; ++i) {
    // The sums count every sample, of which so many are independent.
    const double deviation = std::sqrt(std::max(0.0, left * spread[i * n + i]));
    if (!(2 * deviation < kSure * std::abs(x[i]))) return std::nullopt;
    gains.push_back(joint.row[i] / x[i]);
  }
  return gains;
}

/// A gain that no noise, filter or clock makes.
bool is_wrong(double gain) { return !(gain > 0.5 && gain < 2); }

std::string told(const std::string& channel, double gain, const std::string& beside) {
  return channel + ": shows " + format_number(gain, 3) + " times what " + beside +
         " make of it, whatever the damper is: " +
         (gain < 0 ? "does it count the other way round?" : "is its unit right?");
}

}  // namespace

std::vector<std::string> disagreeing_sensors(const InPlantSetup& setup,
                                             const std::vector<InPlantTrace>& traces) {
  // A plant that cannot be at the ends of its numbers' ranges is not asked.
  std::vector<Joint> joints;
  try {
    joints = joints_of(setup, plant_at(setup, &PlantUnknown::lower),
                       plant_at(setup, &PlantUnknown::upper));
  } catch (const Error&) {
    return {};
  }

  std::vector<std::string> all;
  for (const Joint& joint : joints) {
    const auto gains = gains_of(joint, traces);
    if (!gains || std::ranges::none_of(*gains, is_wrong)) continue;
    const std::string& deflection = setup.sensors[joint.deflection].channel;
    std::vector<std::string> names;
    for (const std::size_t sensor : joint.accelerations)
      names.push_back(setup.sensors[sensor].channel);

    // Where all are wrong alike, the deflection is; else those that are.
    constexpr double kAlike = 1.5;
    const auto [least, most] = std::ranges::minmax(*gains);
    if (least * most > 0 && std::max(least / most, most / least) < kAlike) {
      all.push_back(told(deflection, 1 / (*gains)[0], join(names, " and ")));
      continue;
    }
    for (std::size_t i = 0; i < names.size(); ++i)
      if (is_wrong((*gains)[i])) {
        std::vector<std::string> others = {deflection};
        for (const std::string& name : names)
          if (name != names[i]) others.push_back(name);
        all.push_back(told(names[i], (*gains)[i], join(others, " and ")));
      }
  }
  return all;
}

}  // namespace dashpot
