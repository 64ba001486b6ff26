#include "dashpot/report/front_parts.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace dashpot {
namespace {

/// The line below and left of which the bounds leave nothing: the envelope of all straight lines
/// comfort a + holding w = bound, a and w being mean squares.
FigureSeries bound_line(const std::vector<ClairvoyantBound>& front, const RideRoots& unit) {
  FigureSeries line{.label = "proven bound",
                    .colour = "measured",
                    .x = {},
                    .y = {},
                    .mark = FigureSeries::Mark::Dashes};
  double least = front.front().squares.acceleration, greatest = front.back().squares.acceleration;
  least = std::min(least, front.front().bound / front.front().index.comfort);

  // At each comfort, the greatest tyre force that some bound demands.
  for (int k = 0; k <= 100; ++k) {
    const double a = least + (greatest - least) * k / 100;
    double tyre = 0;
    for (const ClairvoyantBound& best : front)
      if (best.index.holding > 0)
        tyre = std::max(tyre, (best.bound - best.index.comfort * a) / best.index.holding);
    line.x.push_back(std::sqrt(a) / unit.acceleration);
    line.y.push_back(std::sqrt(tyre) / unit.tyre_force);
  }
  return line;
}

}  // namespace

std::vector<FigureSeries> front_lines(const std::vector<ClairvoyantBound>& front,
                                      const RideRoots& unit) {
  FigureSeries reached{.label = "optimum, knew the road", .colour = "modelled", .x = {}, .y = {}};
  for (const ClairvoyantBound& best : front) {
    reached.x.push_back(std::sqrt(best.squares.acceleration) / unit.acceleration);
    reached.y.push_back(std::sqrt(best.squares.tyre_force) / unit.tyre_force);
  }
  return {bound_line(front, unit), std::move(reached)};
}

double root_of(const RideIndex& index, const RideSquares& squares) {
  return std::sqrt(squares.of(index));
}

std::string whole_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.0f}", value) : "-";
}

std::string possible_text(const ClairvoyantBound& best, const RideSquares& passive,
                          const RideSquares& controller) {
  return whole_text(100 * share_of_possible(root_of(best.index, passive),
                                            root_of(best.index, controller),
                                            std::sqrt(best.optimum)));
}

Value squares_json(const RideSquares& squares) {
  return Value::object({{"body_acceleration_rms", std::sqrt(squares.acceleration)},
                        {"tyre_force_rms", std::sqrt(squares.tyre_force)}});
}

Value front_json(const std::vector<ClairvoyantBound>& front) {
  Value list = Value::array();
  for (const ClairvoyantBound& best : front)
    list.push_back(Value::object({{"comfort_weight", best.index.comfort},
                                  {"holding_weight", best.index.holding},
                                  {"bound", best.bound},
                                  {"proven", best.proven},
                                  {"optimum", best.optimum},
                                  {"gap", best.gap()},
                                  {"at_optimum", squares_json(best.squares)}}));
  return list;
}

}  // namespace dashpot
