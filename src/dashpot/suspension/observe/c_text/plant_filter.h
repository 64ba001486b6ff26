/* An extended Kalman filter of a linear plant with one damper in it, as C99 text that the library
 * takes in and the C export ships. Declared before: DamperInput; FILTER_MOST, the most numbers of
 * an estimate, FILTER_MOST_SENSORS, FILTER_MOST_INPUTS and FILTER_MOST_DAMPER; and of the damper's
 * model double filter_force(const PlantFilter* f, const DamperInput* input, const double* z) void
 * filter_advance(const PlantFilter* f, const DamperInput* from, const DamperInput* to, double dt,
 * double* z) which may be defined behind it.
 *
 * An estimate s: coordinates of the plant and their velocities; heights of the road where nothing
 * measures it; errors of the damper's force, N, that are forgotten sooner or later; the damper's
 * own state; the sensors' offsets. All but the offsets move. Its covariance c: a row per number. */
#ifndef DASHPOT_PLANT_FILTER_H
#define DASHPOT_PLANT_FILTER_H

typedef struct PlantFilter {
  int plant;                /* coordinates and velocities: two per degree of freedom */
  int inputs;               /* that are measured; the drive of the damper stands behind them */
  int roads;                /* heights that nothing measures */
  int errors;               /* of the damper's force, at least one */
  int damper;               /* numbers of the damper's state */
  int sensors;              /* each with an offset */
  int steps;                /* per sample */
  double step;              /* s */
  double road_keep;         /* the share of a road's height that is left after a step */
  const double* force_keep; /* errors: the share that is left after a step */
  const double* transition; /* plant x plant, over a step */
  const double* by_start; /* plant x (inputs + roads + 1): of inputs, roads and force as they are */
  const double* by_end;   /* at the start and at the end of a step, straight lines in between */
  const double* deflection;   /* plant / 2: the damper's way */
  const double* on_ground;    /* inputs: what an input takes from it */
  const double* sensor_plant; /* sensors x plant */
  const double* sensor_input; /* sensors x inputs: of their values */
  const double* sensor_slope; /* sensors x inputs: of their rates */
  const double* sensor_road;  /* sensors x roads */
  const double* sensor_force; /* sensors: of the damper's force */
  const double* sensor_variance;
  const double* process;    /* moving x moving: what a sample adds to the covariance */
  const double* difference; /* moving: the step of a difference by each number */
  double way, speed;        /* the same of the damper's motion, m and m/s */
} PlantFilter;

/* What a sample told: rows of sensors x all, what the sensors showed beyond what was expected of
 * them and the variance of that, 0 where a sensor showed no number; the transition of what moves,
 * moving x moving. */
typedef struct FilterSample {
  double transition[FILTER_MOST * FILTER_MOST];
  double rows[FILTER_MOST_SENSORS * FILTER_MOST];
  double innovation[FILTER_MOST_SENSORS];
  double variance[FILTER_MOST_SENSORS];
} FilterSample;

static inline double filter_force(const PlantFilter* f, const DamperInput* input, const double* z);
static inline void filter_advance(const PlantFilter* f, const DamperInput* from,
                                  const DamperInput* to, double dt, double* z);

/* Where the errors of the force stand, and the damper's state behind them. */
static inline int filter_error(const PlantFilter* f) { return f->plant + f->roads; }

static inline int filter_own(const PlantFilter* f) { return filter_error(f) + f->errors; }

static inline int filter_moving(const PlantFilter* f) { return filter_own(f) + f->damper; }

static inline int filter_all(const PlantFilter* f) { return filter_moving(f) + f->sensors; }

/* The damper's motion and drive. */
static inline void filter_input(const PlantFilter* f, const double* inputs, const double* slopes,
                                const double* plant, DamperInput* at) {
  const int half = f->plant / 2;
  int k;
  at->displacement = 0;
  at->velocity = 0;
  at->current = inputs[f->inputs];
  for (k = 0; k < half; ++k) {
    at->displacement += f->deflection[k] * plant[k];
    at->velocity += f->deflection[k] * plant[half + k];
  }
  for (k = 0; k < f->inputs; ++k) {
    at->displacement -= f->on_ground[k] * inputs[k];
    at->velocity -= f->on_ground[k] * slopes[k];
  }
}

