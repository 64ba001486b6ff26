#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "dashpot/value.h"

namespace dashpot {

/// Which samples to show when there is room for about `points`: all when they fit; else half of
/// them evenly, so that a curve keeps its shape however many series there are, and of equal
/// stretches the least and the greatest value of every series; both ends. Increasing.
std::vector<std::size_t> thinned_indices(const std::vector<std::span<const double>>& series,
                                         std::size_t points);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

/// Chosen samples as {"float32": base64}, little-endian.
Value pack_float32(std::span<const double> samples, const std::vector<std::size_t>& chosen);

/// Chosen samples as {"low", "step", "int16": base64}: sample = low + step (code + 32767), an error
/// of at most range / 131068. The code -32768 stands for a number that is not finite.
Value pack_int16(std::span<const double> samples, const std::vector<std::size_t>& chosen);

}  // namespace dashpot
