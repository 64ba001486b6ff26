#include <memory>

#include "commands.h"
#include "completion_script.h"
#include "console.h"

namespace dashpot::cli {

Command completion_command() {
  auto shell = std::make_shared<std::string>();
  return {
      .name = "completion",
      .title = "Print the completion script of a shell",
      .description =
          "Prints a script that lets the shell complete commands, options, model names and files.",

      .options = {{.names = "SHELL",
                   .target = shell.get(),
                   .help = "bash, zsh or fish",
                   .choices = {"bash", "zsh", "fish"},
                   .noun = "shell",
                   .required = true}},
      .example =
          "# For this bash only; put the line into ~/.bashrc to keep it:\n"
          "source <(dashpot completion bash)\n"
          "\n"
          "# zsh, fish:\n"
          "dashpot completion zsh > ~/.zfunc/_dashpot    # ~/.zfunc being in fpath\n"
          "dashpot completion fish > ~/.config/fish/completions/dashpot.fish",

      .run = [shell](Console& console) {
        console.print(completion_script(*shell, all_commands(), common_options(console)));
        return static_cast<int>(kDone);
      }};
}

}  // namespace dashpot::cli
