#include "dashpot/damper/nets/gram_matrix.h"

#include <utility>

#include "dashpot/damper/nets/kernel.h"

namespace dashpot {
namespace {

constexpr std::size_t kBlockRows = 128;  // that stay in the second-level cache

/// An odd number of cache lines, so that rows do not push each other out of the cache.
std::size_t step_of(std::size_t columns) { return padded<double>(columns) | padded<double>(1); }

}  // namespace

GramMatrix::GramMatrix(std::size_t columns)
    : columns_(columns),
      step_(step_of(columns)),
      block_(step_ * kBlockRows),
      room_(step_ * kGramStrip),
      products_(step_ * step_),
      sums_(columns) {}

double* GramMatrix::row() {
  if (filled_ == kBlockRows) flush();
  return &block_[step_ * filled_++];
}

std::vector<double> GramMatrix::end_group(double centring) {
  flush();
  for (std::size_t i = 0; i < columns_; ++i) {
    const double share = centring * sums_[i];
    for (std::size_t j = i; j < columns_; ++j) products_[i * step_ + j] -= share * sums_[j];
  }
  return std::exchange(sums_, std::vector<double>(columns_));
}

std::vector<double> GramMatrix::matrix() const {
  std::vector<double> matrix(columns_ * columns_);
  for (std::size_t i = 0; i < columns_; ++i)
    for (std::size_t j = i; j < columns_; ++j)
      matrix[i * columns_ + j] = matrix[j * columns_ + i] = products_[i * step_ + j];
  return matrix;
}

void GramMatrix::flush() {
  jacobian_kernel(simd_levels().back())
      .add_gram({block_.data(), filled_, step_}, products_.data(), room_.data());
  for (std::size_t k = 0; k < filled_; ++k)
    for (std::size_t i = 0; i < columns_; ++i) sums_[i] += block_[k * step_ + i];
  filled_ = 0;
}

}  // namespace dashpot
