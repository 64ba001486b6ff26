#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace dashpot {

struct SearchBox {
  std::vector<double> lower, upper;  ///< finite, lower < upper
};

/// The best of about `evaluations` points of a box by controlled random search with local mutation
/// (NLopt's CRS2_LM), a start for a local fit. The same seed gives the same point. A cost that is
/// not finite counts as very bad; what it throws comes out.
std::vector<double> global_search(const std::function<double(std::span<const double>)>& cost,
                                  const SearchBox& box, std::vector<double> start, int evaluations,
                                  std::uint64_t seed);

}  // namespace dashpot
