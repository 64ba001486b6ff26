#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace dashpot {

/// Bounds of the search, one pair per unknown.
struct SearchBox {
  std::vector<double> lower, upper;  ///< finite, lower < upper
};

/// Looks for a start of a local fit: the best of about `evaluations` points of a box by controlled
/// random search with local mutation (NLopt's CRS2_LM). `start` is moved into the box and is one of
/// the points. The same seed gives the same point. A cost that is not finite counts as very bad; an
/// exception that it throws ends the search and is passed on.
std::vector<double> global_search(const std::function<double(std::span<const double>)>& cost,
                                  const SearchBox& box, std::vector<double> start, int evaluations,
                                  std::uint64_t seed);

}  // namespace dashpot
