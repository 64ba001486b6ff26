#include "completion_script.h"

#include <fmt/core.h>

#include "console.h"
#include "dashpot/base/text.h"

namespace dashpot::cli {
namespace {

std::vector<Option> options_of(const Command& command, const std::vector<Option>& common) {
  std::vector<Option> options = command.options;
  append(options, common);
  return options;
}

std::string command_names(const std::vector<Command>& commands) {
  std::vector<std::string> names;
  for (const Command& command : commands) names.push_back(command.last_word());
  return join(names, " ");
}

// ---- bash -------------------------------------------------------------------

/// The shell command by which bash completes one value.
std::string bash_values(const Option& option) {
  if (!option.choices.empty()) return "_dashpot_words '" + join(option.choices, " ") + "'";
  if (option.takes == Takes::Folder) return "COMPREPLY=($(compgen -d -- \"$word\"))";
  if (option.takes == Takes::File) return "COMPREPLY=($(compgen -f -- \"$word\"))";
  return ":";
}

/// One branch of a case: a command's values by the word before, its options, its arguments; of a
/// group, the case of its subcommands.
std::string bash_command(const Command& command, const std::vector<Option>& common) {
  // A group offers its subcommands, each of which completes as a command does.
  if (!command.subcommands.empty()) {
    std::string cases;
    for (const Command& one : command.subcommands) cases += bash_command(one, common);
    return fmt::format(
        "    {})\n    if [ \"$COMP_CWORD\" -eq 2 ]; then _dashpot_words '--help {}'; return; fi\n"
        "    case ${{COMP_WORDS[2]}} in\n{}    esac;;\n",
        command.last_word(), command_names(command.subcommands), cases);
  }

  // The values of an option follow its name; all other words are names or arguments.
  std::string values, arguments = ":", names = "--help";
  for (const Option& option : options_of(command, common)) {
    if (option.is_positional()) {
      arguments = bash_values(option);
      continue;
    }
    names += fmt::format(" {}", join(split(option.names, ','), " "));
    if (!option.is_switch())
      values += fmt::format("        {}) {}; return;;\n", join(split(option.names, ','), "|"),
                            bash_values(option));
  }

  return fmt::format(
      "    {})\n      case $previous in\n{}      esac\n"
      "      case $word in\n        -*) _dashpot_words '{}';;\n        *) {};;\n      esac;;\n",
      command.last_word(), values, names, arguments);
}

std::string bash_script(const std::vector<Command>& commands, const std::vector<Option>& common) {
  std::string cases;
  for (const Command& command : commands) cases += bash_command(command, common);

  // The helper function keeps the part of a comma-separated list that is already typed.
  return "# bash completion of dashpot: source <(dashpot completion bash)\n"
         "_dashpot_words() {  # completes the last word of a list that commas separate\n"
         "  local before=\n"
         "  case $word in *,*) before=${word%,*},;; esac\n"
         "  COMPREPLY=($(compgen -P \"$before\" -W \"$1\" -- \"${word##*,}\"))\n"
         "}\n"
         "_dashpot() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
         "  COMPREPLY=()\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ] || [ \"${COMP_WORDS[1]}\" = help ]; then\n"
         "    _dashpot_words 'help " +
         command_names(commands) +
         "'\n    return\n  fi\n"
         "  case ${COMP_WORDS[1]} in\n" +
         cases + "  esac\n}\ncomplete -o filenames -F _dashpot dashpot\n";
}

// ---- zsh --------------------------------------------------------------------

/// Text for a zsh specification: brackets and colons mean something there.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::string zsh_action(const Option& option) {
  if (!option.choices.empty())
    return option.is_list() ? "_values -s , word " + join(option.choices, " ")
                            : fmt::format("({})", join(option.choices, " "));
  if (option.takes == Takes::Folder) return "_files -/";
  return option.takes == Takes::File ? "_files" : "";
}

std::string zsh_specification(const Option& option) {
  if (option.is_positional())
    return shell_quoted((option.is_list() ? "*:" : ":") + option.names + ":" + zsh_action(option));
  std::string value;
  if (!option.is_switch())
    value = fmt::format(":{}:{}", zsh_text(option.value), zsh_action(option));
  std::vector<std::string> specifications;
  for (const std::string& name : split(option.names, ','))
    specifications.push_back(shell_quoted(name + "[" + zsh_text(option.help) + "]" + value));
  return join(specifications, " ");
}

/// One branch of a case; `$words` and CURRENT count from the command's own name.
std::string zsh_command(const Command& command, const std::vector<Option>& common) {
  std::string text = "    " + command.last_word() + ")\n";

  // A command completes its options and arguments.
  if (command.subcommands.empty()) {
    text += "      _arguments '--help[explain the command]'";
    for (const Option& option : options_of(command, common))
      text += " \\\n        " + zsh_specification(option);
    return text + ";;\n";
  }

  // A group offers its subcommands first; the words after one belong to it.
  std::string cases;
  for (const Command& one : command.subcommands) cases += zsh_command(one, common);
  return text + "      if (( CURRENT == 2 )); then\n        compadd " +
         command_names(command.subcommands) +
         "\n        return\n      fi\n      command=$words[2]\n      shift words\n      (( "
         "CURRENT-- ))\n"
         "      case $command in\n" +
         cases + "      esac;;\n";
}

std::string zsh_script(const std::vector<Command>& commands, const std::vector<Option>& common) {
  std::string names, cases;

  // The names with their titles for the first word, and a case for what follows each.
  for (const Command& command : commands) {
    names += "    " + shell_quoted(command.name + ":" + zsh_text(command.title)) + "\n";
    cases += zsh_command(command, common);
  }

  return "#compdef dashpot\n"
         "_dashpot() {\n"
         "  local -a commands\n  commands=(\n" +
         names +
         "  )\n"
         "  if (( CURRENT == 2 )); then\n    _describe command commands\n    return\n  fi\n"
         "  local command=$words[2]\n  shift words\n  (( CURRENT-- ))\n"
         "  case $command in\n" +
         cases + "  esac\n}\n_dashpot \"$@\"\n";
}

// ---- fish -------------------------------------------------------------------

std::string fish_values(const Option& option) {
  if (!option.choices.empty()) return " -x -a " + shell_quoted(join(option.choices, " "));
  if (option.takes == Takes::Folder) return " -x -a '(__fish_complete_directories)'";
  return option.takes == Takes::File ? " -r -F" : " -x";
}

std::string fish_option(const std::string& condition, const Option& option) {
  std::string line = "complete -c dashpot -n " + shell_quoted(condition);
  if (option.is_positional()) {
    if (!option.choices.empty())
      return line + " -a " + shell_quoted(join(option.choices, " ")) + '\n';
    return option.takes == Takes::File ? line + " -F\n" : "";
  }
  for (const std::string& name : split(option.names, ','))
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!option.is_switch()) line += fish_values(option);
  return line + " -d " + shell_quoted(option.help) + '\n';
}

