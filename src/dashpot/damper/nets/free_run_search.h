#pragma once
#include <functional>
#include <vector>

namespace dashpot {

/// A small solver for least squares over records that a model runs through freely. It is
/// self-contained: who uses it brings a function that runs the model and hands over one row per
/// scored sample, and the solver never sees a record, a model or a derivative of its own.
///
/// With n unknowns x and, for sample s of record k, the output's derivatives J_s (n numbers) and
/// the residual r_s, both standardised, it minimises
///
///   (1 / samples) sum over s of (r_s + o_k)^2
///     + sum over i of decay_i (x_i - anchor_i)^2
///     + (1 / samples) sum over k of offset_decay (samples of k) o_k^2
///     + sum over p of r_p^2
///
/// The last sum is over penalties, terms that belong to no sample: what a model costs beside its
/// errors.
///
/// The offsets o_k, one per record, are linear and are eliminated exactly: the columns of [J r] are
/// centred per record (not quite wholly, by offset_decay), so that no offset is an unknown. Only
/// the Gram matrix of [J r], (n + 1) x (n + 1), is kept; memory does not grow with the recordings.

/// Takes the scored samples of a free run, record by record.
class RowSink {
 public:
  virtual ~RowSink() = default;
  /// Room for the next sample, n + 1 numbers to be filled: the output's derivatives by the
  /// unknowns, then the residual, output less target. Valid until the next call.
  virtual double* row() = 0;
  /// The samples since the last call belong to one record and share its offset.
  virtual void end_record() = 0;
  /// A penalty: n + 1 numbers as a row, whose square is one more term of the cost, whatever the
  /// number of samples; without an offset.
  virtual void add_penalty(const std::vector<double>& row) = 0;
};

/// The problem. `start`, `decay` and `anchors` have one number per unknown. All weights of
/// penalties are relative to the mean squared residual, so that they do not depend on the number of
/// samples.
struct FreeRunProblem {
  std::vector<double> start;
  std::vector<double> decay;    ///< weight of each unknown's squared distance from its anchor
  std::vector<double> anchors;  ///< the values that the penalty pulls towards
  /// Runs all records with these unknowns and fills the sink. Called once per step that is tried.
  std::function<void(const std::vector<double>& unknowns, RowSink& sink)> linearise;
};

struct FreeRunSearchOptions {
  int max_iterations = 100;
  double tolerance = 1e-4;     ///< stop when the cost falls by less than this share over 3 steps
  bool offsets = true;         ///< one free offset per record, eliminated exactly
  double offset_decay = 1e-3;  ///< weight of a record's squared offset, per sample of it
  std::function<void(double cost)> on_iteration;  ///< before each step; may throw to stop
};

struct FreeRunSearchResult {
  std::vector<double> unknowns;
  std::vector<double> offsets;        ///< of the records, standardised
  std::vector<double> half_gradient;  ///< of the cost, by the unknowns
  double cost = 0;
  double rms = 0;  ///< standardised, offsets removed
  bool converged = false;
  int iterations = 0;
};

/// Levenberg-Marquardt; damping scaled by the diagonal, its growth after refused steps as in
/// Nielsen (1999). The same bits for the same input. With max_iterations = 0: cost and gradient at
/// the start. Throws nothing of its own; what the callbacks throw comes out.
FreeRunSearchResult search(const FreeRunProblem& problem, const FreeRunSearchOptions& options);

}  // namespace dashpot
