#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/suspension/sweep/draw.h"
#include "dashpot/suspension/sweep/store.h"

namespace dashpot {

/// Makes vehicles of a request and drives them over their roads, some at a time. Immutable once
/// made.
class SweepRider {
 public:
  /// Tries every controller with the first vehicle. Throws Error at unknown words and at parts that
  /// do not fit together. The request must outlive the rider.
  explicit SweepRider(const SweepRequest& request);

  /// One ride: places of controller and vehicle in the request.
  struct Task {
    std::size_t controller, vehicle;
  };
  /// One result per task, which does not depend on the other tasks.
  std::vector<SweepStore::Ride> ride(const std::vector<Task>& tasks, const Monitor& monitor) const;

  const std::vector<std::string>& notes() const { return notes_; }
  /// What drives the dampers; none: the controllers' differ. A where nothing does.
  std::optional<DriveUnit> drive() const;
  /// What the vehicle stands on, as foot_of(): "tyre", "seat"; empty of a building.
  std::string foot() const;

 private:
  Vehicle make(const Task& task, const SweepDraw& draw) const;

  const SweepRequest& request_;
  std::vector<Vehicle> examples_;  ///< one per controller: the first vehicle
  std::vector<std::string> notes_;
};

}  // namespace dashpot
