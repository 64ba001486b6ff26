#pragma once
#include <cstddef>
#include <vector>

#include "dashpot/rank.h"

namespace dashpot {

/// A model of a ranking that goes into the mean of several, by its place, and its weight there.
struct MeanShare {
  std::size_t model = 0;
  double weight = 0;
};

/// Of judged models the two to four best ones that may be recommended, as many as leave the least
/// on left-out records together, each weighted by the reciprocal of the squared error that it
/// leaves there alone. The least error first. Empty where fewer than two are there.
std::vector<MeanShare> shares_of_mean(const std::vector<RankedModel>& models);

/// Gives the mean its title, "Mean of tanh_kwok, bouc_wen and passive_network", and its fits: those
/// of the members put together, division by division and the final ones.
void make_mean(const std::vector<RankedModel>& models, const std::vector<MeanShare>& shares,
               RankedModel& mean);

}  // namespace dashpot
