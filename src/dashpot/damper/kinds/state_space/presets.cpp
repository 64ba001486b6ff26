#include "dashpot/damper/kinds/state_space/presets.h"

#include <array>

namespace dashpot {
namespace {

constexpr std::array<StateSpacePreset, 1> kStateSpacePresets{{
    {.name = "neural_state_space",
     .title = "Neural state space, one sensor",
     .equation =
         "F = mean of members of  sum_j (sum_k G_jk c_k(u)) t_j,\n"
         "t = [1, z, tanh(V [z, u] + b)],  z = [v, x, v - y],  c = [1, u_m, u_m u_n],\n"
         "x' = r (w - |w| x),  y' = r (w - y),  u' = mu (i - u),\n"
         "w = v + B p,  r = rate exp(3 tanh(D p / 3)),  p = [1, x, u, tanh(W [x, y, v, u, 1])]",
     .source = "Dashpot's own cell; an encoder and a loss over several steps of windows after "
               "Beintema, Toth and Schoukens, L4DC (2021), and Forgione and Piga, Eur. J. Control "
               "59 (2021) 69",
     .remarks =
         "Velocity and current only. The states act back on their own speed and rates through a "
         "small perceptron; without it they are a bank of Dahl states and lags, from which the "
         "training starts. Bounded for bounded inputs: x stays within -1 ... 1, y near v plus "
         "something bounded; beyond the data what the network reads is held as in "
         "hysteresis_network. A step is exact for rates and speeds held over it; steps longer than "
         "the model's own (5 ms at most, kept in the file) are divided. Trained first on windows "
         "of 400 samples, each run freely from where an encoder of past forces and velocities "
         "puts the states, then in free run over whole records from rest; Levenberg-Marquardt "
         "with exact derivatives in both. The encoder is not part of the model: a damper that "
         "starts from rest has settled under its current. The weight decay is chosen as for "
         "hysteresis_network. The members differ in their random start.",
     .path_states = 4,
     .lags = 2,
     .current_lags = 2,
     .hidden = 6,
     .output_hidden = 6,
     .members = 3},
}};

}  // namespace

ModelInfo StateSpacePreset::info() const {
  return {name, ModelKind::StateSpace, title, equation, source, remarks, {"velocity", "current"}};
}

std::span<const StateSpacePreset> state_space_presets() { return kStateSpacePresets; }

}  // namespace dashpot
