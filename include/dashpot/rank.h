// Layer: identify
#pragma once

// The whole judgement of models on a dataset: each is fitted on every fold, judged on the records
// left out of it, fitted once more on all, and put in order. The model of each is ready to be
// saved.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/evaluate.h"
#include "dashpot/identify.h"
#include "dashpot/model_file.h"
#include "dashpot/split.h"

namespace dashpot {

class FitStore;
struct Part;
struct PartReport;

/// How many times a model's ESR is that of another one, typical of a left-out unit: the geometric
/// mean over the units that both were judged on.
struct PairedRatio {
  double times = 1;
  double low = 1, high = 1;  ///< its 90 % interval
  std::size_t units = 0;     ///< that it comes from
  /// Whether the units show that the model is worse.
  bool is_worse() const { return low > 1; }
};

/// A figure, the median of what it may be, with its 90 % interval.
struct Estimate {
  double value = 0, low = 0, high = 0;
};

/// How far the ride of a model will lie from that of the damper, as far as the recordings tell
/// (machine/ride_rank.h). Worst tyre, worst strut.
struct PredictedRide {
  std::string refusal;  ///< why nothing is predicted; the figures then say nothing

  /// %, root mean square of the three that follow, each over its rms in the damper's ride: what
  /// models are ranked by.
  Estimate error;
  /// rms over time of the difference between the two rides: of the body's acceleration weighted by
  /// Wk, m/s^2; of the tyre load over the static one, %; of the strut's travel, mm.
  Estimate acceleration, tyre_load, travel;
  /// By how much the rms of these is greater in the model's ride.
  Estimate acceleration_excess, tyre_load_excess, travel_excess;
  std::vector<std::string> warnings = {};  ///< of the model's own ride
};

/// The ride that all models of a ranking went through.
struct RiddenThrough {
  std::string vehicle, road, controller;  ///< no controller: "1 A"
  double duration = 0;                    ///< s
  /// The model that, with its errors on left-out records, stood for the damper, and what these
  /// leave unexplained, N.
  std::string known_by;
  double unexplained = 0;
  std::size_t draws = 0;  ///< of such errors
};

/// What a law's final fit leaves on its own records: what information criteria are made of.
struct FitLikelihood {
  std::size_t samples = 0;        ///< scored ones of all records
  double squares = 0;             ///< N^2, sum of the squared residuals
  double correlation_length = 1;  ///< samples in a row that count as one
  std::size_t parameters = 0;     ///< free numbers, force zeros of records and the variance
};

/// One model, fitted on all records and judged on those that its fits had not seen.
struct RankedModel {
  std::string name, title;
  FitReport fit;  ///< on all records: the model that is saved
  /// Of `fit` on all its records. Curves only of those that are not judged as left out.
  Evaluation training;
  /// Of `fit` on further recordings (validate()), which no fit has seen; empty where there are
  /// none.
  Evaluation validation;
  std::optional<FitLikelihood> likelihood;  ///< of a law that was fitted by it alone
  std::vector<FitReport> fold_fits;
  /// Of a single fold: fits on parts of its training, for the interval.
  std::vector<FitReport> held_back_fits;
  Evaluation left_out;              ///< the folds' models, each on its left-out records, pooled
  std::optional<ForceBand> band;    ///< 90 % interval around the force of `fit`: conformal.h
  double seconds = 0;               ///< CPU time of all its fits
  double nanoseconds_per_step = 0;  ///< cost of advance + force, measured
  StressRun stress;                 ///< the final model, beyond its domain
  Forgetting forgetting;            ///< the final model, over its training records
  Dissipation dissipation;          ///< the final model, within its domain
  /// %, what each unit (Ranking::unit) adds to the pooled ESR; empty where a record diverged.
  std::vector<double> esr_parts;
  std::optional<PairedRatio> over_first;  ///< none for the first model itself
  /// Where the models were ridden: whoever rode them states it here.
  std::optional<PredictedRide> ride;
};
/// Fitted, and finite on every left-out record.
bool is_usable(const RankedModel& model);
/// Usable, it forgets the state in which it began, and it feeds no energy into what moves it: what
/// may be called best.
bool is_recommendable(const RankedModel& model);

/// A model that a budget of time left untried.
struct UntriedModel {
  std::string name, title;
  double minutes = 0;         ///< that its fits would take on two cores, estimated
  double budget_minutes = 0;  ///< the least whole budget that tries it too
};
/// What the models that nobody named one by one were chosen by.
struct FitBudget {
  double minutes = 0;           ///< on two cores; 0: no limit
  double expected_minutes = 0;  ///< of those that it chose, estimated
  std::string too_small_for;    ///< the one model that was tried though the budget allows none
  std::vector<UntriedModel> untried;  ///< in the order in which larger budgets try them
};

/// Of what moves between load cell and damper, taken off the force of all records.
struct FoundInertia {
  double mass = 0;               ///< kg
  std::string model;             ///< the one whose errors on left-out records showed it
  double before = 0, after = 0;  ///< N, its RMSE on these records
};

/// Models in order of their error on left-out records.
struct Ranking {
  LeaveOut leave_out;
  std::vector<std::string> folds;  ///< their names
  /// Best first, by left-out ESR with offsets; then those that do not forget or feed energy in,
  /// then those that diverged, then failed ones.
  std::vector<RankedModel> models;
  std::string unit;  ///< over which models are compared: "division", "block" ...
  /// Of a model that was fitted elsewhere: how many of the records its fit has seen.
  std::optional<std::size_t> seen;
  /// Where models were chosen within a budget: whoever chose them states it here.
  std::optional<FitBudget> budget;
  std::optional<RiddenThrough> ridden;  ///< where the models were ridden, likewise
  std::optional<FoundInertia> inertia;  ///< by rank_without_inertia()
  std::string validated_on;             ///< the further recordings of validate(); empty: none
  std::size_t kept_fits = 0;            ///< found in the store
  double wall_seconds = 0;              ///< from the first fit to the last figure

