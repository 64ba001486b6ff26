#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/fit_choices.h"

namespace dashpot {

/// One row of the table from which help, parsing, formatting and searches read.
struct NetworkSetting {
  std::string_view name, meaning;
  std::string_view value;  ///< what a value looks like: "15-15-15", "tanh, relu, ...", "1e-3"
  /// Throws Error(where, ...) at a value that cannot be.
  void (*parse)(std::string_view text, const std::string& where, NetworkDesign& design);
  std::string (*format)(const NetworkDesign& design);  ///< empty where nothing is set
};
std::span<const NetworkSetting> network_settings();
/// Throws Error(where, "unknown setting ...") that names the known ones.
const NetworkSetting& find_network_setting(std::string_view name, const std::string& where);

/// "hidden=15-15" into `design`; `option` stands in messages. Throws Error.
void parse_network_setting(std::string_view text, const std::string& option, NetworkDesign& design);
/// "hidden=15-15,activation=relu": what is set, in the order of the table; reads back as the same
/// design.
std::string format_design(const NetworkDesign& design);

/// Whether a trainer descends on mini-batches.
bool trains_on_batches(Trainer trainer);
/// Whether a setting makes a difference to training by `trainer`.
bool has_use(Trainer trainer, std::string_view setting);
/// The word for it: "lm", "adam".
std::string_view name_of(Trainer trainer);

/// Throws Error when something is set that the trainer (the usual one where none is named) does not
/// use.
void require_trainer(const NetworkDesign& design, Trainer usual = Trainer::LevenbergMarquardt);

}  // namespace dashpot
