#include "dashpot/suspension/bound/storage_function.h"

#include <algorithm>
#include <cmath>

#include "dashpot/suspension/bound/limited_cost.h"

namespace dashpot {
namespace {

class StorageFunction {
 public:
  StorageFunction(const SampledPlant& car, const RideIndex& index, Certificate& certificate,
                  const MotionSquares& motion, double size, double room)
      : car_(car), index_(index), certificate_(certificate) {
    for (std::size_t i = 0; i < motion.size(); ++i) room_(i, i) = room * size / motion[i];
    room_(kOnePlace, kOnePlace) = room * size;
  }

  bool back_over(std::size_t cell) {
    if (!certificate_.limit(cell)) return false;
    return back_over(cell, 0, car_.step(), 0);
  }

 private:
  /// Over a piece of a cell at once, or in two halves where that is not proven.
  bool back_over(std::size_t cell, double from, double to, int halvings) {
    constexpr int kMost = 14;
    const bool was_too_long = halvings + 1 < halvings_;  // for the piece before: do not try it
    StateForm end, start;
    StateForm value = value_;
    if (!was_too_long && slope_of(value_, cell, to, end) && step(cell, from, to, value) &&
        slope_of(value, cell, from, start) &&
        certificate_.back_to(from, value, -1 * start, -1 * end)) {
      value_ = value;
      halvings_ = halvings;
      return true;
    }
    if (halvings == kMost) return false;
    const double middle = 0.5 * (from + to);
    return back_over(cell, middle, to, halvings + 1) && back_over(cell, from, middle, halvings + 1);
  }

  bool step(std::size_t cell, double from, double to, StateForm& value) const {
    const double h = to - from, middle = 0.5 * (from + to);
    StateForm slope[4];
    if (!slope_of(value, cell, to, slope[0])) return false;
    if (!slope_of(value + 0.5 * h * slope[0], cell, middle, slope[1])) return false;
    if (!slope_of(value + 0.5 * h * slope[1], cell, middle, slope[2])) return false;
    if (!slope_of(value + h * slope[2], cell, from, slope[3])) return false;
    value = value + h / 6 * (slope[0] + 2.0 * slope[1] + 2.0 * slope[2] + slope[3]);
    return true;
  }

  /// -dP/dt: the least over the force of what V must make up for, less the room.
  bool slope_of(const StateForm& value, std::size_t cell, double into, StateForm& slope) const {
    const AffineCar now = car_.at(cell, into);
    CostForm form = limited_cost(cost_form(now, index_), now, *certificate_.limit(cell));
    const SmallMatrix<5, 6> moved = value * now.motion;
    for (std::size_t i = 0; i < 5; ++i)
      for (std::size_t j = 0; j < 6; ++j) {
        form(i, j) += moved(i, j);
        form(j, i) += moved(i, j);
      }
    if (!(form(kForcePlace, kForcePlace) > 0)) return false;
    slope = least_over_force(form).value + -1 * room_;
    return true;
  }

  const SampledPlant& car_;
  const RideIndex& index_;
  Certificate& certificate_;
  StateForm room_, value_;
  int halvings_ = 0;  // of the last piece that was proven
};

}  // namespace

std::optional<double> certified_minimum(const Plant& plant, const SampledPlant& car,
                                        const ForceRange& range, const RideIndex& index,
                                        const LimitCourse& course, const MotionSquares& motion,
                                        double size, double room) {
  Certificate certificate(plant, car, range, index, course);
  StorageFunction storage(car, index, certificate, motion, size, room);
  for (std::size_t cell = car.cells(); cell-- > 0;)
    if (!storage.back_over(cell)) return {};
  return certificate.bound();
}

}  // namespace dashpot
