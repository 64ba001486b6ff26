#include "commands.h"
#include "studies.h"

namespace dashpot::cli {

Command study_command() {
  Command command{
      .name = "study",
      .title = "Repeat published experiments, and check Dashpot itself",
      .description =
          "A study fits and judges many models by one protocol and writes what came out as a page: "
          "of a paper, beside the paper's own figures; of Dashpot, beside what it claims.",
      .options = {},
      .example =
          "# The tables and figures of the one-sensor paper, on virtual dampers:\n"
          "dashpot study one-sensor\n"
          "\n"
          "# Those of the family paper, on its published recordings:\n"
          "dashpot study family recordings/family-dnn\n"
          "\n"
          "# The one-sensor paper's suspension, and what is possible at best:\n"
          "dashpot study suspension\n"
          "\n"
          "# Do intervals hold the truth?\n"
          "dashpot study recovery --laws tanh_kwok --repetitions 20",
      .run = {}};

  // Each study is a command of its own, with its own options.
  command.subcommands = {family_study(), one_sensor_study(), recovery_study(), ride_rank_study(),
                         suspension_study()};
  return command;
}

}  // namespace dashpot::cli
