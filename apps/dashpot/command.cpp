#include "command.h"

#include <algorithm>

#include "dashpot/base/text.h"

namespace dashpot::cli {

Option seed_option(std::uint64_t& seed) {
  return {.names = "--seed",
          .target = &seed,
          .help = "seed of all random numbers: the same seed gives the same result",
          .value = "N",
          .minimum = 0};
}

Option threads_option(int& threads) {
  return {.names = "--threads",
          .target = &threads,
          .help = "threads to use; the result does not depend on it",
          .value = "N",
          .minimum = 0,
          .default_text = "all cores"};
}

Option figures_option(bool& figures) {
  return {.names = "--figures",
          .target = &figures,
          .help = "also draw the figures as SVG and PDF, for a paper (needs gnuplot)"};
}

std::string Option::long_name() const { return names.substr(names.find(',') + 1); }

void append(std::vector<Option>& options, const std::vector<Option>& more) {
  options.insert(options.end(), more.begin(), more.end());
}

std::string Command::last_word() const { return name.substr(name.rfind(' ') + 1); }

const Command& find_command(const std::vector<Command>& commands, const std::string& word) {
  std::vector<std::string> names;
  std::string meant = word;
  for (const Command& command : commands) {
    if (command.last_word() == word) return command;
    names.push_back(command.last_word());
    if (std::ranges::find(command.likewise, word) != command.likewise.end())
      meant = command.last_word();
  }
  throw UsageError(
      "",
      std::string("unknown ") + (word.starts_with('-') ? "option" : "command") + " '" + word + "'",
      suggest(meant, names));
}

}  // namespace dashpot::cli
