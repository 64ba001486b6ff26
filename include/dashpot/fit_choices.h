// Layer: damper
#pragma once

// A user's choices about a fit: parameters of a law that are fixed, freed, bounded or known
// beforehand, and how a network is built and trained. What stays empty is as the law's table or the
// preset has it. SI.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dashpot {

/// How a parameter depends on the coil current i. The polynomials stand in the order of their
/// degree:
///   Constant p_a;  Linear p_a + p_b i;  Quadratic ... + p_c i^2;  Cubic ... + p_d i^3;
///   Exponential p_b + (p_a - p_b) exp(-p_c i): from p_a without current to p_b in saturation.
enum class Form { Constant, Linear, Quadratic, Cubic, Exponential };

/// Knowledge of a parameter before the fit: a normal distribution, at every current.
struct Prior {
  double value = 0, deviation = 0;  ///< SI
};

struct ParameterBounds {
  double lower = 0, upper = 0;  ///< SI
};

/// A user's decision about one parameter of a fit.
struct ParameterChoice {
  std::string law;  ///< the law or hybrid meant; empty: every one that has the parameter
  std::string parameter;
  std::optional<Form> form;
  std::optional<double> fixed;  ///< SI
  bool free = false;            ///< estimated, though the table keeps it fixed
  std::optional<ParameterBounds> bounds;
  std::optional<Prior> prior;
};

/// The function that a neuron applies to its sum.
enum class Activation : std::uint8_t { Identity, Relu, Tanh, Sigmoid };

/// How the learning rate of batch trainers falls over the epochs.
enum class RateSchedule { Constant, Step, Cosine };

/// How a network learns: second-order on all samples, or descent on small batches.
enum class Trainer { LevenbergMarquardt, Bayesian, Lbfgs, Sgd, Momentum, RmsProp, Adam, AdamW };

/// The force that a network with fed-back outputs sees while it learns: the measured one, or its
/// own as in use.
enum class FeedbackTraining { SeriesParallel, FreeRun };

/// Whether a network's force is held within a range around that of its training records.
enum class OutputRange { Linear, Bounded };

/// How networks are built and trained where that differs from what their preset says; what is empty
/// stays as it is there.
struct NetworkDesign {
  std::vector<std::size_t> hidden;  ///< neurons per hidden layer
  std::optional<Activation> activation;
  std::optional<Trainer> trainer;
  std::optional<double> rate;  ///< of batch trainers, as schedule, batch and l1
  std::optional<RateSchedule> schedule;
  std::optional<std::size_t> batch;
  std::optional<std::size_t> epochs;  ///< or iterations of a second-order trainer, at most
  /// Weight decay by size and by square, standardised, the mean squared error being 1.
  std::optional<double> l1, l2;
  /// Epochs without gain on held-back training records after which training stops; 0: to the end.
  std::optional<std::size_t> patience;
  std::optional<std::size_t> members;   ///< networks whose mean is the model
  std::optional<std::size_t> delays;    ///< past samples of each input
  std::optional<std::size_t> feedback;  ///< past outputs fed back
  std::optional<std::size_t> spacing;   ///< samples from one past value to the next
  std::optional<FeedbackTraining> training;
  /// Steps in free run from a measured force on; 0: whole records.
  std::optional<std::size_t> window;
  std::optional<OutputRange> output;

  bool operator==(const NetworkDesign&) const = default;
};

}  // namespace dashpot
