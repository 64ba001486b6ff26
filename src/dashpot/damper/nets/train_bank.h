#pragma once
#include <functional>
#include <vector>

#include "dashpot/damper/kinds/hysteresis_network/hysteresis_network.h"

namespace dashpot {

/// What a bank of states and the network that reads it are trained on: one record.
struct BankRecord {
  std::vector<DamperInput> inputs;
  std::vector<double> time, force;
  std::size_t first = 0;  ///< scored from here on; what comes before is run through
};

/// All prices are per sample, in standardised units: a residual of the size of the data's scale
/// costs 1.
struct BankTrainOptions {
  int max_iterations = 100;
  double tolerance = 1e-4;     ///< stop when the cost falls by less than this share over 3 steps
  double weight_decay = 1e-4;  ///< on squared weights of neurons and gates
  double rate_decay = 1e-6;    ///< on squared moves of the rates' logarithms
  double offset_decay = 1e-3;  ///< as TrainOptions::offset_decay
  bool offsets = true;         ///< one free offset per record, a declared nuisance
  std::size_t stride = 1;      ///< score every stride-th sample; the states see all
  std::function<void()> on_iteration;  ///< may throw to stop
};

struct BankTrainReport {
  bool converged = false;
  int iterations = 0;
  double rmse = 0;  ///< raw units, offsets removed
};

/// Levenberg-Marquardt over weights and logarithms of rates together, in free run over whole
/// records, the offsets eliminated exactly; their mean goes into the model. Nothing feeds back, so
/// the states' derivatives by their rates, brought along with the states, make the Jacobian exact.
/// Starts from the model's rates and weights; its ranges of signals become those of the records.
/// The same bits for the same input.
BankTrainReport train(BankNetwork& model, const std::vector<const BankRecord*>& records,
                      const BankTrainOptions& options);

/// Cost of train() at the model, and half its gradient by ln rates, weights of neurons and of
/// gates.
struct BankCost {
  double cost = 0;
  std::vector<double> gradient;
};
BankCost bank_cost(const BankNetwork& model, const std::vector<const BankRecord*>& records,
                   const BankTrainOptions& options);

/// What a model leaves of a record's scored samples, N^2, their mean taken out first when `offset`.
double squares_left(const BankNetwork& model, const BankRecord& record, bool offset);

}  // namespace dashpot
