#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dashpot/damper/kinds/law/law_expression.h"
#include "dashpot/damper/law.h"

namespace dashpot {

/// Equations as a list of operations on numbered registers, which one loop works through. What
/// depends on parameters alone is computed when these change, not at every step. Immutable; runs
/// in registers of the calling thread, allocates nothing. docs/decisions/021 says why this form.
class LawProgram {
 public:
  /// Values that are computed together from the same inputs.
  struct Piece {
    std::size_t first = 0, last = 0;     ///< its operations
    std::vector<std::uint16_t> outputs;  ///< the registers of its values
  };

  /// For a law of so many parameters and states, the first numbers of the arrays given later.
  LawProgram(const LawNodes& nodes, std::size_t parameters, std::size_t states);

  /// Adds the operations for these nodes; their values come in this order. All pieces are added
  /// before the first run.
  Piece add(std::span<const std::uint16_t> outputs);
  /// Adds a whole step of classical Runge-Kutta (c_text/law_runge_kutta.h, operation by operation)
  /// for states with these rates, while the parameters stay.
  Piece add_step(std::span<const std::uint16_t> rates);

  /// The registers of this thread with these parameters in them.
  double* registers(const double* p) const;
  /// The values of a piece at x, v and the states; `travel` is the displacement for a closed form.
  void run(const Piece& piece, double* registers, double x, double v, const double* z,
           double travel = 0) const;
  /// Brings the states over a step of length h, with x and v at its start, middle and end.
  void step(const Piece& piece, double* registers, const double* x, const double* v, double h,
            double* z) const;

 private:
  struct Operation {
    LawOp op;
    std::uint16_t to, a, b, c;
  };
  class Compiler;
  std::vector<bool> moving() const;  ///< which nodes follow from a state
  Piece finished(Piece piece, const Compiler& compiler);
  static void work(const Operation* from, const Operation* end, double* r);

  const LawNodes& nodes_;
  std::size_t parameters_, states_;
  std::uint64_t id_;                   ///< of no other program, in all of this process
  std::vector<double> constants_;      ///< the first registers
  std::vector<std::uint16_t> places_;  ///< registers of constants, parameters and inputs, by node
  std::vector<Operation> operations_, of_parameters_;
  std::size_t first_parameter_ = 0, first_input_ = 0, first_free_ = 0;
};

}  // namespace dashpot
