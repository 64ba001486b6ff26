#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/dataset.h"
#include "dashpot/drive.h"
#include "dashpot/monitor.h"
#include "dashpot/split.h"
#include "studies/one_sensor/one_sensor_fit.h"

namespace dashpot {

class FitStore;

/// A damper of the study, and how its recordings are divided into what models learn from and what
/// judges them.
struct StudiedDamper {
  std::string name;         ///< "MR1"
  std::string description;  ///< a sentence
  bool is_virtual = false;
  DriveUnit drive_unit = DriveUnit::Ampere;
  /// The paper's, each recorded twice; of other data the divisions, of which each leaves something
  /// out.
  std::vector<Fold> experiments;
  /// Experiments that make the example, by index (the paper's is experiment 2 of MR1); may be none.
  std::vector<std::size_t> example;

  /// Half of the span of all forces that models are judged on, N: what the paper's percentages
  /// refer to.
  double half_span() const;
  /// True when every record has a displacement.
  bool has_displacement() const;
};

/// The paper's two dampers, which exist here in the computer alone, on its bench and in its
/// experiments. Each experiment is recorded twice: models learn from the first recording and are
/// judged on the second.
std::vector<StudiedDamper> virtual_dampers(std::uint64_t seed);
/// Any recordings. Tables that the paper makes of one experiment are made of all divisions
/// together. Throws Error where the data set cannot be divided so.
StudiedDamper measured_damper(const Dataset& dataset, const LeaveOut& leave_out);

/// Networks of one size, cross-validated.
struct StudiedSize {
  std::size_t neurons = 0, parameters = 0;
  double error = 0;             ///< N, rms over all folds
  std::vector<double> by_fold;  ///< N, rms
};

/// A damper with its results.
struct DamperStudy {
  StudiedDamper damper;
  std::vector<std::vector<std::optional<StudiedResult>>> results;  ///< by model, by experiment
  std::vector<StudiedSize> sizes;                                  ///< of the example
};

/// Everything that the tables and figures show.
struct OneSensorStudy {
  std::vector<StudiedModel> models;
  std::vector<DamperStudy> dampers;
  std::size_t kept_fits = 0;  ///< found in the store
  double seconds = 0;         ///< CPU time of all fits, those kept from before too

  const StudiedModel& model(const std::string& key) const;  ///< the key must be known
  /// nullptr where the model was not fitted: it needs a displacement, say, or the damper has no
  /// example.
  const StudiedResult* result(std::size_t damper, const std::string& key,
                              std::size_t experiment) const;
  /// Results pooled over the experiments of the damper's example, or over all; nothing where one is
  /// missing.
  std::optional<StudiedResult> example(std::size_t damper, const std::string& key) const;
  std::optional<StudiedResult> all(std::size_t damper, const std::string& key) const;
};

/// How the study is run.
struct OneSensorOptions {
  std::uint64_t seed = 1;
  int threads = 0;
  std::size_t most_neurons = 20;  ///< of the size choice
  std::vector<std::string> keys;  ///< of the models to fit; empty: all
  FitStore* store = nullptr;      ///< keeps finished fits, not owned; none: nothing is kept
  Monitor monitor;
};

/// Fits and judges everything that the tables and figures ask for. The same bits on any number of
/// threads. Throws Interrupted when stopped; what the store holds by then is not made again.
OneSensorStudy study_one_sensor(std::vector<StudiedDamper> dampers,
                                const OneSensorOptions& options);

/// The smallest network whose cross-validated error is within 2 % of the least: the paper's
/// "minimal dimensions". 0 without sizes.
std::size_t smallest_sufficient(const std::vector<StudiedSize>& sizes);

}  // namespace dashpot
