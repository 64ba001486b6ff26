#pragma once
#include "dashpot/damper/nets/simd/multiply.h"

namespace dashpot {
namespace {

/// See JacobianKernel::add_gram.
void add_gram(const GramRows& rows, double* gram, double* room) noexcept {
  for (std::size_t a = 0; a < rows.columns; a += kGramStrip) {
    // A strip of the product, from the diagonal to the right.
    const std::size_t left = rows.columns - a, height = left < kGramStrip ? left : kGramStrip;
    const double* from = rows.at + a;
    multiply<Form::Sum, double>(
        height, left / kLanes<double>,
        {rows.count, {from, 1, rows.columns}, {from, rows.columns}, {room, left}});

    double* to = gram + a * rows.columns + a;
    for (std::size_t i = 0; i < height; ++i, to += rows.columns)
      for (std::size_t j = 0; j < left; j += kLanes<double>)
        store(to + j, load(to + j) + load(room + i * left + j));
  }
}

/// See JacobianKernel::carry.
void carry(std::size_t count, std::size_t columns, const double* by, std::size_t by_step,
           const double* from, double* to) noexcept {
  multiply<Form::Sum, double>(count, columns / kLanes<double>,
                              {count, {by, by_step, 1}, {from, columns}, {to, columns}});
}

}  // namespace
}  // namespace dashpot
