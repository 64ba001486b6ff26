#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "dashpot/base/store.h"
#include "dashpot/suspension/sweep/measures.h"
#include "dashpot/suspension/sweep/request.h"

namespace dashpot {

/// Rides of one sweep in a file, each block of them written as it ends. Further samples and further
/// controllers of the same sweep go into the same file. Safe from several threads.
class SweepStore {
 public:
  static constexpr StoreFormat kFormat{"sweep", 2, "begin anew with --fresh"};

  /// Opens the file or makes it, as Store does: a file of another sweep is refused, naming what
  /// differs. program: differs from one build of the program to the next.
  SweepStore(const std::filesystem::path& path, const SweepRequest& request,
             const std::string& program);

  struct Ride {
    std::size_t controller, vehicle;  ///< places in the request
    RideMeasures measures;
  };
  /// The kept rides of this request, in the order of vehicles. Rides that cannot be read are not
  /// among them.
  std::vector<Ride> load() const;
  /// Keeps all of them or, when it throws, none. Throws Error when the disk cannot take them.
  void save(const std::vector<Ride>& rides);
  std::size_t dropped() const { return store_.dropped(); }  ///< as Store has it
  Store& store() { return store_; }                         ///< for farm_out()

 private:
  std::vector<std::string> keys_;  ///< one per controller: a hash of everything that defines it
  std::size_t vehicles_;
  Store store_;
};

}  // namespace dashpot