/* All errors of the force, now and after a step. */
static inline double filter_errors(const PlantFilter* f, const double* s, int after) {
  double sum = 0;
  int k;
  for (k = 0; k < f->errors; ++k) {
    sum += ((after != 0) ? f->force_keep[k] : 1) * s[filter_error(f) + k];
  }
  return sum;
}

/* The plant after a step, under inputs and a force that go straight. */
static inline void filter_linear(const PlantFilter* f, const double* from, const double* to,
                                 const double* roads, double force_start, double force_end,
                                 const double* plant, double* end) {
  const int acting = f->inputs + f->roads + 1;
  int i, k;
  for (i = 0; i < f->plant; ++i) {
    const double* by_start = &f->by_start[i * acting];
    const double* by_end = &f->by_end[i * acting];
    double sum = (by_start[acting - 1] * force_start) + (by_end[acting - 1] * force_end);
    for (k = 0; k < f->plant; ++k) {
      sum += f->transition[(i * f->plant) + k] * plant[k];
    }
    for (k = 0; k < f->inputs; ++k) {
      sum += (by_start[k] * from[k]) + (by_end[k] * to[k]);
    }
    for (k = 0; k < f->roads; ++k) {
      sum += (by_start[f->inputs + k] + by_end[f->inputs + k]) * roads[k];
    }
    end[i] = sum;
  }
}

/* Rates of the inputs between two samples. */
static inline void filter_slopes(const PlantFilter* f, const double* before, const double* now,
                                 double* slopes) {
  int k;
  for (k = 0; k <= f->inputs; ++k) {
    slopes[k] = (now[k] - before[k]) / (f->step * f->steps);
  }
}

/* The step of a difference: as far as the number is uncertain, and not less than its table says. A
 * tangent would claim more than is known where the force bends. */
static inline double filter_difference(double least, double variance) {
  return (variance > (least * least)) ? sqrt(variance) : least;
}

/* How far the damper's motion and state are uncertain: displacement, velocity, then its numbers. */
static inline void filter_reach(const PlantFilter* f, const double* c, double* reach) {
  const int half = f->plant / 2, all = filter_all(f), own = filter_own(f);
  double way = 0, speed = 0;
  int i, k;
  for (i = 0; i < half; ++i) {
    for (k = 0; k < half; ++k) {
      const double both = f->deflection[i] * f->deflection[k];
      way += both * c[(i * all) + k];
      speed += both * c[((half + i) * all) + half + k];
    }
  }
  reach[0] = filter_difference(f->way, way);
  reach[1] = filter_difference(f->speed, speed);
  for (k = 0; k < f->damper; ++k) {
    reach[2 + k] = filter_difference(f->difference[own + k], c[((own + k) * all) + own + k]);
  }
}

/* What the model's force depends on: displacement, velocity, then each number of its state; by
 * differences to both sides. */
static inline void filter_by_force(const PlantFilter* f, const DamperInput* at, const double* z,
                                   const double* reach, double* by) {
  double beside_z[FILTER_MOST];
  int k, side;
  for (k = 0; k < f->damper; ++k) {
    beside_z[k] = z[k];
  }
  for (k = 0; k < (2 + f->damper); ++k) {
    double force[2];
    for (side = 0; side < 2; ++side) {
      const double by_much = (side == 0) ? reach[k] : -reach[k];
      DamperInput beside = *at;
      if (k == 0) {
        beside.displacement += by_much;
      } else if (k == 1) {
        beside.velocity += by_much;
      } else {
        beside_z[k - 2] = z[k - 2] + by_much;
      }
      force[side] = filter_force(f, &beside, beside_z);
    }
    if (k > 1) {
      beside_z[k - 2] = z[k - 2];
    }
    by[k] = (force[0] - force[1]) / (2 * reach[k]);
  }
}

/* The same of the state after a step: it depends on displacement and velocity at the start, then
 * at the end, then on each of its numbers; a row of these per number. */
