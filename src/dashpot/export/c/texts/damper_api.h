#ifdef __cplusplus
extern "C" {
#endif

/* What the damper sees at one instant. */
typedef struct damper_input {
  double displacement; /* m, extension positive */
  double velocity;     /* m/s, extension positive */
  double current;      /* the command: see above for its unit */
} damper_input;

/* A damper at work. Any number of them may be at work side by side. */
typedef struct damper_model {
  damper_input input; /* the last one */
  double state[DAMPER_STATE_SIZE];
} damper_model;

/* Long at rest, at displacement 0 without current. */
void damper_init(damper_model* model);
/* Long at rest at this displacement and current. */
void damper_reset(damper_model* model, const damper_input* input);
/* The input DAMPER_SAMPLE_TIME after the last one; the force then, N, positive when it resists
 * extension. Between the two the input is taken as linear. */
double damper_step(damper_model* model, const damper_input* input);
/* The same dt seconds after the last one; where dt is not above 0 only the input is new. */
double damper_advance(damper_model* model, const damper_input* input, double dt);

/* The parts of the above, for simulators that keep the state themselves: an array of
 * DAMPER_STATE_SIZE. */
void damper_rest(const damper_input* input, double* state);
void damper_move(const damper_input* from, const damper_input* to, double dt, double* state);
double damper_force(const damper_input* input, const double* state);
