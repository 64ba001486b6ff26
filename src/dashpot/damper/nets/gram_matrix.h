#pragma once
#include <cstddef>
#include <vector>

#include "dashpot/damper/nets/aligned.h"

namespace dashpot {

/// X'X of rows that are handed over one by one, for normal equations, less what the free offset of
/// each group of rows takes out of it. Rows are collected in a block, so that the kernel multiplies
/// matrices and the memory does not grow with the rows.
class GramMatrix {
 public:
  explicit GramMatrix(std::size_t columns);
  /// Room for the next row, `columns` numbers. Valid until the next call.
  double* row();
  /// Ends a group of rows with the column sums s, which are returned: its offset takes
  /// centring s s' out of the matrix.
  std::vector<double> end_group(double centring);
  /// Of all groups that have ended, columns x columns.
  std::vector<double> matrix() const;

 private:
  void flush();

  std::size_t columns_, step_;  ///< step_: from row to row, with zeros behind the columns
  AlignedVector<double> block_, room_;
  std::size_t filled_ = 0;          ///< rows of the block
  AlignedVector<double> products_;  ///< step x step, the upper triangle
  std::vector<double> sums_;        ///< of the columns over this group
};

}  // namespace dashpot
