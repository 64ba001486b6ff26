#include "dashpot/identify/fit/family_line_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "dashpot/error.h"
#include "dashpot/numerics/linear_algebra.h"

namespace dashpot {
namespace {

constexpr double kLineRidge = 1e-2;  // keeps a feature that never changes at 0
constexpr double kSlowShare = 0.05;  // of the mean speed: below it the force goes to 0

/// Standard deviations of a record's motion, m/s and m, and the middle of its stroke.
struct LineMotion {
  double speed = 0, stroke = 0, centre = 0;
};

LineMotion motion_of(const FamilyRecord& record) {
  LineMotion motion;
  const auto n = static_cast<double>(record.force.size() - record.first);
  double v_mean = 0;
  for (std::size_t k = record.first; k < record.force.size(); ++k) {
    v_mean += record.inputs[k].velocity / n;
    motion.centre += record.inputs[k].displacement / n;
  }
  for (std::size_t k = record.first; k < record.force.size(); ++k) {
    motion.speed += std::pow(record.inputs[k].velocity - v_mean, 2) / n;
    motion.stroke += std::pow(record.inputs[k].displacement - motion.centre, 2) / n;
  }
  motion.speed = std::sqrt(motion.speed);
  motion.stroke = std::sqrt(motion.stroke);
  if (!(motion.speed > 0 && motion.stroke > 0))
    throw Error("family_line", "a record does not move", "recordings of a motion");
  return motion;
}

/// A record as a dashpot, a spring and an offset.
struct Ellipse {
  double size = 0, phase = 0, offset = 0;  // N, rad, N
};

Ellipse ellipse_of(const FamilyLine& line, const FamilyRecord& record) {
  // The normal equations of the line's terms, the velocity followed from the record's start.
  std::vector<double> square(9), right(3), found(3);
  double follower = 0;
  for (std::size_t k = 0; k < record.force.size(); ++k) {
    const DamperInput& input = record.inputs[k];
    if (k > 0)
      follower = line.follow(follower, record.inputs[k - 1].velocity, input.velocity,
                             record.time[k] - record.time[k - 1]);
    if (k < record.first) continue;
    const double r = line.amplitude(input, follower);
    const std::array<double, 3> term{input.velocity / r,
                                     line.frequency * (input.displacement - line.centre) / r, 1};
    for (std::size_t i = 0; i < 3; ++i) {
      right[i] += term[i] * record.force[k];
      for (std::size_t j = 0; j < 3; ++j) square[i * 3 + j] += term[i] * term[j];
    }
  }

  if (!solve_positive_definite(square, right, found))
    throw Error("family_line", "a record does not tell its spring from its dashpot",
                "half a cycle of motion, or more");
  return {std::hypot(found[0], found[1]), std::atan2(found[1], found[0]), found[2]};
}

/// The middle of a positive number over all records: e to the mean of its logarithm.
template <class Number>
double middle(const std::vector<FamilyRecord>& records, Number number) {
  double sum = 0;
  for (const FamilyRecord& record : records) sum += std::log(number(record));
  return std::exp(sum / static_cast<double>(records.size()));
}

std::vector<double> ridge_line(const std::vector<FamilyLine::Features>& rows, std::size_t count,
                               const std::vector<double>& values) {
  std::vector<double> square(count * count), right(count), line(count);
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t i = 0; i < count; ++i) {
      right[i] += rows[r][i] * values[r];
      for (std::size_t j = 0; j < count; ++j) square[i * count + j] += rows[r][i] * rows[r][j];
    }
  for (std::size_t i = 0; i < count; ++i) square[i * count + i] += kLineRidge;
  if (!solve_positive_definite(square, right, line))
    throw Error("family_line", "the records do not determine a line");
  return line;
}

}  // namespace

FamilyLine fit_family_line(const std::vector<FamilyRecord>& records) {
  // What the features are shares of, and whether fluids can be told apart.
  FamilyLine line;
  std::set<double> fluids;
  double current = 0, yield = 0;
  for (const FamilyRecord& record : records) {
    const double i = record.inputs[record.first].current;
    fluids.insert(record.member.viscosity);
    current = std::max(current, std::abs(i));
    yield = std::max(yield, record.member.yield.at(i));
  }
  line.by_current = fluids.size() > 1;
  line.current = current > 0 ? current : 1;
  line.yield_stress = yield > 0 ? yield : 1;
  line.pole_length = middle(records, [](const auto& r) { return r.member.pole_length; });
  line.gap = middle(records, [](const auto& r) { return r.member.gap; });
  line.viscosity = middle(records, [](const auto& r) { return r.member.viscosity; });

  // The motion that all records went through.
  double speed = 0, stroke = 0;
  const auto n = static_cast<double>(records.size());
  for (const FamilyRecord& record : records) {
    const LineMotion motion = motion_of(record);
    speed += motion.speed / n;
    stroke += motion.stroke / n;
    line.centre += motion.centre / n;
  }
  line.frequency = speed / stroke;
  line.slow = kSlowShare * speed;

  // Each record's ellipse, then the lines through all of them.
  std::vector<FamilyLine::Features> rows;
  std::vector<double> sizes, phases;
  for (const FamilyRecord& record : records) {
    const Ellipse ellipse = ellipse_of(line, record);
    rows.push_back(line.features(record.member, record.inputs[record.first].current));
    sizes.push_back(std::log(std::max(ellipse.size, 1e-6)));
    phases.push_back(ellipse.phase);
    line.offset += ellipse.offset / n;
  }
  line.size = ridge_line(rows, line.feature_count(), sizes);
  line.phase = ridge_line(rows, line.feature_count(), phases);
  return line;
}

}  // namespace dashpot
