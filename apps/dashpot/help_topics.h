#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "command.h"

namespace dashpot::cli {

/// Options of a command that few users need, and that a long help leaves to a page of their own.
struct HelpTopic {
  std::string_view name;   ///< the word that asks for it: 'dashpot help identify laws'
  std::string_view title;  ///< the heading of its page
  std::vector<const Option*> options;
};

/// The topics among a command's options, each option in one at most, in the order of the table.
/// They point into `command`.
std::vector<HelpTopic> topics_of(const Command& command);

}  // namespace dashpot::cli