  /// The models that may be called best: the first, and those that are not shown to be worse, in
  /// their order. One: the winner. None: no model can be recommended.
  std::vector<const RankedModel*> leaders() const;
  /// The models whose ride is predicted, the least error first.
  std::vector<const RankedModel*> by_ride() const;
};

/// Cross-validates each model over the folds of the split and ranks them. Without training roles,
/// `fit` uses all records; with Roles or Fraction it uses the training part. With a store, fits
/// that it holds are not made again, and new ones are kept as they end. The interval of a fold
/// comes from the other folds' errors; where there is one fold, from further fits, each with a part
/// of its training held back.
Ranking rank(const std::vector<std::string>& models, const Dataset& dataset,
             const LeaveOut& leave_out, const IdentifyOptions& options, FitStore* store = nullptr);
/// As rank(). Where the errors of the best model follow the acceleration, the inertia that would
/// make them do so is taken off the forces of `dataset`, with a note in each record, and all models
/// are ranked once more: provided that this leaves the best one a tenth less squared error, and
/// less on most records.
Ranking rank_without_inertia(const std::vector<std::string>& models, Dataset& dataset,
                             const LeaveOut& leave_out, const IdentifyOptions& options,
                             FitStore* store = nullptr);
/// Throws Error where the further recordings share a file with those of the fit, or have another
/// drive: what validate() cannot use, told before any fit.
void require_further(const Dataset& further, const Dataset& fitted);
/// Judges the final model of each on further recordings, with its interval: fills `validation`. A
/// model that they cannot serve gets a warning that says why.
void validate(Ranking& ranking, const Dataset& further, const IdentifyOptions& options);
/// Makes and keeps the fits of one part of that ranking (base/part.h), and judges nothing: once all
/// parts lie in one store, rank() finds its fits there.
PartReport rank_part(const std::vector<std::string>& models, const Dataset& dataset,
                     const LeaveOut& leave_out, const IdentifyOptions& options, FitStore& store,
                     const Part& part);

/// The origin of a model that this command made from these records of the dataset.
Provenance provenance_of(const Dataset& dataset, std::vector<std::string> records,
                         const std::string& command);
/// How many records of a dataset a model's fit has seen: those of its training records' names,
/// where the datasets share a file by its SHA-256.
std::size_t seen_records(const Provenance& provenance, const Dataset& dataset);
/// The ranked model as a file, with domain and provenance taken from the records. Throws Error when
/// the fit failed.
ModelFile to_model_file(const RankedModel& ranked, const Dataset& dataset,
                        const std::string& command);

}  // namespace dashpot
