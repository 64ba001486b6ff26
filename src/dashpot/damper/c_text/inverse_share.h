#ifndef DASHPOT_INVERSE_SHARE_H
#define DASHPOT_INVERSE_SHARE_H

static inline double sign_of(double x) {
  double sign = 0;
  if (x > 0) {
    sign = 1;
  } else if (x < 0) {
    sign = -1;
  } else {
    /* neither */
  }
  return sign;
}

/* N, by which the measured force misses the wanted one, counted in its own direction */
static inline double missing_force(const InverseInput* input) {
  return sign_of(input->measured) * (input->wanted - input->measured);
}

#endif
