#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dashpot {

/// So many points in 0 ... 1 of each dimension, drawn so that each dimension is divided evenly
/// among them (McKay, Beckman and Conover 1979). The same seed gives the same points.
std::vector<std::vector<double>> latin_hypercube(std::size_t points, std::size_t dimensions,
                                                 std::uint64_t seed);

}  // namespace dashpot
