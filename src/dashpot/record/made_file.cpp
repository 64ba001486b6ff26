#include "dashpot/record/made_file.h"

#include <unistd.h>

#include "dashpot/base/child_process.h"
#include "dashpot/base/data_folder.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/stored_arrays.h"

namespace dashpot {

std::string made_file(const std::string& how, std::string_view request) {
  HandingChild child({own_program("dashpot-hdf5").string(), how, "-", std::to_string(getpid())});
  child.give(request);
  std::string bytes;
  const auto take = [&](void* to, std::size_t count) { return child.take(to, count); };
  char more;
  if (take_stored_file(take, bytes) && child.take(&more, 1) == 0) return bytes;

  const ChildStatus end = child.wait();
  throw Error("dashpot-hdf5",
              "did not make the file: it ended " +
                  (end.signal != 0 ? "by signal " + std::to_string(end.signal)
                                   : "with status " + std::to_string(end.exit_status)),
              "install Dashpot anew, if it does so again");
}

}  // namespace dashpot
