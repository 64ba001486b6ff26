#include "commands.h"
#include "console.h"

namespace dashpot::cli {

Command version_command() {
  return {
      .name = "version",
      .title = "Print the version",
      .description = "Prints the version of the program.",
      .options = {},
      .example = "dashpot version",
      .run = [](Console& console) {
        if (console.json)
          console.print_json(Value::object({{"program", "dashpot"}, {"version", DASHPOT_VERSION}}));
        else
          console.print("dashpot " DASHPOT_VERSION "\n");
        return static_cast<int>(kDone);
      }};
}

}  // namespace dashpot::cli
