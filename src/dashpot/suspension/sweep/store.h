#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "dashpot/base/result_file.h"
#include "dashpot/suspension/sweep/measures.h"
#include "dashpot/suspension/sweep/request.h"

namespace dashpot {

/// Rides of a sweep in one file, each block of them written as it ends. Further samples and further
/// controllers of the same sweep go into the same file. Safe from several threads.
class SweepStore {
 public:
  /// program: what tells one build of the program from the next. Throws Error when the file holds
  /// another sweep, naming what differs.
  SweepStore(const std::filesystem::path& path, const SweepRequest& request,
             const std::string& program);
  /// Throws away what the file holds. Throws Error when it is in use.
  static void remove(const std::filesystem::path& path);

  struct Ride {
    std::size_t controller, vehicle;  ///< places in the request
    RideMeasures measures;
  };
  /// Those of this request, in the order of vehicles, then controllers.
  std::vector<Ride> load() const;
  /// All or none of them; what is there already stays. Throws Error when the disk cannot take them.
  void save(const std::vector<Ride>& rides);

 private:
  std::vector<std::string> keys_;  ///< one per controller: all that tells it from others
  std::size_t vehicles_;
  ResultFile file_;
};

}  // namespace dashpot
