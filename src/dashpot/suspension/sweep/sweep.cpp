#include "dashpot/suspension/sweep/sweep.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>

#include "dashpot/base/parallel.h"
#include "dashpot/suspension/sweep/rides.h"

namespace dashpot {
namespace {

// Vehicles that ride and are kept together, under all controllers: enough to fill the lanes, few
// enough that a kill loses little.
constexpr std::size_t kBlock = 32;

using Tasks = std::vector<SweepRider::Task>;

/// The rides that are not there yet.
std::vector<Tasks> blocks_of(const std::vector<std::vector<char>>& there) {
  std::vector<Tasks> blocks;
  const std::size_t vehicles = there.front().size();
  for (std::size_t first = 0; first < vehicles; first += kBlock) {
    Tasks tasks;
    for (std::size_t c = 0; c < there.size(); ++c)
      for (std::size_t k = first; k < std::min(first + kBlock, vehicles); ++k)
        if (!there[c][k]) tasks.push_back({c, k});
    if (!tasks.empty()) blocks.push_back(std::move(tasks));
  }
  return blocks;
}

/// Counts rides as they end.
class Tally {
 public:
  Tally(const Sweep& sweep, const Monitor& monitor)
      : monitor_(monitor), ended_(sweep.kept), all_(sweep.ride_count()) {}
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

}  // namespace

Sweep sweep(const SweepRequest& request, SweepStore& store, const SweepOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  Sweep result{.request = request};
  const std::size_t vehicles = request.vehicles(), controllers = request.controllers.size();
  for (std::size_t k = 0; k < vehicles; ++k) result.vehicles.push_back(draw_vehicle(request, k));

  // Whatever does not fit together is reported before anything rides.
  const SweepRider rider(request);
  result.notes = rider.notes();

  // Take over the rides that are kept.
  result.rides.assign(controllers, std::vector<RideMeasures>(vehicles));
  std::vector<std::vector<char>> there(controllers, std::vector<char>(vehicles));
  for (const SweepStore::Ride& ride : store.load()) {
    result.rides[ride.controller][ride.vehicle] = ride.measures;
    there[ride.controller][ride.vehicle] = 1;
    ++result.kept;
  }

  // Ride the others, block by block.
  const std::vector<Tasks> blocks = blocks_of(there);
  Tally tally(result, options.monitor);
  parallel_for(blocks.size(), options.threads, [&](std::size_t b) {
    options.monitor.check();
    const std::vector<SweepStore::Ride> rides = rider.ride(blocks[b], options.monitor);
    store.save(rides);
    for (const SweepStore::Ride& ride : rides)
      result.rides[ride.controller][ride.vehicle] = ride.measures;
    tally.add(rides.size());
  });

  result.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace dashpot
