#include "dashpot/damper/kinds/hysteresis_network/presets.h"

#include <array>

namespace dashpot {
namespace {

constexpr std::array<HysteresisNetworkPreset, 1> kHysteresisPresets{{
    {.name = "hysteresis_network",
     .title = "Hysteresis-bank network, one sensor",
     .equation = "F = mean of members of  sum_j (sum_k G_jk c_k(u)) t_j,\n"
                 "t = [1, z, tanh(W [z, u] + b)],  z = [v, w, v - y],  c = [1, u_m, u_m u_n],\n"
                 "w' = rho (v - |v| w),  y' = lambda (v - y),  u' = mu (i - u)",
     .source = "Dashpot's own; the states are a bank of Dahl's, AIAA J. 14 (1976) 1675",
     .remarks =
         "Velocity and current only. Nothing feeds back to the states, so the force is bounded "
         "for bounded inputs. Beyond the data all signals stay as at their edge, but for the "
         "velocity v of z where its gain takes energy out: there it goes on. Weights and "
         "logarithms of rates are trained together in free run "
         "over whole records, by Levenberg-Marquardt with exact derivatives; the weight decay is "
         "the one with which trials predict held-back data best: conditions, inner levels of the "
         "current, or the ends of the training records. The four members differ in their random "
         "start. Where the current is steady within each record, one current lag stays at 10 ms, "
         "which such data cannot determine. Fitted to at most 8 000 samples, every k-th.",
     .path_states = 5,
     .velocity_lags = 2,
     .current_lags = 3,
     .hidden = 10,
     .members = 4},
}};

}  // namespace

ModelInfo HysteresisNetworkPreset::info() const {
  return {name,    ModelKind::HysteresisNetwork, title, equation, source,
          remarks, {"velocity", "current"}};
}

std::span<const HysteresisNetworkPreset> hysteresis_network_presets() { return kHysteresisPresets; }

}  // namespace dashpot
