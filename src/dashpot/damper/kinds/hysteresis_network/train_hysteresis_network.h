#pragma once
#include <functional>
#include <vector>

#include "dashpot/damper/kinds/hysteresis_network/hysteresis_network_model.h"
#include "dashpot/damper/nets/activity_penalty.h"
#include "dashpot/damper/nets/free_run_record.h"

namespace dashpot {

/// All penalties are per sample, in standardised units: a residual of the size of the data's scale
/// costs 1.
struct HysteresisNetworkTrainOptions {
  int max_iterations = 100;
  double tolerance = 1e-4;     ///< stop when the cost falls by less than this share over 3 steps
  double weight_decay = 1e-4;  ///< on squared weights of neurons and gates
  double rate_decay = 1e-6;    ///< on squared moves of the rates' logarithms
  double offset_decay = 1e-3;  ///< as TrainOptions::offset_decay
  bool offsets = true;         ///< one free offset per record, a declared nuisance
  std::size_t stride = 1;      ///< score every stride-th sample; the states see all
  const ActivityPenalty* penalty = nullptr;  ///< of energy fed into motions; none: nothing is paid
  std::function<void(double cost)> on_iteration;  ///< may throw to stop
};

/// Levenberg-Marquardt over weights and logarithms of rates together, in free run over whole
/// records, the offsets eliminated exactly; their mean goes into the model. Nothing feeds back, so
/// the states' derivatives by their rates, brought along with the states, make the Jacobian exact.
/// Starts from the model's rates and weights; its ranges of signals become those of the records.
/// The same bits for the same input.
FreeRunTrainReport train(HysteresisNetwork& model, const std::vector<const FreeRunRecord*>& records,
                         const HysteresisNetworkTrainOptions& options);

/// Cost of train() at the model, and half its gradient by ln rates, weights of neurons and of
/// gates.
FreeRunCost hysteresis_network_cost(const HysteresisNetwork& model,
                                    const std::vector<const FreeRunRecord*>& records,
                                    const HysteresisNetworkTrainOptions& options);

/// Sum of a record's squared errors over its scored samples, N^2, less their mean when `offset`.
double squares_left(const HysteresisNetwork& model, const FreeRunRecord& record, bool offset);

}  // namespace dashpot
