#ifdef __cplusplus
extern "C" {
#endif

/* What is measured at a sample. */
typedef struct damper_input {
  double inputs[DAMPER_INPUTS]; /* what moves the plant, as far as it is measured */
  double drives[DAMPER_DRIVES]; /* currents or voltages of the dampers */
  double sensors[DAMPER_SENSORS];
} damper_input;

/* An observer at work. */
typedef struct damper_model {
  int started;                     /* 1: the next sample is the first; 2: there were samples */
  double state[DAMPER_STATE_SIZE]; /* estimate, its covariance, the inputs before */
} damper_model;

/* As it is switched on: the first step starts it from what it sees. */
void damper_init(damper_model* model);
/* The sample that comes next, with these inputs, is the first. */
void damper_reset(damper_model* model, const damper_input* input);
/* One sample, DAMPER_SAMPLE_TIME after the last one: the numbers that are named above. A sensor
 * that shows no number is left out; an input that does stays as it was. */
void damper_step(damper_model* model, const damper_input* input, double* outputs);
