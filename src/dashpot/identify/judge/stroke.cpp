#include "dashpot/identify/judge/stroke.h"

#include <algorithm>
#include <cmath>

namespace dashpot {

Stroke mean_stroke(const std::vector<DamperInput>& inputs, const std::vector<double>& time) {
  double top = 0, way = 0;
  for (const DamperInput& input : inputs) top = std::max(top, std::abs(input.velocity));
  int turns = 0, direction = 0;
  for (std::size_t k = 1; k < inputs.size(); ++k) {
    const double v = inputs[k].velocity;
    way += std::abs(v) * (time[k] - time[k - 1]);
    const int now = v > 0 ? 1 : -1;
    if (std::abs(v) <= 0.1 * top || now == direction) continue;
    direction = now;
    ++turns;
  }
  const double strokes = std::max(1, turns);
  return {way / strokes, (time.back() - time.front()) / strokes};
}

}  // namespace dashpot
