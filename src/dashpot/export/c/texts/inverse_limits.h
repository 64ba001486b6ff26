/* Limits of the command. lead: how far beyond the wanted change it goes, for a coil that lags.
 * has_feedback: whether it looks at the measured force. */
typedef struct InverseModel {
  double least, most, lead;
  int has_feedback;
} InverseModel;

static inline double inverse_least(const InverseModel* m) { return m->least; }

static inline double inverse_most(const InverseModel* m) { return m->most; }

static inline double inverse_lead(const InverseModel* m) { return m->lead; }

static inline int inverse_has_feedback(const InverseModel* m) { return m->has_feedback; }
