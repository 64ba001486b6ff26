/* An extended Kalman filter of a linear plant with dampers in it, as C99 text that the library
 * takes in and the C export ships. Declared before: DamperInput; FILTER_MOST, the most numbers of
 * an estimate's covariance, FILTER_MOST_SENSORS, FILTER_MOST_INPUTS, FILTER_MOST_DAMPERS,
 * FILTER_MOST_DAMPER, the most numbers of a damper's state that is estimated, and
 * FILTER_MOST_MEMORY, of one that is carried along. filter_force and filter_advance, which step the
 * model of damper d, may be defined behind it.
 *
 * An estimate s: coordinates of the plant and their velocities; heights of the road where nothing
 * measures it; damper by damper errors of its force, N, that are forgotten sooner or later, and the
 * shift of the velocity by which its force goes, m/s; damper by damper its own state; the sensors'
 * offsets. All but the offsets move. Its covariance c: a row per number.
 *
 * A damper's state of many numbers, or one without rates, is not estimated but carried along the
 * motion that is told, in which it forgets what it was wrong by; it stands behind the offsets, as a
 * memory that the covariance knows nothing of: the state, and what it would be, had the damper
 * always been as much faster, and slower, as its velocity is uncertain. */
#ifndef DASHPOT_PLANT_FILTER_H
#define DASHPOT_PLANT_FILTER_H