static inline void filter_by_state(const PlantFilter* f, const DamperInput* first,
                                   const DamperInput* last, const double* z, const double* reach,
                                   double* by) {
  const int width = 4 + f->damper;
  int i, k, side;

  /* One after the other a little more and a little less. */
  for (k = 0; (k < width) && (f->damper > 0); ++k) {
    const double by_much = (k < 4) ? reach[k % 2] : reach[k - 2];
    double after[2 * FILTER_MOST_DAMPER];
    for (side = 0; side < 2; ++side) {
      const double sign = (side == 0) ? 1 : -1;
      DamperInput from = *first, to = *last;
      for (i = 0; i < f->damper; ++i) {
        after[(side * FILTER_MOST_DAMPER) + i] = z[i];
      }
      if (k == 0) {
        from.displacement += sign * by_much;
      } else if (k == 1) {
        from.velocity += sign * by_much;
      } else if (k == 2) {
        to.displacement += sign * by_much;
      } else if (k == 3) {
        to.velocity += sign * by_much;
      } else {
        after[(side * FILTER_MOST_DAMPER) + k - 4] += sign * by_much;
      }
      filter_advance(f, &from, &to, f->step, &after[side * FILTER_MOST_DAMPER]);
    }
    for (i = 0; i < f->damper; ++i) {
      by[(i * width) + k] = (after[i] - after[FILTER_MOST_DAMPER + i]) / (2 * by_much);
    }
  }
}

/* The dependence of a step on one number before it, a column of the transition, through the same
 * step with what the damper depends on. */
static inline void filter_move_column(const PlantFilter* f, const double* by_first,
                                      const double* by_last, const double* by_state, double* column,
                                      int size) {
  double end[FILTER_MOST], z[FILTER_MOST];
  const int half = f->plant / 2, error = filter_error(f), own = filter_own(f);
  const int acting = f->inputs + f->roads + 1, width = 4 + f->damper;
  double start = 0, after = 0, errors = 0, kept = 0, motion[4] = {0, 0, 0, 0};
  int i, k, pass;

  /* The damper's motion and the force at the start. */
  for (k = 0; k < half; ++k) {
    motion[0] += f->deflection[k] * column[k * size];
    motion[1] += f->deflection[k] * column[(half + k) * size];
  }
  for (k = 0; k < f->errors; ++k) {
    errors += column[(error + k) * size];
    kept += f->force_keep[k] * column[(error + k) * size];
  }
  start = (by_first[0] * motion[0]) + (by_first[1] * motion[1]) + errors;
  for (k = 0; k < f->damper; ++k) {
    start += by_first[2 + k] * column[(own + k) * size];
  }

  /* The plant at the end, by the force at the start; that at the end; and once more by it. */
  after = start;
  for (pass = 0; pass < 2; ++pass) {
    for (i = 0; i < f->plant; ++i) {
      const double* by_start = &f->by_start[i * acting];
      const double* by_end = &f->by_end[i * acting];
      double sum = (by_start[acting - 1] * start) + (by_end[acting - 1] * after);
      for (k = 0; k < f->plant; ++k) {
        sum += f->transition[(i * f->plant) + k] * column[k * size];
      }
      for (k = 0; k < f->roads; ++k) {
        sum += (by_start[f->inputs + k] + by_end[f->inputs + k]) * column[(f->plant + k) * size];
      }
      end[i] = sum;
    }
    motion[2] = 0;
    motion[3] = 0;
    for (k = 0; k < half; ++k) {
      motion[2] += f->deflection[k] * end[k];
      motion[3] += f->deflection[k] * end[half + k];
    }
    after = (by_last[0] * motion[2]) + (by_last[1] * motion[3]) + kept;
    for (i = 0; i < f->damper; ++i) {
      z[i] = 0;
      for (k = 0; k < 4; ++k) {
        z[i] += by_state[(i * width) + k] * motion[k];
      }
      for (k = 0; k < f->damper; ++k) {
        z[i] += by_state[(i * width) + 4 + k] * column[(own + k) * size];
      }
      after += by_last[2 + i] * z[i];
    }
  }

  /* All of it behind the step. */
  for (k = 0; k < f->plant; ++k) {
    column[k * size] = end[k];
  }
  for (k = 0; k < f->roads; ++k) {
    column[(f->plant + k) * size] *= f->road_keep;
  }
  for (k = 0; k < f->errors; ++k) {
    column[(error + k) * size] *= f->force_keep[k];
  }
  for (k = 0; k < f->damper; ++k) {
    column[(own + k) * size] = z[k];
  }
}

/* Brings what moves from one sample to the next, and gives the transition: how it depends on what
 * was before. The force at the end of a step is first found from the motion that the force at its
 * start would give. */
