#pragma once
#include <string>
#include <vector>

#include "dashpot/identify/fit/network_design.h"

// The models of the one-sensor study: the paper's networks, those that it compares itself with, and
// the network that answers it.
namespace dashpot {

/// Keys of the models whose forces the figures show: the paper's network, and the hysteresis
/// network.
inline constexpr const char* kStatic = "one-sensor";
inline constexpr const char* kHysteresis = "hysteresis";

/// A model of the study and the design of its network; tables find it by its key.
struct StudiedModel {
  std::string key, title;
  std::string model;  ///< of the registry
  NetworkDesign design;
  bool example_only = false;  ///< only on the damper's example
};
/// All models of the study; each key once.
std::vector<StudiedModel> one_sensor_models();

}  // namespace dashpot
