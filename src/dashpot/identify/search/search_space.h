#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/identify/fit/network_design.h"

namespace dashpot {

/// A setting of networks and the values that a search may give it: a list, or all of a range.
struct SearchAxis {
  std::string setting;              ///< as network_design.h names it
  std::vector<std::string> values;  ///< as its table reads them; empty: a range
  double low = 0, high = 0;         ///< of the range, both ends included
  bool whole = false;               ///< only whole numbers lie in the range
};

/// "hidden=5,10,10-10" or "l2=1e-5:1e-2"; `option` stands in messages. Throws Error at an unknown
/// setting, a value that it cannot have or that comes twice, and a range that is none.
SearchAxis parse_search_axis(std::string_view text, const std::string& option);
/// Reads back as the same axis.
std::string format_axis(const SearchAxis& axis);

/// The settings that are searched, and those that are the same for all designs.
struct SearchSpace {
  std::vector<SearchAxis> axes;
  NetworkDesign fixed;
};

/// Throws Error when there is nothing to search, an axis comes twice or is fixed as well, or
/// `model` or every trainer of the space has no use for a setting.
void require_space(const SearchSpace& space, const std::string& model);

// A design leaves out what its trainer has no use for: rate, schedule, batch and l1 are for
// mini-batches, and Bayesian regularisation finds its l2.

/// Every combination, the last axis running fastest; of a range `steps` values: the ends and what
/// lies at even ratios between them (at even distances where it begins at 0). Throws Error when
/// there are over 10^5.
std::vector<NetworkDesign> grid_designs(const SearchSpace& space, std::size_t steps);

/// Up to `count` different ones by chance: lists evenly, ranges evenly in the logarithm (whole
/// numbers from 0: evenly), to three digits. A larger count starts with the same designs; fewer
/// than `count` when the space has no more.
std::vector<NetworkDesign> random_designs(const SearchSpace& space, std::size_t count,
                                          std::uint64_t seed);

/// A seed of its own for each purpose.
std::uint64_t seed_for(std::uint64_t seed, std::string_view purpose);

}  // namespace dashpot
