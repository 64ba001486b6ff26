// Layer: identify
#pragma once

// Fitting one model to records. identify() takes a model's name and gives a FitReport with the
// model, its parameters and their intervals; rank() in rank.h does it for several models and judges
// them on records that they have not seen.

#include <memory>
#include <string>
#include <vector>

#include "dashpot/drive.h"
#include "dashpot/evaluate.h"
#include "dashpot/fit_choices.h"
#include "dashpot/model_file.h"
#include "dashpot/monitor.h"

namespace dashpot {

/// How identify() fits a model. The same options and data give the same bits for any `threads`.
struct IdentifyOptions {
  OffsetMode offset = OffsetMode::Record;
  std::vector<ParameterChoice> choices;  ///< laws only
  bool allow_active = false;             ///< keep a fit that feeds energy into motions
  bool asymmetric = false;  ///< laws only: take rebound and compression apart where that pays
  NetworkDesign network;    ///< networks only
  int starts = 4;           ///< of which the best is taken
  int search = 0;           ///< evaluations of a global search that gives one more start; 0: none
  /// Laws, also within hybrids: models of the same law, whose numbers are the first start of its
  /// fit; with `starts` = 1 and no `search` the only one.
  std::vector<std::shared_ptr<const DamperModel>> from = {};
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as the machine has
  Monitor monitor;
  /// May be empty. The parameters of a law as they are at this step of its fit: the monitor's
  /// stage, names and values in SI. Called from several threads.
  std::function<void(const std::string& stage,
                     const std::vector<std::pair<std::string, double>>& parameters)>
      on_parameters = {};
};

/// A fitted parameter with its 95 % interval. Networks and fuzzy models have none.
struct FittedParameter {
  std::string name, unit, meaning;
  double value = 0;
  double low = 0, high = 0;  ///< 95 % interval; equal to value when fixed
  bool fixed = false;
  bool at_bound = false;
  bool weak = false;  ///< cannot be told from these data; the message says with what
};

/// The outcome of a fit. Where it failed there is no model, and `message` says why.
struct FitReport {
  enum class Status { Converged, IterationLimit, Failed };
  Status status = Status::Failed;
  std::string message;
  std::shared_ptr<const DamperModel> model;  ///< with the mean record offset as its bias
  std::vector<FittedParameter> parameters;
  /// Of the parameters in their order and units, row by row; zeros for fixed ones; empty where the
  /// fit has none: networks, hybrids and families.
  std::vector<double> covariance = {};
  /// N, per training record, beyond the model's bias.
  std::vector<std::pair<std::string, double>> offsets;
  std::vector<std::string> warnings;  ///< identifiability, bounds, divergence, in words
  int iterations = 0;
  double seconds = 0;        ///< CPU time
  double training_rmse = 0;  ///< N, free run
};

/// Fits the model of that name (a law, or a preset of a network or fuzzy model) to all records
/// together in free run. Throws Error when the records cannot serve (a channel missing, no motion).
/// Not converging is a status.
FitReport identify(const std::string& model, const std::vector<Record>& training,
                   DriveUnit drive_unit, const IdentifyOptions& options);

}  // namespace dashpot
