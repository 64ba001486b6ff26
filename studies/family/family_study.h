#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "studies/family/family_network.h"

namespace dashpot {

class TrainingStore;

/// How samples are divided among learning and judging.
enum class FamilyProtocol {
  AllSamples,
  FixedDamper,
  EachDamper,
  RandomSamples,
  Geometries,
  Fluids
};
/// The divisions of a protocol; for the same samples always the same.
std::vector<FamilyDivision> divisions_of(const FamilySamples& family, FamilyProtocol protocol);

/// Networks of one rule under one protocol, from several seeds.
struct FamilyExperiment {
  FamilyProtocol protocol = FamilyProtocol::AllSamples;
  FamilyRule rule;
  std::size_t seeds = 10;
};

/// The paper's rule as it prints it, the one in its authors' code, and ours.
FamilyRule printed_rule(std::vector<std::size_t> hidden);
FamilyRule authors_rule(std::vector<std::size_t> hidden);
FamilyRule own_rule(std::vector<std::size_t> hidden);
/// Ours for one damper, which has fewer samples and is passed over more often.
FamilyRule own_single_rule(std::vector<std::size_t> hidden);

/// Rows and columns of the study's tables.
const std::vector<std::vector<std::size_t>>& single_architectures();   ///< of figure 8
const std::vector<std::vector<std::size_t>>& family_architectures();   ///< of figure 9
const std::vector<std::vector<std::size_t>>& history_architectures();  ///< of figure 12
const std::vector<std::vector<std::size_t>>& judged_architectures();   ///< on what was left out
inline constexpr std::array kStudiedPenalties{0.0, 1e-4, 1e-3, 1e-2, 3e-2, 1e-1};
inline constexpr std::array kStudiedRates{1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2};
inline constexpr std::array<std::size_t, 4> kStudiedBatches{20, 50, 100, 200};
std::vector<std::size_t> chosen_architecture();  ///< the paper's: h3x15
FamilyRule penalised_rule(double l2);
FamilyRule grid_rule(bool is_own, double rate, std::size_t batch);

/// All that the tables and figures ask for. `seeds`: of the experiments on all samples; half of
/// them where something is left out, three at most of large networks and in grids.
std::vector<FamilyExperiment> family_experiments(std::size_t seeds);

/// The networks of an experiment and their errors; it points into the study's networks.
struct FamilyOutcome {
  FamilyExperiment experiment;
  std::vector<std::vector<const StudiedNetwork*>> networks;  ///< by seed, by division
  std::vector<ErrorSums> by_seed;                            ///< over the divisions
  std::vector<std::vector<ErrorSums>> by_division;           ///< by division, by seed
  ErrorSums together;                                        ///< of the mean of all seeds' forces
  double seconds = 0;                                        ///< CPU time of all trainings

  /// The seed with the median of the mean absolute errors; of an even number the better middle one.
  std::size_t median_seed() const;
};

/// Median, least and greatest over seeds.
struct Spread {
  double median = 0, low = 0, high = 0;
};
Spread mae_of(const std::vector<ErrorSums>& seeds);  ///< N
Spread r2_of(const std::vector<ErrorSums>& seeds);

/// A law that reads neither geometry nor fluid, fitted for all dampers: what a family's model has
/// to beat, as it has to beat kSimplestFamily.
constexpr std::string_view kBlindLaw = "tanh_kwok", kSimplestFamily = "family_line";

/// A model of the registry beside the networks: it learns from the same samples, which its records
/// run up to, and is judged on the same.
struct FamilyModelOutcome {
  std::string name;
  ErrorSums learnt;              ///< on the samples that it learnt from
  ErrorSums geometries, fluids;  ///< on those that were left out in turn
};

/// Its outcomes point into its networks: it can be moved, not copied.
struct FamilyStudy {
  FamilyStudy() = default;
  FamilyStudy(FamilyStudy&&) = default;
  FamilyStudy& operator=(FamilyStudy&&) = default;

  FamilySamples family;
  std::deque<StudiedNetwork> networks;
  std::vector<FamilyOutcome> outcomes;
  std::vector<FamilyModelOutcome> models;
  std::size_t kept = 0;  ///< trainings found in the store
  double seconds = 0;    ///< CPU time of all trainings, those kept from before too
  double effort = 1;     ///< share of each rule's epochs that was trained

  /// nullptr when there was no such experiment.
  const FamilyOutcome* outcome(FamilyProtocol protocol, const FamilyRule& rule) const;
};

struct FamilyStudyOptions {
  double effort = 1;  ///< share of each rule's epochs
  int threads = 0;
  TrainingStore* store = nullptr;   ///< where finished trainings are found and kept
  std::vector<std::string> models;  ///< of the registry, to stand beside
  Monitor monitor;
};

/// Trains and judges every experiment; what two of them share is trained once. The same bits on any
/// number of threads. Throws Interrupted when stopped; what the store holds by then is not made
/// again.
FamilyStudy study_family(FamilySamples family, const std::vector<FamilyExperiment>& experiments,
                         const FamilyStudyOptions& options);

/// Fits and judges options.models; none where the records state no current.
std::vector<FamilyModelOutcome> judge_family_models(const FamilySamples& family,
                                                    const FamilyStudyOptions& options);

}  // namespace dashpot
