#pragma once
#include <functional>
#include <vector>

#include "dashpot/damper/neural/state_space_model.h"
#include "dashpot/damper/neural/train_bank.h"

namespace dashpot {

/// Gives the states that a window of a record starts from: tanh (paths) or a straight line (lags) of the
/// velocity, the currents, and the force and velocity of a few past moments. Needed to learn from windows
/// only: a damper is at rest when a simulation begins.
struct StateEncoder {
  std::vector<double> weights;  ///< a row per motion state

  static constexpr std::size_t kMoments = 4;
  static constexpr double kSpacing = 0.01;  ///< s between them
};

/// Prices as in BankTrainOptions.
struct StateSpaceTrainOptions {
  int max_iterations = 100;
  double tolerance = 1e-4;
  double weight_decay = 1e-4;  ///< on squared weights of neurons, feedback and gates
  double rate_decay = 1e-6;    ///< on squared moves of the rates' logarithms
  double offset_decay = 1e-3;
  bool offsets = true;
  std::size_t stride = 1;
  /// Samples of a window, each run freely from where the encoder puts it; 0: whole records, from rest.
  std::size_t window = 0;
  std::size_t most_steps = 12000;  ///< of all windows: every k-th is taken
  std::function<void()> on_iteration;
};

/// Levenberg-Marquardt over cell and network together, in free run over whole records from rest; derivatives
/// of the states are brought along, so that the Jacobian is exact.
BankTrainReport train(StateSpaceNetwork& model, const std::vector<const BankRecord*>& records,
                      const StateSpaceTrainOptions& options);

/// Cost of train() at the model, and half its gradient by the cell's parameters, neurons and gates.
BankCost state_space_cost(const StateSpaceNetwork& model, const std::vector<const BankRecord*>& records,
                          const StateSpaceTrainOptions& options);

/// What a model leaves of a record's scored samples, N^2, their mean taken out first when `offset`.
double squares_left(const StateSpaceNetwork& model, const BankRecord& record, bool offset);

}  // namespace dashpot