/// The completions of a command while `condition` holds.
std::string fish_command(const Command& command, const std::string& condition,
                         const std::vector<Option>& common) {
  std::string text =
      "complete -c dashpot -n " + shell_quoted(condition) + " -l help -d 'explain the command'\n";

  // A subcommand is offered until one is there, and its own options from then on.
  for (const Command& one : command.subcommands) {
    const std::string names = command_names(command.subcommands);
    text += "complete -c dashpot -n " +
            shell_quoted(condition + "; and not __fish_seen_subcommand_from " + names) + " -a " +
            one.last_word() + " -d " + shell_quoted(one.title) + '\n' +
            fish_command(one, condition + "; and __fish_seen_subcommand_from " + one.last_word(),
                         common);
  }

  if (command.subcommands.empty())
    for (const Option& option : options_of(command, common)) text += fish_option(condition, option);
  return text;
}

std::string fish_script(const std::vector<Command>& commands, const std::vector<Option>& common) {
  std::string text = "complete -c dashpot -f\n";
  for (const Command& command : commands) {
    text += "complete -c dashpot -n __fish_use_subcommand -a " + command.name + " -d " +
            shell_quoted(command.title) + '\n';
    text += fish_command(command, "__fish_seen_subcommand_from " + command.name, common);
  }
  return text;
}

}  // namespace

std::string completion_script(const std::string& shell, const std::vector<Command>& commands,
                              const std::vector<Option>& common) {
  if (shell == "zsh") return zsh_script(commands, common);
  if (shell == "fish") return fish_script(commands, common);
  return bash_script(commands, common);
}

}  // namespace dashpot::cli
