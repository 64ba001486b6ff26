#pragma once
#include "command.h"

// One study each: subcommands of `dashpot study`.
namespace dashpot::cli {

Command recovery_study();
Command ride_rank_study();
Command one_sensor_study();
Command family_study();
Command suspension_study();

}  // namespace dashpot::cli
