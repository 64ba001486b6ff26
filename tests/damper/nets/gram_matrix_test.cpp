#include "dashpot/damper/nets/gram_matrix.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "dashpot/base/random.h"
#include "dashpot/damper/nets/kernel.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Products of columns over `count` rows of `step` numbers, one by one.
std::vector<double> products_of(const std::vector<double>& rows, std::size_t step) {
  std::vector<double> products(step * step);
  for (std::size_t r = 0; r < rows.size(); r += step)
    for (std::size_t i = 0; i < step; ++i)
      for (std::size_t j = 0; j < step; ++j) products[i * step + j] += rows[r + i] * rows[r + j];
  return products;
}

double furthest(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

}  // namespace

TEST_CASE("Gram matrix: every level adds the products of columns to what stands there") {
  Random random(3);
  for (const std::size_t columns : {8, 16, 24, 40, 104, 256})
    for (const std::size_t count : {0, 1, 7, 128}) {
      std::vector<double> rows(columns * count), room(columns * kGramStrip);
      for (double& value : rows) value = random.uniform(-1, 1);
      const std::vector<double> right = products_of(rows, columns);
      for (const SimdLevel level : simd_levels()) {
        CAPTURE(columns);
        CAPTURE(count);
        CAPTURE(name_of(level));
        std::vector<double> gram(columns * columns, 1.0);
        jacobian_kernel(level).add_gram({rows.data(), count, columns}, gram.data(), room.data());
        double worst = 0;
        for (std::size_t i = 0; i < columns; ++i)
          for (std::size_t j = i; j < columns; ++j) {
            const std::size_t at = i * columns + j;
            worst = std::max(worst, std::abs(gram[at] - 1 - right[at]));
          }
        CHECK(worst < 1e-13);
      }
    }
}

TEST_CASE("Gram matrix: rows in groups, whose offsets take their share") {
  constexpr std::size_t kColumns = 11, kSizes[] = {300, 40, 0};  // more than a block, less, none
  constexpr double kCentring = 0.002;
  Random random(5);
  GramMatrix gram(kColumns);
  std::vector<double> right(kColumns * kColumns);
  for (const std::size_t size : kSizes) {
    std::vector<double> rows(size * kColumns), sums(kColumns);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      rows[k] = random.uniform(-1, 1);
      sums[k % kColumns] += rows[k];
    }
    for (std::size_t k = 0; k < size; ++k) std::copy_n(&rows[k * kColumns], kColumns, gram.row());
    CHECK(furthest(gram.end_group(kCentring), sums) < 1e-12);

    const std::vector<double> products = products_of(rows, kColumns);
    for (std::size_t i = 0; i < kColumns; ++i)
      for (std::size_t j = 0; j < kColumns; ++j)
        right[i * kColumns + j] += products[i * kColumns + j] - kCentring * sums[i] * sums[j];
  }
  CHECK(furthest(gram.matrix(), right) < 1e-11);
}
