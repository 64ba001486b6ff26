#pragma once
#include <vector>

#include "dashpot/monitor.h"
#include "dashpot/suspension/ride/ride.h"
#include "dashpot/vehicle.h"

namespace dashpot {

/// A vehicle's answer to one frequency of the road, as gains over the road's height: of the first
/// coordinate, the first tyre and the first strut.
struct GainPoint {
  double frequency = 0;                                   ///< Hz
  Gain body_acceleration, body, tyre_deflection, travel;  ///< 1/s^2, 1, 1, 1
  double speed = 0;                                       ///< m/s, the strut's greatest
};

struct GainOptions {
  double amplitude = 0.005;  ///< m, of the road
  double settling = 20;      ///< s before the periods that count
  double counted = 4;        ///< s, and four periods at least, that count
  double chirp = 120;        ///< s, of the whole chirp
  double relative_tolerance = 1e-6;
  Monitor monitor;
};

/// On a steady sine. Not finite where the run diverged.
GainPoint gain_by_sine(const Vehicle& vehicle, double frequency, const GainOptions& options);

/// On one exponential chirp over all of them, each read over four periods about the instant at
/// which the chirp has that frequency: quicker, and coarser where resonances are sharp.
/// frequencies: Hz, ascending.
std::vector<GainPoint> gains_by_chirp(const Vehicle& vehicle,
                                      const std::vector<double>& frequencies,
                                      const GainOptions& options);

/// 18 from 0.5 to 20 Hz, with both resonances of usual quarter cars.
std::vector<double> usual_frequencies();

}  // namespace dashpot