typedef struct PlantFilter {
  int plant;                  /* coordinates and velocities: two per degree of freedom */
  int inputs;                 /* that are measured; the drives of the dampers stand behind them */
  int drives;                 /* one of all dampers, or one for each */
  int roads;                  /* heights that nothing measures */
  int dampers;                /* at least one */
  int errors;                 /* of each damper's force, at least one */
  int shifts;                 /* of the velocity that its force goes by: 0 or 1 */
  int sensors;                /* each with an offset */
  int steps;                  /* per sample */
  double step;                /* s */
  double road_keep;           /* the share of a road's height that is left after a step */
  const int* damper;          /* dampers: numbers of its state that are estimated */
  const int* memory;          /* dampers: those that are carried along: of one or the other, none */
  const int* by_way;          /* dampers: whether its force goes by its displacement: 0 or 1 */
  const double* error_keep;   /* errors + shifts: the share that is left after a step */
  const double* transition;   /* plant x plant, over a step */
  const double* by_start;     /* plant x (inputs + roads + dampers): of inputs, roads and forces */
  const double* by_end;       /* as they are at both ends of a step, straight lines in between */
  const double* deflection;   /* dampers x plant / 2: the damper's way */
  const double* on_ground;    /* dampers x inputs: what an input takes from it */
  const double* sensor_plant; /* sensors x plant */
  const double* sensor_input; /* sensors x inputs: of their values */
  const double* sensor_slope; /* sensors x inputs: of their rates */
  const double* sensor_road;  /* sensors x roads */
  const double* sensor_force; /* sensors x dampers: of their forces */
  const double* sensor_variance;
  const double* process;    /* moving x moving: what a sample adds to the covariance */
  const double* difference; /* moving: the step of a difference by each number */
  double way, speed;        /* the same of a damper's motion, m and m/s */
  double shift_added;       /* half of what a sample adds to the variance of a shift */
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

/* A damper over a step: its motion and drive at both ends; what its force depends on there; and
 * what its state behind the step does, a row per number. */
typedef struct FilterDamper {
  DamperInput first, last;
  double by_first[FILTER_MOST_DAMPER + 2];
  double by_last[FILTER_MOST_DAMPER + 2];
  double by_state[FILTER_MOST_DAMPER * (FILTER_MOST_DAMPER + 4)];
} FilterDamper;

static inline double filter_force(const PlantFilter* f, int d, const DamperInput* input,
                                  const double* z);
static inline void filter_advance(const PlantFilter* f, int d, const DamperInput* from,
                                  const DamperInput* to, double dt, double* z);

/* Where the errors of the force of damper d stand, behind them the shift of its velocity if there
 * is one, and its own state; behind the last: the end. */
static inline int filter_error(const PlantFilter* f, int d) {
  return f->plant + f->roads + (d * (f->errors + f->shifts));
}

static inline int filter_shift(const PlantFilter* f, int d) {
  return filter_error(f, d) + f->errors;
}

static inline int filter_own(const PlantFilter* f, int d) {
  int place = filter_error(f, f->dampers), k;
  for (k = 0; k < d; ++k) {
    place += f->damper[k];
  }
  return place;
}

static inline int filter_moving(const PlantFilter* f) { return filter_own(f, f->dampers); }

static inline int filter_all(const PlantFilter* f) { return filter_moving(f) + f->sensors; }

/* Where the memory of damper d stands; behind the last: the end of an estimate. */
static inline int filter_memory(const PlantFilter* f, int d) {
  int place = filter_all(f), k;
  for (k = 0; k < d; ++k) {
    place += 3 * f->memory[k];
  }
  return place;
}

/* Where the state of damper d stands, estimated or carried along. */
static inline int filter_state(const PlantFilter* f, int d) {
  return (f->memory[d] > 0) ? filter_memory(f, d) : filter_own(f, d);
}

/* What is given at a sample: the inputs and the drives behind them. */
static inline int filter_given(const PlantFilter* f) { return f->inputs + f->drives; }

/* Where the drive of damper d stands among these. */
static inline int filter_drive(const PlantFilter* f, int d) {
  return f->inputs + ((f->drives > 1) ? d : 0);
}

/* The motion of a damper and its drive. */
static inline void filter_input(const PlantFilter* f, int d, const double* inputs,
                                const double* slopes, const double* plant, DamperInput* at) {
  const int half = f->plant / 2;
  const double* way = &f->deflection[d * half];
  int k;
  at->displacement = 0;
  at->velocity = 0;
  at->current = inputs[filter_drive(f, d)];
  for (k = 0; k < half; ++k) {
    at->displacement += way[k] * plant[k];
    at->velocity += way[k] * plant[half + k];
  }
  for (k = 0; k < f->inputs; ++k) {
    at->displacement -= f->on_ground[(d * f->inputs) + k] * inputs[k];
    at->velocity -= f->on_ground[(d * f->inputs) + k] * slopes[k];
  }
}

/* Shifts the velocity of damper d, now or after a step, to that by which its force goes. */
static inline void filter_shift_motion(const PlantFilter* f, int d, const double* s, int after,
                                       DamperInput* at) {
  if (f->shifts > 0) {
    at->velocity += ((after != 0) ? f->error_keep[f->errors] : 1) * s[filter_shift(f, d)];
  }
}

/* All errors of a damper's force, now and after a step. */
static inline double filter_errors(const PlantFilter* f, int d, const double* s, int after) {
  double sum = 0;
  int k;
  for (k = 0; k < f->errors; ++k) {
    sum += ((after != 0) ? f->error_keep[k] : 1) * s[filter_error(f, d) + k];
  }
  return sum;
}

/* The plant after a step, under inputs and forces that go straight. */
static inline void filter_linear(const PlantFilter* f, const double* from, const double* to,
                                 const double* roads, const double* force_start,
                                 const double* force_end, const double* plant, double* end) {
  const int first = f->inputs + f->roads, acting = first + f->dampers;
  int i, k;
  for (i = 0; i < f->plant; ++i) {
    const double* by_start = &f->by_start[i * acting];
    const double* by_end = &f->by_end[i * acting];

    /* The forces; the first damper's begin the sum. */
    double sum = (by_start[first] * force_start[0]) + (by_end[first] * force_end[0]);
    for (k = 1; k < f->dampers; ++k) {
      sum += (by_start[first + k] * force_start[k]) + (by_end[first + k] * force_end[k]);
    }

    /* The plant as it was, the inputs, and the roads, which stand still over a step. */
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
  for (k = 0; k < filter_given(f); ++k) {
    slopes[k] = (now[k] - before[k]) / (f->step * (double)f->steps);
  }
}

/* The step of a difference: as far as the number is uncertain, and not less than its table says. A
 * tangent would claim more than is known where the force bends. */
static inline double filter_difference(double least, double variance) {
  return (variance > (least * least)) ? sqrt(variance) : least;
}

/* How far what a damper's force goes by is uncertain: displacement, velocity with its shift, then
 * the numbers of its state. */
static inline void filter_reach(const PlantFilter* f, int d, const double* c, double* reach) {
  const int half = f->plant / 2, all = filter_all(f), own = filter_own(f, d);
  const int shift = filter_shift(f, d);
  const double* along = &f->deflection[d * half];
  double way = 0, speed = 0;
  int i, k;

  /* Variances of its motion, by those of the plant and by the shift's. */
  for (i = 0; i < half; ++i) {
    for (k = 0; k < half; ++k) {
      const double both = along[i] * along[k];
      way += both * c[(i * all) + k];
      speed += both * c[((half + i) * all) + half + k];
    }
  }
  if (f->shifts > 0) {
    speed += c[(shift * all) + shift];
    for (k = 0; k < half; ++k) {
      speed += 2 * along[k] * c[(shift * all) + half + k];
    }
  }

  /* As far as each is uncertain, or its table says. */
  reach[0] = filter_difference(f->way, way);
  reach[1] = filter_difference(f->speed, speed);
  for (k = 0; k < f->damper[d]; ++k) {
    reach[2 + k] = filter_difference(f->difference[own + k], c[((own + k) * all) + own + k]);
  }
}

/* Brings the state of damper d over a step; beside a memory those of a damper that is always so
 * much faster and slower, which stand behind it. */
static inline void filter_go(const PlantFilter* f, int d, const DamperInput* first,
                             const DamperInput* last, double speed, double* z) {
  int side;
  filter_advance(f, d, first, last, f->step, z);
  for (side = 0; (side < 2) && (f->memory[d] > 0); ++side) {
    const double by_much = (side == 0) ? speed : -speed;
    DamperInput from = *first, to = *last;
    from.velocity += by_much;
    to.velocity += by_much;
    filter_advance(f, d, &from, &to, f->step, &z[(1 + side) * f->memory[d]]);
  }
}

/* What a model's force depends on: displacement, velocity, then each number of its state; by
 * differences to both sides. By the velocity a memory changes too, as it would if the difference
 * had been there all along. */
static inline void filter_by_force(const PlantFilter* f, int d, const DamperInput* at,
                                   const double* z, const double* reach, double* by) {
  double beside_z[FILTER_MOST_DAMPER];
  int k, side;
  for (k = 0; k < f->damper[d]; ++k) {
    beside_z[k] = z[k];
  }

  /* One after the other a little more and a little less. */
  by[0] = 0;
  for (k = (f->by_way[d] > 0) ? 0 : 1; k < (2 + f->damper[d]); ++k) {
    double force[2];
    for (side = 0; side < 2; ++side) {
      const double by_much = (side == 0) ? reach[k] : -reach[k];
      const double* state = z;
      DamperInput beside = *at;
      if (k == 0) {
        beside.displacement += by_much;
      } else if (k == 1) {
        beside.velocity += by_much;
        state = &z[(1 + side) * f->memory[d]];
      } else {
        beside_z[k - 2] = z[k - 2] + by_much;
        state = beside_z;
      }
      force[side] = filter_force(f, d, &beside, state);
    }
    if (k > 1) {
      beside_z[k - 2] = z[k - 2];
    }
    by[k] = (force[0] - force[1]) / (2 * reach[k]);
  }
}

/* The same of the state after a step: it depends on displacement and velocity at the start, then
 * at the end, then on each of its numbers; a row of these per number. */
static inline void filter_by_state(const PlantFilter* f, int d, const DamperInput* first,
                                   const DamperInput* last, const double* z, const double* reach,
                                   double* by) {
  const int size = f->damper[d], width = 4 + size;
  int i, k, side;

  /* One after the other a little more and a little less. */
  for (k = 0; (k < width) && (size > 0); ++k) {
    const double by_much = (k < 4) ? reach[k % 2] : reach[k - 2];
    double after[2 * FILTER_MOST_DAMPER];
    for (side = 0; side < 2; ++side) {
      const double sign = (side == 0) ? 1 : -1;
      DamperInput from = *first, to = *last;
      for (i = 0; i < size; ++i) {
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
      filter_advance(f, d, &from, &to, f->step, &after[side * FILTER_MOST_DAMPER]);
    }
    for (i = 0; i < size; ++i) {
      by[(i * width) + k] = (after[i] - after[FILTER_MOST_DAMPER + i]) / (2 * by_much);
    }
  }
}

/* A small change of a damper: of its motion at both ends of a step, of its force there, of the
 * errors that are left at the end, and of its state there. */
typedef struct FilterChange {
  double motion[4], start, after, kept;
  double z[FILTER_MOST_DAMPER];
} FilterChange;

/* The change of a damper at the start of a step, by a column of the transition. */
static inline void filter_begin_column(const PlantFilter* f, int d, const FilterDamper* over,
                                       const double* column, int size, FilterChange* change) {
  const int half = f->plant / 2, error = filter_error(f, d), own = filter_own(f, d);
  double errors = 0;
  int k;

  /* What its force goes by, and the errors, with what is left of them after the step. */
  change->motion[0] = 0;
  change->motion[1] = 0;
  change->kept = 0;
  for (k = 0; k < half; ++k) {
    change->motion[0] += f->deflection[(d * half) + k] * column[k * size];
    change->motion[1] += f->deflection[(d * half) + k] * column[(half + k) * size];
  }
  if (f->shifts > 0) {
    change->motion[1] += column[filter_shift(f, d) * size];
  }
  for (k = 0; k < f->errors; ++k) {
    errors += column[(error + k) * size];
    change->kept += f->error_keep[k] * column[(error + k) * size];
  }

  /* The force by all of these and by its state. */
  change->start =
      (over->by_first[0] * change->motion[0]) + (over->by_first[1] * change->motion[1]) + errors;
  for (k = 0; k < f->damper[d]; ++k) {
    change->start += over->by_first[2 + k] * column[(own + k) * size];
  }
}

/* The same at the end, where the plant changes by `end`. */
static inline void filter_end_column(const PlantFilter* f, int d, const FilterDamper* over,
                                     const double* end, const double* column, int size,
                                     FilterChange* change) {
  const int half = f->plant / 2, own = filter_own(f, d), width = 4 + f->damper[d];
  int i, k;

  /* What its force goes by there, and the force by that and by the errors that are left. */
  change->motion[2] = 0;
  change->motion[3] = 0;
  for (k = 0; k < half; ++k) {
    change->motion[2] += f->deflection[(d * half) + k] * end[k];
    change->motion[3] += f->deflection[(d * half) + k] * end[half + k];
  }
  if (f->shifts > 0) {
    change->motion[3] += f->error_keep[f->errors] * column[filter_shift(f, d) * size];
  }
  change->after = (over->by_last[0] * change->motion[2]) + (over->by_last[1] * change->motion[3]) +
                  change->kept;

  /* Its state, and the force by that. */
  for (i = 0; i < f->damper[d]; ++i) {
    change->z[i] = 0;
    for (k = 0; k < 4; ++k) {
      change->z[i] += over->by_state[(i * width) + k] * change->motion[k];
    }
    for (k = 0; k < f->damper[d]; ++k) {
      change->z[i] += over->by_state[(i * width) + 4 + k] * column[(own + k) * size];
    }
    change->after += over->by_last[2 + i] * change->z[i];
  }
}

/* The dependence of a step on one number before it, a column of the transition, through the same
 * step with what the dampers depend on. */
static inline void filter_move_column(const PlantFilter* f, const FilterDamper* over,
                                      double* column, int size) {
  FilterChange change[FILTER_MOST_DAMPERS];
  double end[FILTER_MOST];
  const int first = f->inputs + f->roads, acting = first + f->dampers;
  int d, i, k, pass;
  for (d = 0; d < f->dampers; ++d) {
    filter_begin_column(f, d, &over[d], column, size, &change[d]);
    change[d].after = change[d].start;
  }

  /* The plant at the end, by the forces at the start; those at the end; and once more by them. */
  for (pass = 0; pass < 2; ++pass) {
    for (i = 0; i < f->plant; ++i) {
      const double* by_start = &f->by_start[i * acting];
      const double* by_end = &f->by_end[i * acting];
      double sum = (by_start[first] * change[0].start) + (by_end[first] * change[0].after);
      for (d = 1; d < f->dampers; ++d) {
        sum += (by_start[first + d] * change[d].start) + (by_end[first + d] * change[d].after);
      }
      for (k = 0; k < f->plant; ++k) {
        sum += f->transition[(i * f->plant) + k] * column[k * size];
      }
      for (k = 0; k < f->roads; ++k) {
        sum += (by_start[f->inputs + k] + by_end[f->inputs + k]) * column[(f->plant + k) * size];
      }
      end[i] = sum;
    }
    for (d = 0; d < f->dampers; ++d) {
      filter_end_column(f, d, &over[d], end, column, size, &change[d]);
    }
  }

  /* All of it behind the step. */
  for (k = 0; k < f->plant; ++k) {
    column[k * size] = end[k];
  }
  for (k = 0; k < f->roads; ++k) {
    column[(f->plant + k) * size] *= f->road_keep;
  }
  for (d = 0; d < f->dampers; ++d) {
    for (k = 0; k < (f->errors + f->shifts); ++k) {
      column[(filter_error(f, d) + k) * size] *= f->error_keep[k];
    }
    for (k = 0; k < f->damper[d]; ++k) {
      column[(filter_own(f, d) + k) * size] = change[d].z[k];
    }
  }
}

/* A step of damper d from its motion `over->first` along a way to where the plant arrives under the
 * forces at the start: its force there with its errors, and what depends on what. Its memory, which
 * costs most, is brought along this way, and once the sensors were looked at along what they told:
 * filter_remember(). */
static inline double filter_look(const PlantFilter* f, int d, const double* c, double* s,
                                 FilterDamper* over) {
  double reach[FILTER_MOST_DAMPER + 2], z[FILTER_MOST_DAMPER + (3 * FILTER_MOST_MEMORY)];
  const double* own = &s[filter_state(f, d)];
  const int size = f->damper[d] + (3 * f->memory[d]);
  int k;
  for (k = 0; k < size; ++k) {
    z[k] = own[k];
  }
  filter_reach(f, d, c, reach);
  filter_go(f, d, &over->first, &over->last, reach[1], z);
  filter_by_force(f, d, &over->first, own, reach, over->by_first);
  filter_by_force(f, d, &over->last, z, reach, over->by_last);
  filter_by_state(f, d, &over->first, &over->last, own, reach, over->by_state);
  for (k = 0; k < (3 * f->memory[d]); ++k) {
    s[filter_memory(f, d) + k] = z[k];
  }
  return filter_force(f, d, &over->last, z) + filter_errors(f, d, s, 1);
}

/* Brings what moves from one sample to the next, and gives the transition: how it depends on what
 * was before. The forces at the end of a step are first found from the motion that those at its
 * start would give. */
static inline void filter_move(const PlantFilter* f, const double* before, const double* now,
                               const double* c, double* s, double* transition) {
  double slopes[FILTER_MOST_INPUTS + FILTER_MOST_DAMPERS],
      from[FILTER_MOST_INPUTS + FILTER_MOST_DAMPERS], to[FILTER_MOST_INPUTS + FILTER_MOST_DAMPERS];
  double end[FILTER_MOST], start[FILTER_MOST_DAMPERS], after[FILTER_MOST_DAMPERS];
  FilterDamper over[FILTER_MOST_DAMPERS];
  const int moving = filter_moving(f);
  int d, j, k, step;
  filter_slopes(f, before, now, slopes);
  for (k = 0; k < filter_given(f); ++k) {
    to[k] = before[k];
  }
  for (k = 0; k < moving; ++k) {
    for (j = 0; j < moving; ++j) {
      transition[(k * moving) + j] = (j == k) ? 1 : 0;
    }
  }
  for (step = 1; step <= f->steps; ++step) {
    for (k = 0; k < filter_given(f); ++k) {
      from[k] = to[k];
      to[k] = before[k] + (slopes[k] * f->step * (double)step);
    }
    for (d = 0; d < f->dampers; ++d) {
      filter_input(f, d, from, slopes, s, &over[d].first);
      filter_shift_motion(f, d, s, 0, &over[d].first);
      start[d] =
          filter_force(f, d, &over[d].first, &s[filter_state(f, d)]) + filter_errors(f, d, s, 0);
    }
    filter_linear(f, from, to, &s[f->plant], start, start, s, end);

    /* What depends on what, before the state is overwritten. */
    for (d = 0; d < f->dampers; ++d) {
      filter_input(f, d, to, slopes, end, &over[d].last);
      filter_shift_motion(f, d, s, 1, &over[d].last);
      after[d] = filter_look(f, d, c, s, &over[d]);
    }
    for (j = 0; j < moving; ++j) {
      filter_move_column(f, over, &transition[j], moving);
    }

    filter_linear(f, from, to, &s[f->plant], start, after, s, end);
    for (d = 0; d < f->dampers; ++d) {
      filter_input(f, d, to, slopes, end, &over[d].last);
      filter_shift_motion(f, d, s, 1, &over[d].last);
      if (f->memory[d] == 0) {
        filter_advance(f, d, &over[d].first, &over[d].last, f->step, &s[filter_own(f, d)]);
      }
      for (k = 0; k < (f->errors + f->shifts); ++k) {
        s[filter_error(f, d) + k] *= f->error_keep[k];
      }
    }
    for (k = 0; k < f->plant; ++k) {
      s[k] = end[k];
    }
    for (k = 0; k < f->roads; ++k) {
      s[f->plant + k] *= f->road_keep;
    }
  }
}

/* What half a sample adds to the covariance of the shifts. They change by chance between samples:
 * half of that before a transition, through which it moves the plant, and half behind it. */
static inline void filter_spread_shifts(const PlantFilter* f, double* c) {
  const int all = filter_all(f);
  int d;
  for (d = 0; (f->shifts > 0) && (d < f->dampers); ++d) {
    c[(filter_shift(f, d) * all) + filter_shift(f, d)] += f->shift_added;
  }
}

/* The covariance after a step with this transition: of what moves among itself, then with the
 * offsets. */
static inline void filter_spread(const PlantFilter* f, const double* transition, double* c) {
  double product[FILTER_MOST * FILTER_MOST];
  const int moving = filter_moving(f), all = filter_all(f);
  int i, j, k;
  filter_spread_shifts(f, c);

  /* The transition times the covariance. */
  for (i = 0; i < moving; ++i) {
    for (j = 0; j < all; ++j) {
      double sum = 0;
      for (k = 0; k < moving; ++k) {
        sum += transition[(i * moving) + k] * c[(k * all) + j];
      }
      product[(i * all) + j] = sum;
    }
  }

  /* That times the transition from the other side, and what a sample adds. */
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
  filter_spread_shifts(f, c);
}

/* From the sample before to this one, before its sensors are looked at. */
static inline void filter_predict(const PlantFilter* f, const double* before, const double* now,
                                  double* s, double* c, double* transition) {
  filter_move(f, before, now, c, s, transition);
  filter_spread(f, transition, c);
}

/* The force of damper d with its errors, and what it depends on, one number per moving one. */
static inline double filter_gradient(const PlantFilter* f, int d, const DamperInput* at,
                                     const double* s, const double* c, double* gradient) {
  double reach[FILTER_MOST_DAMPER + 2], by[FILTER_MOST_DAMPER + 2];
  const int half = f->plant / 2, error = filter_error(f, d), own = filter_own(f, d);
  const int moving = filter_moving(f);
  DamperInput shifted = *at;
  int k;

  /* Slopes of its model, as far as what it goes by is uncertain. */
  filter_shift_motion(f, d, s, 0, &shifted);
  filter_reach(f, d, c, reach);
  filter_by_force(f, d, &shifted, &s[filter_state(f, d)], reach, by);

  /* By the plant, then by its own errors, shift and state; by nothing of the others. */
  for (k = 0; k < half; ++k) {
    gradient[k] = by[0] * f->deflection[(d * half) + k];
    gradient[half + k] = by[1] * f->deflection[(d * half) + k];
  }
  for (k = f->plant; k < moving; ++k) {
    gradient[k] = 0;
  }
  for (k = 0; k < f->errors; ++k) {
    gradient[error + k] = 1;
  }
  if (f->shifts > 0) {
    gradient[filter_shift(f, d)] = by[1];
  }
  for (k = 0; k < f->damper[d]; ++k) {
    gradient[own + k] = by[2 + k];
  }
  return filter_force(f, d, &shifted, &s[filter_state(f, d)]) + filter_errors(f, d, s, 0);
}

/* What each sensor depends on at an estimate, a row of `sample` each, and what it shows beyond what
 * is expected of it there, as its innovation. */
static inline void filter_expect(const PlantFilter* f, const double* before, const double* now,
                                 const double* measured, const double* s, const double* c,
                                 FilterSample* sample) {
  double slopes[FILTER_MOST_INPUTS + FILTER_MOST_DAMPERS],
      gradient[FILTER_MOST_DAMPERS * FILTER_MOST];
  double force[FILTER_MOST_DAMPERS];
  const int moving = filter_moving(f), all = filter_all(f);
  int d, k, m;
  filter_slopes(f, before, now, slopes);
  for (d = 0; d < f->dampers; ++d) {
    DamperInput at;
    filter_input(f, d, now, slopes, s, &at);
    force[d] = filter_gradient(f, d, &at, s, c, &gradient[d * FILTER_MOST]);
  }
  for (m = 0; m < f->sensors; ++m) {
    /* By the dampers' forces. */
    const double* by_force = &f->sensor_force[m * f->dampers];
    double* row = &sample->rows[m * all];
    double beyond = measured[m] - (by_force[0] * force[0]);
    for (k = 0; k < moving; ++k) {
      row[k] = by_force[0] * gradient[k];
    }
    for (d = 1; d < f->dampers; ++d) {
      beyond -= by_force[d] * force[d];
      for (k = 0; k < moving; ++k) {
        row[k] += by_force[d] * gradient[(d * FILTER_MOST) + k];
      }
    }

    /* By the sensor's own offset, the plant, the roads and the inputs. */
    beyond -= s[moving + m];
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
    sample->innovation[m] = beyond;
  }
}

/* Takes the sensors in, one after the other, as they were expected. One that shows no number is
 * left out. */
static inline void filter_take(const PlantFilter* f, double* s, double* c, FilterSample* sample) {
  double change[FILTER_MOST], with[FILTER_MOST];
  const int all = filter_all(f);
  int i, k, m;
  for (k = 0; k < all; ++k) {
    change[k] = 0;
  }
  for (m = 0; m < f->sensors; ++m) {
    const double* row = &sample->rows[m * all];
    double beyond = sample->innovation[m], variance = f->sensor_variance[m];

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

/* What the sensors show now, taken in. */
static inline void filter_update(const PlantFilter* f, const double* before, const double* now,
                                 const double* measured, double* s, double* c,
                                 FilterSample* sample) {
  filter_expect(f, before, now, measured, s, c, sample);
  filter_take(f, s, c, sample);
}

/* Brings the memory of damper d along its motion from the sample before to this one, straight in
 * between: from what it was there, `past`. */
static inline void filter_carry(const PlantFilter* f, int d, const DamperInput* start,
                                const DamperInput* end, const double* c, const double* past,
                                double* z) {
  double reach[FILTER_MOST_DAMPER + 2];
  DamperInput from, to = *start;
  int k, step;
  for (k = 0; k < (3 * f->memory[d]); ++k) {
    z[k] = past[k];
  }
  filter_reach(f, d, c, reach);
  for (step = 1; step <= f->steps; ++step) {
    const double share = (double)step / (double)f->steps;
    from = to;
    to.displacement = start->displacement + (share * (end->displacement - start->displacement));
    to.velocity = start->velocity + (share * (end->velocity - start->velocity));
    to.current = start->current + (share * (end->current - start->current));
    filter_go(f, d, &from, &to, reach[1], z);
  }
}

/* Brings all memories along the motion that is told, from the estimate at the sample before to s.
 */
static inline void filter_remember(const PlantFilter* f, const double* before, const double* now,
                                   const double* past, const double* c, double* s) {
  double slopes[FILTER_MOST_INPUTS + FILTER_MOST_DAMPERS];
  int d;
  filter_slopes(f, before, now, slopes);
  for (d = 0; d < f->dampers; ++d) {
    const int place = filter_memory(f, d);
    DamperInput start, end;
    filter_input(f, d, before, slopes, past, &start);
    filter_shift_motion(f, d, past, 0, &start);
    filter_input(f, d, now, slopes, s, &end);
    filter_shift_motion(f, d, s, 0, &end);
    if (f->memory[d] > 0) {
      filter_carry(f, d, &start, &end, c, &past[place], &s[place]);
    }
  }
}

/* Damper d now, after filter_update(): its force with its errors, N; the standard deviation of
 * that; its deflection and the rate of it. */
static inline void filter_damper(const PlantFilter* f, int d, const double* before,
                                 const double* now, const double* s, const double* c, double* out) {
  double slopes[FILTER_MOST_INPUTS + FILTER_MOST_DAMPERS], gradient[FILTER_MOST];
  const int moving = filter_moving(f), all = filter_all(f);
  DamperInput at;
  double variance = 0;
  int i, k;
  filter_slopes(f, before, now, slopes);
  filter_input(f, d, now, slopes, s, &at);
  out[0] = filter_gradient(f, d, &at, s, c, gradient);
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
