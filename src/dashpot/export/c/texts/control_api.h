#ifdef __cplusplus
extern "C" {
#endif

/* What is known of one strut at a sample. z up, extension positive. */
typedef struct damper_signals {
  /* @signals@ */
} damper_signals;

typedef struct damper_input {
  damper_signals struts[DAMPER_STRUTS];
  /* @plant_state@ */
} damper_input;

/* What a law asks of a damper: damping, N*s/m; a force, N, positive when it resists extension; the
 * command itself. */
typedef enum damper_kind { DAMPER_DAMPING, DAMPER_FORCE, DAMPER_CURRENT } damper_kind;

typedef struct damper_demand {
  damper_kind kind;
  double value;
} damper_demand;

/* A controller at work. */
typedef struct damper_model {
  int started;
  damper_demand demands[DAMPER_STRUTS]; /* what the last step asked for */
  double state[DAMPER_STATE_SIZE];      /* of filters, law and inverse */
} damper_model;

/* As it is switched on: the first step starts filters and inverse from what it sees. */
void damper_init(damper_model* model);
/* Long at rest at this deflection and current. */
void damper_reset(damper_model* model, const damper_input* input);
/* One sample, DAMPER_SAMPLE_TIME after the last one: a command per strut, always within the limits.
 */
void damper_step(damper_model* model, const damper_input* input, double* commands);
