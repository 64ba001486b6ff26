#include "commands.h"
#include "console.h"

namespace dashpot::cli {

Command hello_example_command() {
  return {.name = "hello_example",
          .title = "Greet",
          .description = "Prints a greeting: the example of CONTRIBUTING.md.",
          .options = {},
          .example = "dashpot hello_example",
          .run = [](Console& console) {
            console.print("hello\n");
            return static_cast<int>(kDone);
          }};
}

}  // namespace dashpot::cli
