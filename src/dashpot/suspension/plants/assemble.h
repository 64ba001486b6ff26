#pragma once
#include <vector>

#include "dashpot/plant.h"

namespace dashpot {

/// n x n with these values on the diagonal.
std::vector<double> diagonal(const std::vector<double>& values);
/// matrix += value row' row, the part of a spring, damper or mass along `row`. One value per
/// coordinate.
void add_along(std::vector<double>& matrix, const std::vector<double>& row, double value);
/// body - wheel, one value per coordinate.
std::vector<double> difference(const std::vector<double>& body, const std::vector<double>& wheel);

/// A spring and a linear damper between body and wheel, and a place for a damper beside them. SI;
/// rows have one value per coordinate; stops of 0 are none.
struct Suspension {
  std::string name;
  std::vector<double> body_row, wheel_row;
  double stiffness = 0, damping = 0, friction = 0, extension_stop = 0, compression_stop = 0,
         stop_stiffness = 0;
};
/// Its spring and damper go into the plant's matrices, its strut behind the plant's struts.
void add_suspension(Plant& plant, const Suspension& suspension);

}  // namespace dashpot
