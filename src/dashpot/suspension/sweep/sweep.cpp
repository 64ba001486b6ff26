#include "dashpot/suspension/sweep/sweep.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>

#include "dashpot/base/parallel.h"
#include "dashpot/base/task_farm.h"
#include "dashpot/suspension/sweep/rides.h"

namespace dashpot {
namespace {

// Vehicles that ride and are kept together, under all controllers: enough to fill the lanes, few
// enough that a kill loses little.
constexpr std::size_t kBlock = 32;

using Tasks = std::vector<SweepRider::Task>;

/// Whether a ride is there, by controller and vehicle.
using There = std::vector<std::vector<char>>;

/// The rides of a block that are not there yet.
Tasks block_of(const There& there, std::size_t block) {
  Tasks tasks;
  const std::size_t first = block * kBlock, vehicles = there.front().size();
  for (std::size_t c = 0; c < there.size(); ++c)
    for (std::size_t k = first; k < std::min(first + kBlock, vehicles); ++k)
      if (!there[c][k]) tasks.push_back({c, k});
  return tasks;
}

/// The numbers of a part's blocks in which rides are missing.
std::vector<std::size_t> blocks_of(const There& there, const Part& part) {
  std::vector<std::size_t> blocks;
  for (std::size_t block = 0; block * kBlock < there.front().size(); ++block)
    if (part.has(block) && !block_of(there, block).empty()) blocks.push_back(block);
  return blocks;
}

/// Counts rides as they end.
class Tally {
 public:
  /// `all` of which `ended` have ended.
  Tally(std::size_t ended, std::size_t all, const Monitor& monitor)
      : monitor_(monitor), ended_(ended), all_(all) {}
  void add(std::size_t rides) {
    const std::lock_guard lock(guard_);
    ended_ += rides;
    monitor_.report(std::to_string(ended_) + " of " + std::to_string(all_) + " rides",
                    static_cast<double>(ended_) / static_cast<double>(all_));
  }

 private:
  const Monitor& monitor_;
  std::size_t ended_, all_;
  std::mutex guard_;
};

/// Rides what is missing of a block, keeps it as it ends and gives it to `take`.
void ride_block(const There& there, std::size_t block, const SweepRider& rider, SweepStore& store,
                const SweepOptions& options, Tally& tally,
                const std::function<void(const SweepStore::Ride&)>& take) {
  options.monitor.check();
  const std::vector<SweepStore::Ride> rides = rider.ride(block_of(there, block), options.monitor);
  store.save(rides);
  for (const SweepStore::Ride& ride : rides) take(ride);
  tally.add(rides.size());
}

}  // namespace

Sweep sweep(const SweepRequest& request, SweepStore& store, const SweepOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  Sweep result{.request = request};
  const std::size_t vehicles = request.vehicles(), controllers = request.controllers.size();
  for (std::size_t k = 0; k < vehicles; ++k) result.vehicles.push_back(draw_vehicle(request, k));

  // Whatever does not fit together is reported before anything rides.
  const SweepRider rider(request);
  result.notes = rider.notes();
  result.drive = rider.drive();
  result.foot = rider.foot();

  // Take over the rides that are kept.
  result.rides.assign(controllers, std::vector<RideMeasures>(vehicles));
  There there(controllers, std::vector<char>(vehicles));
  for (const SweepStore::Ride& ride : store.load()) {
    result.rides[ride.controller][ride.vehicle] = ride.measures;
    there[ride.controller][ride.vehicle] = 1;
    ++result.kept;
  }

  // Ride the others, block by block.
  Tally tally(result.kept, result.ride_count(), options.monitor);
  const std::vector<std::size_t> blocks = blocks_of(there, Part());
  parallel_for(blocks.size(), options.threads, [&](std::size_t b) {
    ride_block(there, blocks[b], rider, store, options, tally, [&](const SweepStore::Ride& ride) {
      result.rides[ride.controller][ride.vehicle] = ride.measures;
    });
  });

  result.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

PartReport sweep_part(const SweepRequest& request, SweepStore& store, const SweepOptions& options,
                      const Part& part) {
  const std::size_t vehicles = request.vehicles(), controllers = request.controllers.size();
  const SweepRider rider(request);

  // The blocks of the part, before and after those that are kept are taken away.
  There there(controllers, std::vector<char>(vehicles));
  const std::size_t all = blocks_of(there, Part()).size(), tasks = blocks_of(there, part).size();
  for (const SweepStore::Ride& ride : store.load()) there[ride.controller][ride.vehicle] = 1;
  const std::vector<std::size_t> blocks = blocks_of(there, part);

  // A worker of mpirun does not see the store: it is told by rank 0 which blocks are missing.
  std::size_t rides = 0;
  for (const std::size_t block : blocks) rides += block_of(there, block).size();
  Tally tally(0, rides, options.monitor);
  const FarmReport farm =
      farm_out(blocks, options.threads, store.store(), std::to_string(all), [&](std::size_t block) {
        ride_block(there, block, rider, store, options, tally, [](const SweepStore::Ride&) {});
      });
  return {
      .tasks = tasks, .all = all, .kept = tasks - blocks.size(), .wall_seconds = farm.wall_seconds};
}

}  // namespace dashpot
