#pragma once
#include <array>
#include <cstddef>

namespace dashpot {

/// A matrix of a size known when compiled, row by row on the stack: for recursions that multiply
/// millions of them. Sizes that do not fit do not compile.
template <std::size_t Rows, std::size_t Columns>
struct SmallMatrix {
  std::array<double, Rows * Columns> values{};

  double& operator()(std::size_t row, std::size_t column) { return values[row * Columns + column]; }
  double operator()(std::size_t row, std::size_t column) const {
    return values[row * Columns + column];
  }
};

template <std::size_t Rows, std::size_t Columns>
SmallMatrix<Rows, Columns> operator+(SmallMatrix<Rows, Columns> a,
                                     const SmallMatrix<Rows, Columns>& b) {
  for (std::size_t k = 0; k < a.values.size(); ++k) a.values[k] += b.values[k];
  return a;
}

template <std::size_t Rows, std::size_t Columns>
SmallMatrix<Rows, Columns> operator*(double factor, SmallMatrix<Rows, Columns> a) {
  for (double& value : a.values) value *= factor;
  return a;
}

template <std::size_t Rows, std::size_t Inner, std::size_t Columns>
SmallMatrix<Rows, Columns> operator*(const SmallMatrix<Rows, Inner>& a,
                                     const SmallMatrix<Inner, Columns>& b) {
  SmallMatrix<Rows, Columns> product;
  for (std::size_t i = 0; i < Rows; ++i)
    for (std::size_t k = 0; k < Inner; ++k)
      for (std::size_t j = 0; j < Columns; ++j) product(i, j) += a(i, k) * b(k, j);
  return product;
}

template <std::size_t Rows, std::size_t Columns>
SmallMatrix<Columns, Rows> transposed(const SmallMatrix<Rows, Columns>& a) {
  SmallMatrix<Columns, Rows> turned;
  for (std::size_t i = 0; i < Rows; ++i)
    for (std::size_t j = 0; j < Columns; ++j) turned(j, i) = a(i, j);
  return turned;
}

/// The inverse of a regular matrix; one that is singular gives numbers that are not finite.
inline SmallMatrix<2, 2> inverse(const SmallMatrix<2, 2>& a) {
  const double scale = 1 / (a(0, 0) * a(1, 1) - a(1, 0) * a(0, 1));
  return {{a(1, 1) * scale, -a(0, 1) * scale, -a(1, 0) * scale, a(0, 0) * scale}};
}

/// matrix += weight (a'b + b'a) / 2 for rows a and b: the form weight (a.x)(b.x).
template <std::size_t Size>
void add_product(SmallMatrix<Size, Size>& matrix, double weight, const SmallMatrix<1, Size>& a,
                 const SmallMatrix<1, Size>& b) {
  for (std::size_t i = 0; i < Size; ++i)
    for (std::size_t j = 0; j < Size; ++j)
      matrix(i, j) += 0.5 * weight * (a(0, i) * b(0, j) + b(0, i) * a(0, j));
}

/// The same where b is the unit row of `place`: the form weight (a.x) x[place].
template <std::size_t Size>
void add_product(SmallMatrix<Size, Size>& matrix, double weight, const SmallMatrix<1, Size>& a,
                 std::size_t place) {
  matrix(place, place) += weight * a(0, place);
  for (std::size_t i = 0; i < Size; ++i) {
    if (i == place) continue;
    matrix(i, place) += 0.5 * weight * a(0, i);
    matrix(place, i) += 0.5 * weight * a(0, i);
  }
}

}  // namespace dashpot
