#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "dashpot/error.h"

namespace dashpot::cli {

class Console;

/// Exit codes of the program; 128 + signal when it was stopped.
enum ExitCode { kDone = 0, kUnusableInput = 1, kUsage = 2, kNotUsable = 3, kFilesUnread = 4 };

/// A command line that cannot be understood.
class UsageError : public Error {
 public:
  using Error::Error;
};

/// The variable that an option's value goes to. Its value before parsing is the default, which help
/// prints. A bool is a switch: naming it turns the variable over.
using Target =
    std::variant<bool*, int*, std::uint64_t*, double*, std::string*, std::vector<std::string>*>;

/// The kind of thing that a value names, so that a shell can complete it.
enum class Takes { Word, File, Folder };

/// Options that have no effect beside another one, and are refused.
struct IdleOptions {
  std::vector<std::string> names;  ///< long ones
  std::string why = {};            ///< what follows "has no effect with --in"
  std::string right = "leave one of them out";
};

/// One row of a command's table of options.
struct Option {
  std::string names;  ///< "-q,--quiet", "--starts", or "DATA" for an argument by position
  Target target;
  std::string help;
  std::string value = {};  ///< what help calls the value: "HZ"
  std::vector<std::string> choices =
      {};  ///< the words allowed, and paths where it takes files; empty: any
  std::vector<std::string> more_choices = {};  ///< allowed too, and not listed in the help
  bool takes_parts = false;                    ///< PART=WORD,... with such words is allowed too
  std::string noun = "value";                  ///< what a message calls a word: "unknown model 'x'"
  Takes takes = Takes::Word;
  /// What a word means before it is looked for among the choices: the name of the law that stands
  /// in a file, for options that take models. Null: itself.
  std::string (*meaning)(const std::string& word) = nullptr;
  std::optional<double> minimum = {};  ///< least number allowed
  std::string default_text = {};       ///< in words, where the variable's value does not say it
  bool required = false;
  /// Long name of the option without which this one has no effect, and is refused; empty: none.
  std::string needs = {};
  std::vector<IdleOptions> idles = {};  ///< what has no effect beside this one
  std::string details = {};  ///< what follows `help` where there is room: a topic, the docs page

  bool is_positional() const { return names.front() != '-'; }
  bool is_switch() const { return std::holds_alternative<bool*>(target); }
  bool is_list() const { return std::holds_alternative<std::vector<std::string>*>(target); }
  std::string long_name() const;  ///< "--quiet", or the name of an argument by position
};

/// True where a word that may name a choice or a file names a file: choices have neither dot nor
/// slash.
inline bool is_path(const std::string& word) {
  return word.find_first_of("./") != std::string::npos;
}

/// Rows that several commands have.
Option seed_option(std::uint64_t& seed);
Option threads_option(int& threads);
Option figures_option(bool& figures);

void append(std::vector<Option>& options, const std::vector<Option>& more);

/// One thing that the program does, or a group of such things.
struct Command {
  std::string name;         ///< the words that call it: "rank", "study recovery"
  std::string title;        ///< one line, for the overview
  std::string description;  ///< what it does, for its own help
  std::vector<Option> options;
  std::string example;  ///< worked, with comments: what to type and what comes of it
  std::function<int(Console&)> run;
  std::vector<Command> subcommands = {};   ///< of a group, which has neither options nor `run`
  bool over_ranks = false;                 ///< shares its work among the processes of mpirun
  std::vector<std::string> likewise = {};  ///< words that others call it by, which are no command

  std::string last_word() const;
};

/// The command whose name ends with this word. Throws UsageError that names the known ones.
const Command& find_command(const std::vector<Command>& commands, const std::string& word);

}  // namespace dashpot::cli
