#ifdef __cplusplus
extern "C" {
#endif

/* What a controller knows at the instant at which it commands. */
typedef struct damper_input {
  double wanted;       /* N, the force wanted at this motion, positive when it resists extension */
  double displacement; /* m, extension positive */
  double velocity;     /* m/s, extension positive */
  double current;      /* in the coil now: see above for its unit */
  double measured;     /* N, the force now; @measured@ */
} damper_input;

/* An inverse at work. */
typedef struct damper_model {
  double state[DAMPER_STATE_SIZE];
} damper_model;

/* Long at rest, at displacement 0 and the least current. Where the damper stands elsewhere,
 * damper_reset: the first step would be a leap, which a model with memory feels for seconds. */
void damper_init(damper_model* model);
/* Long at rest at this displacement and current. */
void damper_reset(damper_model* model, const damper_input* input);
/* The current to command now, DAMPER_SAMPLE_TIME after the last call, always within the limits.
 * Where an input at which it looks is not finite, the present current, or the least where that is
 * no number; from the next finite input on it works as before. */
double damper_step(damper_model* model, const damper_input* input);
