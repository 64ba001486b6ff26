/* A step of a law whose first state moves with the displacement, as C99 text that the library takes
 * in once per law and the C export ships. Declared before: LawParameters and law_travel, which
 * gives z after a displacement s of either sign.
 */

/* z after a step of length h in which v goes linearly from v[0] to v[1]: one travel, or two where v
 * changes its sign. */
static inline double law_travel_step(const LawParameters* p, const double* v, double h, double z) {
  double moved = z;
  if (v[0] * v[1] >= 0) {
    moved = law_travel(p, moved, 0.5 * h * (v[0] + v[1]));
  } else {
    const double turn = h * v[0] / (v[0] - v[1]);
    moved = law_travel(p, moved, 0.5 * turn * v[0]);
    moved = law_travel(p, moved, 0.5 * (h - turn) * v[1]);
  }
  return moved;
}
