#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "dashpot/damper/nets/mlp.h"
#include "dashpot/evaluate.h"
#include "dashpot/monitor.h"
#include "studies/family/family_samples.h"

namespace dashpot {

/// The build and training of a network of the family study: ReLU layers, Adam, the mean squared
/// error.
struct FamilyRule {
  std::vector<std::size_t> hidden{15, 15, 15};
  /// Raw: as the authors' code does it, in the units of its input vector (m, m^2, Pa*s, kPa, m/s,
  /// mm), the force in N, all first weights drawn from a normal distribution of variance 1.
  enum class Inputs { Standardised, Raw };
  Inputs inputs = Inputs::Standardised;
  double rate = 1e-2;       ///< step size of Adam, at first
  std::size_t batch = 100;  ///< samples
  int epochs = 500;
  bool falls = true;  ///< the rate, along a cosine to 0; else it is constant
  /// Weight decay: l2 |w|^2 / 2 is added to the mean squared error (standardised, or N^2).
  double l2 = 0;
};

/// "h3x15", the paper's name for layers of one width; else "15-10".
std::string architecture_name(const std::vector<std::size_t>& hidden);
/// The whole rule as text, for people and as a key of the training store.
std::string describe(const FamilyRule& rule);

/// A network and how its training went.
struct StudiedNetwork {
  Mlp mlp;
  std::vector<double> history;  ///< N, rms error met in each epoch
  double seconds = 0;           ///< CPU time
};

/// The network before it is trained: scales of the samples, no parameters.
StudiedNetwork untrained_network(const FamilyRule& rule, const TrainingSamples& samples);
/// The same bits for the same input. Throws Interrupted when stopped.
StudiedNetwork train_family_network(const FamilyRule& rule, const TrainingSamples& samples,
                                    std::uint64_t seed, const Monitor& monitor);

/// The network's forces at the samples with these indices, N.
std::vector<double> forces_at(const Mlp& mlp, const TrainingSamples& samples,
                              const std::vector<std::size_t>& indices);
/// Errors of such forces against the measured ones of the same samples.
ErrorSums errors_at(const TrainingSamples& samples, const std::vector<std::size_t>& indices,
                    const std::vector<double>& forces);

}  // namespace dashpot
