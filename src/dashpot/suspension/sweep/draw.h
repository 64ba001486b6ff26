#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "dashpot/suspension/sweep/request.h"

namespace dashpot {

/// One vehicle of a sweep: the values of the request's inputs, in their order, and the seed of its
/// road.
struct SweepDraw {
  std::size_t vehicle = 0;
  std::vector<double> values;
  std::uint64_t road_seed = 1;
};

/// Draws a vehicle. It depends on the request's seed and on its number alone, so that more samples
/// go on where fewer end. A sample's drawn values are the same at every place of the grid.
SweepDraw draw_vehicle(const SweepRequest& request, std::size_t vehicle);

/// The drawn vehicle under one of the controllers, and its road, in words.
VehicleWords vehicle_words(const SweepRequest& request, std::size_t controller,
                           const SweepDraw& draw);
std::string road_words(const SweepRequest& request, const SweepDraw& draw);

/// Whether the controller's dampers differ from vehicle to vehicle.
bool varies_dampers(const SweepRequest& request, std::size_t controller);

}  // namespace dashpot
