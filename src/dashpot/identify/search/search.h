#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/base/part.h"
#include "dashpot/identify.h"
#include "dashpot/identify/search/search_space.h"
#include "dashpot/identify/search/trial_store.h"

// Search of the settings with which a network best predicts records that it has not seen.
namespace dashpot {

/// Halving: many designs at little effort; the best third goes on with three times as much, and so
/// on. Jamieson and Talwalkar 2016 (AISTATS); the factor of three as in Li et al. 2018 (Hyperband,
/// JMLR 18).
enum class SearchMethod { Grid, Random, Halving };
/// The effort that halving saves at first: it trains on the first part of every training record, or
/// for fewer epochs.
enum class SearchEffort { Samples, Epochs };

struct SearchOptions {
  std::string model = "mlp_one_sensor";
  SearchSpace space;
  SearchMethod method = SearchMethod::Random;
  std::size_t trials = 24;  ///< designs to draw; a grid has its own number
  std::size_t steps = 4;    ///< values of a range on a grid
  SearchEffort effort =
      SearchEffort::Samples;  ///< of halving; Epochs asks for `epochs` in space.fixed
  IdentifyOptions fit;        ///< of every fit; its network is not used
};

/// A round of trials; all but halving have one.
struct Rung {
  std::size_t trials = 0;
  double share = 1;  ///< of the full effort
};
/// The rounds of a search. Halving goes from many trials with a share of 1/27 at least to three or
/// more with all: 27, 9 and 3 trials with 1/9, 1/3 and all. Throws Error when the options cannot be
/// used: a space that the model does not follow, halving of fewer than 9 trials, or by epochs
/// without their number.
std::vector<Rung> search_rungs(const SearchOptions& options);

/// A design, judged by cross-validation.
struct Trial {
  NetworkDesign design;
  std::size_t rung = 0;           ///< the last that it took part in
  std::vector<FoldResult> folds;  ///< of that rung
  std::size_t kept = 0;           ///< of them, found in the store
  // Over all folds together:
  Metrics left_out;           ///< all left-out samples
  double standard_error = 0;  ///< %, of the mean over the folds' ESR; not a number with one fold
  double worst_esr = 0;       ///< %, worst left-out record
  std::size_t parameters = 0;
  std::size_t diverged = 0;  ///< left-out records
  double seconds = 0;        ///< CPU time of its fits at that rung
  std::string failure;       ///< of the first fold that has no model; empty: none
  bool on_front = false;     ///< no finalist is better with as few parameters

  bool is_usable() const;  ///< fitted, and finite on every left-out record
};

/// Best first: those of later rungs before others, by ESR, then by parameters; then those that
/// diverged, then those that have no model.
void sort_trials(std::vector<Trial>& trials);

struct SearchReport {
  SearchOptions options;
  LeaveOut leave_out;
  std::vector<std::string> folds;
  std::vector<Rung> rungs;
  std::vector<Trial> trials;          ///< best first, as sort_trials has them
  std::size_t kept = 0, results = 0;  ///< fold results, found in the store and in all
  double wall_seconds = 0;

  bool is_finalist(const Trial& trial) const;  ///< usable, and judged with the full effort
  const Trial* best() const;                   ///< none when no trial is usable
  /// The finalist with the fewest parameters whose ESR is within one standard error of the best's
  /// (Breiman et al. 1984); the best where there is one fold.
  const Trial* smallest() const;
};

/// All that the results of a search depend on beyond design, share and fold: the basis of
/// its store. program: tells one build from the next. The number of trials is none of it: more of
/// them go on.
NamedTexts describe_search(const Dataset& dataset, const LeaveOut& leave_out,
                           const SearchOptions& options, const std::string& program);

/// Called when all folds of a trial are there, from one thread at a time.
using OnTrial = std::function<void(const Trial&, const SearchReport&)>;

/// Judges every design on the folds of `rank`, in free run. The same report, times aside, whatever
/// the number of threads, the order of the work and the results that the store held. Seeds come
/// from the designs. Throws Error when the space or the dataset cannot be used; a fit that fails is
/// a failed trial.
SearchReport search(const Dataset& dataset, const LeaveOut& leave_out, const SearchOptions& options,
                    TrialStore* store = nullptr, const OnTrial& on_trial = {});

/// Makes and keeps the results of one part of that search, and judges nothing: once all parts lie
/// in one store, search() finds its results there. Throws Error for a part of a halving.
PartReport search_part(const Dataset& dataset, const LeaveOut& leave_out,
                       const SearchOptions& options, TrialStore& store, const Part& part);

/// As the fits of this design were made: its network and seed in place.
IdentifyOptions options_of(const NetworkDesign& design, const SearchOptions& options);

}  // namespace dashpot
