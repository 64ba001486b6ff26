/* A damper model from C: predict MODEL.json, or the name of a published parameter set. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dashpot.h"

enum { kSamples = 1000 };

static int failed(dashpot_status status) {
  if (status == DASHPOT_OK) return 0;
  fprintf(stderr, "%s\n", dashpot_last_error());
  return 1;
}

/* One period of a sine of 20 mm at 1 Hz. */
static void fill(double* displacement, double* velocity) {
  const double kPi = 3.14159265358979323846;
  for (int k = 0; k < kSamples; ++k) {
    const double phase = 2 * kPi * k / kSamples;
    displacement[k] = 0.02 * sin(phase);
    velocity[k] = 2 * kPi * 0.02 * cos(phase);
  }
}

static int predict(const dashpot_model* model) {
  static double displacement[kSamples], velocity[kSamples], force[kSamples];
  const double current = 1;
  dashpot_motion motion = {0};
  dashpot_response response = {0};
  dashpot_model_info info;
  double largest = 0;
  if (failed(dashpot_model_get_info(model, &info))) return 1;
  fill(displacement, velocity);
  motion.samples = kSamples;
  motion.sample_time = 1.0 / kSamples;
  motion.displacement = (dashpot_column){displacement, 1};
  motion.velocity = (dashpot_column){velocity, 1};
  motion.current = (dashpot_column){&current, 0}; /* one value for all samples */
  response.force = force;
  if (failed(dashpot_run(model, &motion, &response))) return 1;
  for (int k = 0; k < kSamples; ++k) largest = fmax(largest, fabs(force[k]));
  printf("%s at 1 %s: largest force %.17g N\n", info.name, info.drive_unit, largest);
  return 0;
}

int main(int argc, char** argv) {
  const char* name = argc > 1 ? argv[1] : "spencer1997";
  dashpot_model* model = NULL;
  const int is_file = strstr(name, ".json") != NULL;
  int result;
  if (failed(is_file ? dashpot_model_load(name, &model) : dashpot_model_published(name, &model)))
    return EXIT_FAILURE;
  result = predict(model);
  dashpot_model_free(&model);
  return result == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
