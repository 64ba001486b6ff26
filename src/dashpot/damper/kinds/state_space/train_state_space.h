#pragma once
#include <functional>
#include <vector>

#include "dashpot/damper/kinds/state_space/state_space_model.h"
#include "dashpot/damper/nets/activity_penalty.h"
#include "dashpot/damper/nets/free_run_record.h"

namespace dashpot {

/// Penalties as in HysteresisNetworkTrainOptions.
struct StateSpaceTrainOptions {
  int max_iterations = 100;
  double tolerance = 1e-4;
  double weight_decay = 1e-4;  ///< on squared weights of neurons, feedback and gates
  double rate_decay = 1e-6;    ///< on squared moves of the rates' logarithms
  double offset_decay = 1e-3;
  bool offsets = true;
  std::size_t stride = 1;
  /// Samples of a window; 0: whole records. A window starts where an encoder puts the states, which
  /// is learnt along and then dropped: tanh (paths) or a straight line (lags) of the currents and
  /// of velocity and force at a few past moments.
  std::size_t window = 0;
  std::size_t most_steps = 12000;            ///< of all windows: every k-th is taken
  const ActivityPenalty* penalty = nullptr;  ///< as HysteresisNetworkTrainOptions::penalty
  std::function<void(double cost)> on_iteration;
};

/// Levenberg-Marquardt over cell and network together, in free run over windows or, from rest, over
/// whole records; derivatives of the states are brought along, so that the Jacobian is exact.
/// Offsets of records as for a bank of states. The same bits for the same input.
FreeRunTrainReport train(StateSpaceNetwork& model, const std::vector<const FreeRunRecord*>& records,
                         const StateSpaceTrainOptions& options);

/// Cost of train(), and half its gradient by the unknowns: the cell's parameters, the encoder's
/// weights, neurons and gates. At the start of train() when `unknowns` is empty.
FreeRunCost state_space_cost(const StateSpaceNetwork& model,
                             const std::vector<const FreeRunRecord*>& records,
                             const StateSpaceTrainOptions& options,
                             const std::vector<double>& unknowns = {});

/// Sum of a record's squared errors over its scored samples, N^2, less their mean when `offset`.
double squares_left(const StateSpaceNetwork& model, const FreeRunRecord& record, bool offset);

}  // namespace dashpot
