#include "commands.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("the example command: it is known by name and explains itself") {
  const std::vector<cli::Command> commands = cli::all_commands();
  const cli::Command& hello = cli::find_command(commands, "hello_example");
  CHECK(hello.title == "Greet");
  CHECK(hello.run);
}
