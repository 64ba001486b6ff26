#pragma once
#include <string>
#include <vector>

#include "dashpot/damper_model.h"

namespace dashpot {

/// The signals that a network reads: present and past values of some inputs, and its own past
/// forces. Lags count steps of `sample_time`.
struct Regressors {
  static constexpr std::size_t kMostLag = 1000;

  struct Input {
    std::string name;               ///< "displacement", "velocity" or "current"
    std::vector<std::size_t> lags;  ///< 0: the present value
    std::size_t depth() const;      ///< the largest lag
  };
  std::vector<Input> inputs;
  std::vector<std::size_t> feedback;  ///< lags of the force, from 1 on; empty: nothing feeds back
  double sample_time = 0;             ///< s

  /// Present values and `delays` past ones of each input; the last `fed_back` forces.
  static Regressors of(const std::vector<std::string>& inputs, std::size_t delays,
                       std::size_t fed_back, double sample_time);

  std::size_t input_count() const;  ///< of the network's inputs, those that are no force
  std::size_t count() const { return input_count() + feedback.size(); }
  std::size_t feedback_depth() const;
  std::size_t depth() const;  ///< steps that the past reaches back
  bool needs_displacement() const;
};

/// Throws Error(where, ...) where there is no such network.
void require_usable(const Regressors& regressors, const std::string& where);

/// A row of network inputs per instant of a uniform grid of step sample_time, from the depth-th on:
/// the inputs in their order, each with its lags in theirs, then the fed-back forces, measured.
std::vector<double> regressor_rows(const Regressors& regressors,
                                   const std::vector<DamperInput>& inputs,
                                   const std::vector<double>& force);

Value to_json(const Regressors& regressors);
/// Reads what to_json wrote; it is still to be checked.
Regressors read_regressors(const Value& value);

}  // namespace dashpot
