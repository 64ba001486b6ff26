#pragma once
#include <functional>
#include <vector>

namespace dashpot {

/// Takes the scored samples of a free run, record by record.
class RowSink {
 public:
  virtual ~RowSink() = default;
  /// Where the next sample goes: the output's derivatives by the unknowns, then the residual. Valid
  /// until the next call.
  virtual double* row() = 0;
  /// The samples since the last call belong to one record and share its offset.
  virtual void end_record() = 0;
};

/// Least squares over records run freely; all prices are per sample, residuals standardised.
struct FreeRunProblem {
  std::vector<double> start;
  std::vector<double> prices;  ///< of squared distances from the anchors
  std::vector<double> anchors;
  std::function<void(const std::vector<double>& unknowns, RowSink& sink)> linearise;
};

struct FreeRunSearchOptions {
  int max_iterations = 100;
  double tolerance = 1e-4;     ///< stop when the cost falls by less than this share over 3 steps
  bool offsets = true;         ///< one free offset per record, eliminated exactly
  double offset_decay = 1e-3;  ///< price of a record's squared offset
  std::function<void()> on_iteration;  ///< may throw to stop
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

/// Levenberg-Marquardt with damping after Nielsen (1999), scaled by the diagonal. The same bits for
/// the same input. No iteration: cost and gradient at the start.
FreeRunSearchResult search(const FreeRunProblem& problem, const FreeRunSearchOptions& options);

}  // namespace dashpot
