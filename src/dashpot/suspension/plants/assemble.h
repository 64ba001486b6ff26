#pragma once
#include <vector>

#include "dashpot/plant.h"

namespace dashpot {

/// n x n with these values on the diagonal.
std::vector<double> diagonal(const std::vector<double>& values);
/// matrix += value row' row: what a spring, damper or mass along `row` adds.
void add_along(std::vector<double>& matrix, const std::vector<double>& row, double value);
/// body - wheel, one value per coordinate.
std::vector<double> difference(const std::vector<double>& body, const std::vector<double>& wheel);

/// A spring and a linear damper between body and wheel, and a place for a damper beside them.
struct Suspension {
  std::string name;
  std::vector<double> body_row, wheel_row;
  double stiffness = 0, damping = 0, friction = 0, extension_stop = 0, compression_stop = 0,
         stop_stiffness = 0;
};
void add_suspension(Plant& plant, const Suspension& suspension);

}  // namespace dashpot
