#pragma once
#include <set>
#include <string>

#include "dashpot/controller.h"

namespace dashpot {

/// A controller's laws as C code.
struct CControlLaw {
  std::size_t struts = 1;
  std::string code;  ///< texts and tables that `demand` needs
  /// An expression of StrutSignals* s, damper_input* input, int strut and double* state.
  std::string demand;
  std::size_t memory = 0;  ///< numbers of the state that it keeps per strut, from `first_memory` on
  std::size_t states = 0;  ///< numbers of the plant's state that it looks at
  bool gives_damping = false, gives_force = false, gives_current = false;
};
/// Throws Error where a law has no C text.
CControlLaw c_control_law(const ControlDescription& controller, std::size_t struts,
                          std::size_t first_memory);

/// The fields of StrutSignals, in their order.
struct StrutSignal {
  std::string_view name, unit, meaning;  ///< `unit`: empty where it is the drive's
  double StrutSignals::* value;
};
std::span<const StrutSignal> strut_signals();
/// Which of them C code looks at, as s->name.
std::set<std::string> signals_in(const std::string& code);

}  // namespace dashpot
