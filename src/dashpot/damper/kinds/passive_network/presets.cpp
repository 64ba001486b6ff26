#include "dashpot/damper/kinds/passive_network/presets.h"

#include <array>

namespace dashpot {
namespace {

constexpr const char* kEquation =
    "F = mean of members of  sum_k A_k s_k + c v + U'(x) + m (v - w) n,\n"
    "s_k' = k_k (A_k v - r_k s_k),  r_k = exp(g_ak) + |A_k v| exp(g_bk),  w' = n (v - w),\n"
    "A = P + Q a,  a = i (1 - exp(-q / i)),  q' = (current - q) rate,  k, P, Q, m >= 0,\n"
    "[h, p] = tanh(W [v, x, d, u, s, 1]),  g = G [h, 1, a],  u' = rate (p - u),\n"
    "c = (z + sqrt(z^2 + 1)) / 2,  z = C [tanh(V [v, x, d, u, 1]), 1, a],  U convex";
constexpr const char* kSource =
    "Dashpot's own; springs that a resistance drains are the elements "
    "of rheology, a transformer and resistances that depend on "
    "anything keep a port-Hamiltonian system passive";

constexpr std::array<PassiveNetworkPreset, 2> kPassivePresets{{
    {.name = "passive_network",
     .title = "Passive network",
     .equation = kEquation,
     .source = kSource,
     .remarks =
         "Cannot generate energy, whatever its numbers and whatever the current does: "
         "energy is stored in springs of fixed stiffness, a convex potential and an inertia "
         "alone; the networks set resistances and a viscous term that is never negative, and "
         "the current moves levers. Displacement is read where the records have it. The "
         "drive's lag is fitted where the drive varies within records. Trained by descent "
         "over windows with gradients through time; how much its weights shrink is chosen on "
         "held-back conditions and ends of the drive. Networks read the drive as d, within its "
         "levels alone: beyond them it moves levers and shares. Steps longer than the model's "
         "own, kept in the file, are divided.",
     .sizes = {.springs = 12, .memories = 4, .neurons = 24, .viscous_neurons = 12},
     .members = 3},
    {.name = "passive_network_one_sensor",
     .title = "Passive network, one sensor",
     .equation = kEquation,
     .source = kSource,
     .remarks = "passive_network from velocity and current alone, small enough for a controller "
                "with a period of 1 ms.",
     .displacement = false,
     .sizes = {.springs = 12, .memories = 4, .neurons = 12, .viscous_neurons = 6}},
}};

}  // namespace

ModelInfo PassiveNetworkPreset::info() const {
  ModelInfo info{name,    ModelKind::PassiveNetwork, title, equation, source,
                 remarks, {"velocity", "current"}};
  if (displacement) info.inputs.insert(info.inputs.begin(), "displacement");
  return info;
}

std::span<const PassiveNetworkPreset> passive_network_presets() { return kPassivePresets; }

}  // namespace dashpot
