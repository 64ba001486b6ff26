#include "dashpot/numerics/jackknife.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "dashpot/numerics/distributions.h"
#include "dashpot/numerics/linear_algebra.h"

namespace dashpot {
namespace {

/// Directions flatter than this share of the steepest are left out, as of any covariance.
constexpr double kFlat = 1e-9;

}  // namespace

Jackknife::Jackknife(std::span<const BlockOfData> blocks, std::size_t n)
    : n_(n), scale_(n), covariance_(n * n) {
  std::vector<double> total(n * n), score(n);
  for (const BlockOfData& one : blocks) {
    for (std::size_t i = 0; i < n * n; ++i) total[i] += one.information[i];
    for (std::size_t k = 0; k < n; ++k) score[k] += one.score[k];
  }

  // Each unknown in the size at which all blocks tell it.
  for (std::size_t k = 0; k < n; ++k)
    scale_[k] = total[k * n + k] > 0 ? 1 / std::sqrt(total[k * n + k]) : 0;
  const auto scaled = [&](std::vector<double> matrix) {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) matrix[i * n + k] *= scale_[i] * scale_[k];
    return matrix;
  };
  const auto in_scale = [&](std::vector<double> values) {
    for (std::size_t k = 0; k < n; ++k) values[k] *= scale_[k];
    return values;
  };
  total = scaled(std::move(total));
  all_ = invert_symmetric(total, n, kFlat).inverse;
  step_ = product(all_, in_scale(score), n);
  for (double& value : step_) value = -value;

  // Where the estimate goes without one block.
  const auto count = static_cast<double>(blocks.size());
  for (const BlockOfData& one : blocks) {
    information_.push_back(scaled(one.information));
    std::vector<double> others = total;
    for (std::size_t i = 0; i < n * n; ++i) others[i] -= information_.back()[i];
    without_.push_back(invert_symmetric(others, n, kFlat).inverse);
    std::vector<double> own = in_scale(one.score);
    const std::vector<double> moved = product(information_.back(), step_, n);
    for (std::size_t k = 0; k < n; ++k) own[k] += moved[k];
    std::vector<double> way = in_scale(product(without_.back(), own, n));
    for (double& value : way) value *= std::sqrt((count - 1) / count);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) covariance_[i * n + k] += way[i] * way[k];
    ways_.push_back(std::move(way));
  }
  step_ = in_scale(std::move(step_));
}

double Jackknife::half(std::size_t first, std::span<const double> weights, double beyond) const {
  double variance = 0;
  for (std::size_t i = 0; i < weights.size(); ++i)
    for (std::size_t k = 0; k < weights.size(); ++k)
      variance += weights[i] * weights[k] * covariance_[(first + i) * n_ + first + k];
  return students_t_quantile(degrees(first, weights), 1 - beyond) * std::sqrt(variance);
}

double Jackknife::half_of_difference(const Jackknife& other, std::size_t k, double beyond) const {
  const double one[] = {1};
  double variance = 0;
  for (std::size_t b = 0; b < ways_.size(); ++b)
    variance += std::pow(ways_[b][k] - other.ways_[b][k], 2);
  const double fewer = std::min(degrees(k, one), other.degrees(k, one));
  return students_t_quantile(fewer, 1 - beyond) * std::sqrt(variance);
}

double Jackknife::degrees(std::size_t first, std::span<const double> weights) const {
  std::vector<double> sum(n_);
  for (std::size_t k = 0; k < weights.size(); ++k) sum[first + k] = scale_[first + k] * weights[k];

  // The covariance of what the blocks add to the sum, were what is left white.
  const std::size_t count = information_.size();
  std::vector<std::vector<double>> tells, spread;
  std::vector<double> own;
  for (std::size_t b = 0; b < count; ++b) {
    const std::vector<double> along = product(without_[b], sum, n_);
    tells.push_back(product(information_[b], along, n_));
    spread.push_back(product(all_, tells.back(), n_));
    own.push_back(std::inner_product(along.begin(), along.end(), tells.back().begin(), 0.0));
  }
  double trace = 0, squares = 0;
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b) {
      const double one =
          (a == b ? own[a] : 0) -
          std::inner_product(tells[a].begin(), tells[a].end(), spread[b].begin(), 0.0);
      squares += one * one;
      if (a == b) trace += one;
    }
  return squares > 0 ? std::max(1.0, trace * trace / squares) : 1;
}

}  // namespace dashpot
