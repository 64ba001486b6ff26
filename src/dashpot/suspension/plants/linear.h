#pragma once
#include <complex>
#include <vector>

#include "dashpot/plant.h"

namespace dashpot {

/// M, C and K of a plant with its tyres on, and with linear dampers in its struts; n x n, row by
/// row.
struct LinearPlant {
  std::size_t size = 0;
  std::vector<double> mass, damping, stiffness;
};
/// damper: N*s/m per strut; empty: none.
LinearPlant linear_plant(const Plant& plant, const std::vector<double>& damper = {});

/// Undamped modes, Hz, ascending.
std::vector<double> natural_frequencies(const LinearPlant& plant);

/// q over what moves the ground, at f Hz: all tyres at the height 1 (those behind later, at this
/// speed), or ground acceleration 1 where the plant has no tyres. Displacements; times (2 pi f)^2
/// for accelerations.
std::vector<std::complex<double>> frequency_response(const Plant& plant,
                                                     const std::vector<double>& damper,
                                                     double frequency, double speed = 0);

}  // namespace dashpot
