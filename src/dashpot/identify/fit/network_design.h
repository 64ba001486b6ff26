#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/damper/nets/activation.h"
#include "dashpot/damper/nets/train_batches.h"

namespace dashpot {

/// How a network learns: second-order on all samples, or descent on small batches.
enum class Trainer { LevenbergMarquardt, Bayesian, Lbfgs, Sgd, Momentum, RmsProp, Adam, AdamW };

/// What a network with fed-back outputs sees of them while it learns: the measured force, or its
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
  std::optional<Schedule::Kind> schedule;
  std::optional<std::size_t> batch;
  std::optional<std::size_t> epochs;  ///< or iterations of a second-order trainer, at most
  std::optional<double> l1,
      l2;  ///< prices of weights, standardised, the mean squared error being 1
  std::optional<std::size_t>
      patience;  ///< epochs without gain on held-back training records; 0: to the end
  std::optional<std::size_t> members;   ///< networks whose mean is the model
  std::optional<std::size_t> delays;    ///< past samples of each input
  std::optional<std::size_t> feedback;  ///< past outputs fed back
  std::optional<std::size_t> spacing;   ///< samples from one past value to the next
  std::optional<FeedbackTraining> training;
  std::optional<std::size_t>
      window;  ///< steps in free run from a measured force on; 0: whole records
  std::optional<OutputRange> output;

  bool operator==(const NetworkDesign&) const = default;
};

/// One row of the table from which help, parsing, formatting and searches read.
struct NetworkSetting {
  std::string_view name, meaning;
  std::string_view value;  ///< what a value looks like: "15-15-15", "tanh, relu, ...", "1e-3"
  /// Throws Error(where, ...) at a value that cannot be.
  void (*parse)(std::string_view text, const std::string& where, NetworkDesign& design);
  std::string (*format)(const NetworkDesign& design);  ///< empty where nothing is set
};
std::span<const NetworkSetting> network_settings();
/// Throws Error(where, "unknown setting ...") that names the known ones.
const NetworkSetting& find_network_setting(std::string_view name, const std::string& where);

/// "hidden=15-15" into `design`; `option` stands in messages. Throws Error.
void parse_network_setting(std::string_view text, const std::string& option, NetworkDesign& design);
/// "hidden=15-15,activation=relu": what is set, in the order of the table; reads back as the same
/// design.
std::string format_design(const NetworkDesign& design);

/// Whether a trainer descends on mini-batches.
bool trains_on_batches(Trainer trainer);
/// Whether a setting makes a difference to training by `trainer`.
bool has_use(Trainer trainer, std::string_view setting);
/// The word for it: "lm", "adam".
std::string_view name_of(Trainer trainer);

/// Throws Error when something is set that the trainer (the usual one where none is named) does not
/// use.
void require_trainer(const NetworkDesign& design, Trainer usual = Trainer::LevenbergMarquardt);

}  // namespace dashpot
