#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "dashpot/damper/kinds/passive_network/passive_network.h"
#include "dashpot/damper/nets/free_run_record.h"

namespace dashpot {

/// How a passive network learns: descent (AdamW, the learning rate falling as a cosine) on windows
/// that start anywhere in the records, each run freely from rest, gradients through time.
struct PassiveTrainOptions {
  std::size_t updates = 1600;
  std::size_t windows = 32;  ///< of an update: in whole blocks of the processor's lanes
  std::size_t window = 256,
              run_in = 64;  ///< samples of the network's step; the run-in is not scored
  double rate = 1e-2;
  double weight_decay = 0;  ///< of the networks' weights on what they see
  double blind_share = 0;   ///< of the windows, in which networks do not read the drive
  bool offsets = true;      ///< one free force offset per record
  std::uint64_t seed = 1;
  std::function<void()> on_update;  ///< may throw to stop
};

/// The records' motion, drive and force once per `step` s, averaged over it; standardised by the
/// network's scales when it trains.
std::vector<FreeRunRecord> at_step(const std::vector<const FreeRunRecord*>& records, double step);

/// Numbers to start from: springs that yield on the ways of 0.4 s to 4 ms at the velocity's scale.
/// Scales must be set.
void initialise(PassiveNetwork& network, std::uint64_t seed);

/// Trains on records that at_step() made for network.model_step. The same bits for the same input
/// and instruction set.
FreeRunTrainReport train(PassiveNetwork& network, const std::vector<const FreeRunRecord*>& records,
                         const PassiveTrainOptions& options);

/// The sum of weighted squared errors over windows of the records, standardised, and its gradient
/// by PassiveNetwork::numbers; for tests. The windows are those of the first update.
FreeRunCost passive_cost(const PassiveNetwork& network,
                         const std::vector<const FreeRunRecord*>& records,
                         const PassiveTrainOptions& options);

/// Which of these networks (places, ascending) answer unlike all others to the records' motions at
/// half and at twice their speed: five times as far from the nearest other as is usual among them,
/// and by a twentieth of their force scale. None of one or two.
std::vector<std::size_t> stray_members(const std::vector<PassiveNetwork>& networks,
                                       const std::vector<const FreeRunRecord*>& records);

/// Sum of a record's squared errors over its scored samples, N^2, less their mean when `offset`.
double squares_left(const PassiveNetwork& network, const FreeRunRecord& record, bool offset);

}  // namespace dashpot