static inline void filter_move(const PlantFilter* f, const double* before, const double* now,
                               const double* reach, double* s, double* transition) {
  double slopes[FILTER_MOST_INPUTS + 1], from[FILTER_MOST_INPUTS + 1], to[FILTER_MOST_INPUTS + 1];
  double end[FILTER_MOST], z[FILTER_MOST_DAMPER], by_first[FILTER_MOST], by_last[FILTER_MOST];
  double by_state[FILTER_MOST_DAMPER * (FILTER_MOST_DAMPER + 4)];
  const int error = filter_error(f), own = filter_own(f), moving = filter_moving(f);
  int j, k, step;
  filter_slopes(f, before, now, slopes);
  for (k = 0; k <= f->inputs; ++k) {
    to[k] = before[k];
  }
  for (k = 0; k < FILTER_MOST_DAMPER; ++k) {
    z[k] = 0;
  }
  for (k = 0; k < moving; ++k) {
    for (j = 0; j < moving; ++j) {
      transition[(k * moving) + j] = (j == k) ? 1 : 0;
    }
  }
  for (step = 1; step <= f->steps; ++step) {
    DamperInput first, last;
    double start, after;
    for (k = 0; k <= f->inputs; ++k) {
      from[k] = to[k];
      to[k] = before[k] + (slopes[k] * f->step * step);
    }
    filter_input(f, from, slopes, s, &first);
    start = filter_force(f, &first, &s[own]) + filter_errors(f, s, 0);
    filter_linear(f, from, to, &s[f->plant], start, start, s, end);
    filter_input(f, to, slopes, end, &last);
    for (k = 0; k < f->damper; ++k) {
      z[k] = s[own + k];
    }
    filter_advance(f, &first, &last, f->step, z);
    after = filter_force(f, &last, z) + filter_errors(f, s, 1);

    /* What depends on what, before the state is overwritten. */
    filter_by_force(f, &first, &s[own], reach, by_first);
    filter_by_force(f, &last, z, reach, by_last);
    filter_by_state(f, &first, &last, &s[own], reach, by_state);
    for (j = 0; j < moving; ++j) {
      filter_move_column(f, by_first, by_last, by_state, &transition[j], moving);
    }

    filter_linear(f, from, to, &s[f->plant], start, after, s, end);
    filter_input(f, to, slopes, end, &last);
    filter_advance(f, &first, &last, f->step, &s[own]);
    for (k = 0; k < f->plant; ++k) {
      s[k] = end[k];
    }
    for (k = 0; k < f->roads; ++k) {
      s[f->plant + k] *= f->road_keep;
    }
    for (k = 0; k < f->errors; ++k) {
      s[error + k] *= f->force_keep[k];
    }
  }
}

/* From the sample before to this one, before its sensors are looked at. */
static inline void filter_predict(const PlantFilter* f, const double* before, const double* now,
                                  double* s, double* c, double* transition) {
  double reach[FILTER_MOST], product[FILTER_MOST * FILTER_MOST];
  const int moving = filter_moving(f), all = filter_all(f);
  int i, j, k;
  filter_reach(f, c, reach);
  filter_move(f, before, now, reach, s, transition);

  /* The covariance: of what moves among itself, then with the offsets. */
  for (i = 0; i < moving; ++i) {
    for (j = 0; j < all; ++j) {
      double sum = 0;
      for (k = 0; k < moving; ++k) {
        sum += transition[(i * moving) + k] * c[(k * all) + j];
      }
      product[(i * all) + j] = sum;
    }
  }
  for (i = 0; i < moving; ++i) {
    for (j = 0; j <= i; ++j) {
      double sum = f->process[(i * moving) + j];
      for (k = 0; k < moving; ++k) {
        sum += product[(i * all) + k] * transition[(j * moving) + k];
      }
      c[(i * all) + j] = sum;
      c[(j * all) + i] = sum;
    }
    for (j = moving; j < all; ++j) {
      c[(i * all) + j] = product[(i * all) + j];
      c[(j * all) + i] = product[(i * all) + j];
    }
  }
}

/* The damper's force without its errors, and what the whole force depends on, one number per moving
 * one; of each error 1. */
