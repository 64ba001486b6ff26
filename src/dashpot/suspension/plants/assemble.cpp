#include "dashpot/suspension/plants/assemble.h"

namespace dashpot {

std::vector<double> diagonal(const std::vector<double>& values) {
  const std::size_t n = values.size();
  std::vector<double> matrix(n * n);
  for (std::size_t k = 0; k < n; ++k) matrix[k * n + k] = values[k];
  return matrix;
}

void add_along(std::vector<double>& matrix, const std::vector<double>& row, double value) {
  const std::size_t n = row.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) matrix[i * n + j] += value * row[i] * row[j];
}

std::vector<double> difference(const std::vector<double>& body, const std::vector<double>& wheel) {
  std::vector<double> row(body);
  for (std::size_t k = 0; k < wheel.size(); ++k) row[k] -= wheel[k];
  return row;
}

void add_suspension(Plant& plant, const Suspension& s) {
  const std::vector<double> row = difference(s.body_row, s.wheel_row);
  add_along(plant.stiffness, row, s.stiffness);
  add_along(plant.damping, row, s.damping);
  plant.struts.push_back({.name = s.name,
                          .row = row,
                          .body_row = s.body_row,
                          .wheel_row = s.wheel_row,
                          .extension_stop = s.extension_stop,
                          .compression_stop = s.compression_stop,
                          .stop_stiffness = s.stop_stiffness,
                          .friction = s.friction});
}

}  // namespace dashpot
