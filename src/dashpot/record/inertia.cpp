#include "dashpot/record/inertia.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/record/differentiate.h"

namespace dashpot {

std::vector<double> acceleration_of(const Record& record) {
  if (const Channel* recorded = record.find("acceleration")) return recorded->samples;
  constexpr std::size_t kFewest = 4;
  if (!(record.sample_time > 0) || record.size() < kFewest) return {};
  return smooth_derivative(record.channel("velocity").samples, record.sample_time).slope;
}

double greatest_acceleration(const Record& record) {
  constexpr std::size_t kMany = 1000;  // above the usual one are more than the two at the ends
  if (record.find("acceleration") || record.size() < kMany) return INFINITY;
  const std::vector<double>& v = record.channel("velocity").samples;
  double greatest = 0;
  for (std::size_t k = 1; k < v.size(); ++k)
    greatest = std::max(greatest, std::abs(v[k] - v[k - 1]));

  // It is applied twice, and filters the differences as it does the samples.
  constexpr double kSumOfResponse = 1.75;  // of the low-pass, by size, at its highest cut-off
  return kSumOfResponse * kSumOfResponse * greatest / record.sample_time;
}

double usual_acceleration(const std::vector<double>& acceleration) {
  std::vector<double> size = acceleration;
  for (double& a : size) a = std::abs(a);
  const auto usual = size.begin() + static_cast<std::ptrdiff_t>(0.99 * double(size.size()));
  std::ranges::nth_element(size, usual);
  return *usual;
}

bool take_off_inertia(Record& record, double mass) {
  const std::vector<double> acceleration = acceleration_of(record);
  if (acceleration.empty()) return false;

  std::vector<double>& force = record.find("force")->samples;
  for (std::size_t k = 0; k < force.size(); ++k) force[k] -= mass * acceleration[k];
  record.moving_mass += mass;
  record.notes.push_back("inertia of " + format_number(mass) +
                         " kg between load cell and damper taken off: up to " +
                         format_number(mass * usual_acceleration(acceleration), 3) + " N");
  return true;
}

}  // namespace dashpot
