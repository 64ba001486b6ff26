#pragma once
#include <glog/logging.h>

namespace dashpot {

/// Ceres warns on stderr of what reports say anyway. Called before it is used; only the first call
/// of the process writes, since glog's threshold is a plain number that its threads read.
inline void quiet_ceres() {
  [[maybe_unused]] static const bool is_quiet = [] {
    FLAGS_minloglevel = google::GLOG_FATAL;
    return true;
  }();
}

}  // namespace dashpot