static inline double filter_gradient(const PlantFilter* f, const DamperInput* at, const double* s,
                                     const double* c, double* gradient) {
  double reach[FILTER_MOST], by[FILTER_MOST];
  const int half = f->plant / 2, error = filter_error(f), own = filter_own(f);
  int k;
  filter_reach(f, c, reach);
  filter_by_force(f, at, &s[own], reach, by);
  for (k = 0; k < half; ++k) {
    gradient[k] = by[0] * f->deflection[k];
    gradient[half + k] = by[1] * f->deflection[k];
  }
  for (k = 0; k < f->roads; ++k) {
    gradient[f->plant + k] = 0;
  }
  for (k = error; k < own; ++k) {
    gradient[k] = 1;
  }
  for (k = 0; k < f->damper; ++k) {
    gradient[own + k] = by[2 + k];
  }
  return filter_force(f, at, &s[own]);
}

/* Takes the sensors in, one after the other. One that shows no number is left out. */
static inline void filter_update(const PlantFilter* f, const double* before, const double* now,
                                 const double* measured, double* s, double* c,
                                 FilterSample* sample) {
  double slopes[FILTER_MOST_INPUTS + 1], gradient[FILTER_MOST], change[FILTER_MOST];
  double with[FILTER_MOST];
  const int moving = filter_moving(f), all = filter_all(f);
  DamperInput at;
  double force;
  int i, k, m;
  filter_slopes(f, before, now, slopes);
  filter_input(f, now, slopes, s, &at);
  force = filter_gradient(f, &at, s, c, gradient) + filter_errors(f, s, 0);
  for (k = 0; k < all; ++k) {
    change[k] = 0;
  }
  for (m = 0; m < f->sensors; ++m) {
    double* row = &sample->rows[m * all];
    double beyond = measured[m] - (f->sensor_force[m] * force) - s[moving + m];
    double variance = f->sensor_variance[m];
    for (k = 0; k < moving; ++k) {
      row[k] = f->sensor_force[m] * gradient[k];
    }
    for (k = 0; k < f->plant; ++k) {
      row[k] += f->sensor_plant[(m * f->plant) + k];
      beyond -= f->sensor_plant[(m * f->plant) + k] * s[k];
    }
    for (k = 0; k < f->roads; ++k) {
      row[f->plant + k] += f->sensor_road[(m * f->roads) + k];
      beyond -= f->sensor_road[(m * f->roads) + k] * s[f->plant + k];
    }
    for (k = 0; k < f->inputs; ++k) {
      beyond -= (f->sensor_input[(m * f->inputs) + k] * now[k]) +
                (f->sensor_slope[(m * f->inputs) + k] * slopes[k]);
    }
    for (k = moving; k < all; ++k) {
      row[k] = (k == (moving + m)) ? 1 : 0;
    }

    /* What the sensors before it have changed counts by the same row. */
    for (i = 0; i < all; ++i) {
      double sum = 0;
      for (k = 0; k < all; ++k) {
        sum += c[(i * all) + k] * row[k];
      }
      with[i] = sum;
    }
    for (k = 0; k < all; ++k) {
      beyond -= row[k] * change[k];
      variance += row[k] * with[k];
    }
    sample->innovation[m] = 0;
    sample->variance[m] = 0;
    if ((fabs(beyond) < 1e30) && (variance > 0)) {
      sample->innovation[m] = beyond;
      sample->variance[m] = variance;
      for (i = 0; i < all; ++i) {
        change[i] += with[i] * beyond / variance;
        for (k = 0; k <= i; ++k) {
          c[(i * all) + k] -= with[i] * with[k] / variance;
          c[(k * all) + i] = c[(i * all) + k];
        }
      }
    }
  }
  for (k = 0; k < all; ++k) {
    s[k] += change[k];
  }
}

/* The damper now, after filter_update(): its force with its errors, N; the standard deviation of
 * that; its deflection and the rate of it. */
static inline void filter_damper(const PlantFilter* f, const double* before, const double* now,
                                 const double* s, const double* c, double* out) {
  double slopes[FILTER_MOST_INPUTS + 1], gradient[FILTER_MOST];
  const int moving = filter_moving(f), all = filter_all(f);
  DamperInput at;
  double variance = 0;
  int i, k;
  filter_slopes(f, before, now, slopes);
  filter_input(f, now, slopes, s, &at);
  out[0] = filter_gradient(f, &at, s, c, gradient) + filter_errors(f, s, 0);
  for (i = 0; i < moving; ++i) {
    for (k = 0; k < moving; ++k) {
      variance += gradient[i] * c[(i * all) + k] * gradient[k];
    }
  }
  out[1] = sqrt(fmax(variance, 0));
  out[2] = at.displacement;
  out[3] = at.velocity;
}

#endif
