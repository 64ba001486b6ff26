#include "console.h"
#include "studies.h"
namespace dashpot::cli {
Command one_sensor_study() {
  return {.name = "study one-sensor",
          .title = "t",
          .description = "d",
          .options = {},
          .example = "e",
          .run = [](Console&) { return 0; }};
}
}  // namespace dashpot::cli
