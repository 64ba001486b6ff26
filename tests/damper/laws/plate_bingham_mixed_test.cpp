#include "dashpot/damper/laws/plate_bingham_mixed.h"

#include "dashpot/damper/laws/plate_bingham.h"
#include "support.h"

TEST_CASE("plate_bingham_mixed: the Newtonian force with the drag of the land is TC-3.3's") {
  const double area = 1.6029e-4, gap_area = 2.487e-5;
  const PlateBinghamMixed p{.c0 = 12 * 0.28 * 6e-3 * area * area / (gap_area * 1e-6),
                            .f_y = 0,
                            .a = gap_area / area,
                            .f0 = 0,
                            .v_s = 0};
  CHECK_CLOSE(plate_bingham_mixed_force(&p, 0, 0.034, nullptr), 0.82367092, 1e-8, 0);
  CHECK_CLOSE(plate_bingham_mixed_force(&p, 0, -0.034, nullptr), -0.82367092, 1e-8, 0);
}

TEST_CASE(
    "plate_bingham_mixed: the value of TC-5.1b against the flow, plus the drag; plate_bingham "
    "when a = "
    "0") {
  // T = 2/3 and |V| = a / 2 = 0.05 at c0 |v| = 1; the drag's closed form is tested with
  // plate_wall_drag.
  const double pressure = 2.90979824,
               drag = 0.1 * (pressure / 2 + 0.1 / 12 * pressure / (pressure - 4.0 / 3));
  const PlateBinghamMixed p{.c0 = 1, .f_y = 4.0 / 3, .a = 0.1, .f0 = 0.5, .v_s = 0};
  CHECK_CLOSE(plate_bingham_mixed_force(&p, 0, 1, nullptr), pressure + drag + 0.5, 1e-7, 0);
  CHECK(plate_bingham_mixed_force(&p, 0, 0, nullptr) == 0.5);
  const PlateBinghamMixed at_rest{.c0 = 1120, .f_y = 800, .a = 0, .f0 = 3, .v_s = 0};
  const PlateBingham valve{.c0 = 1120, .f_y = 800, .f0 = 3, .v_s = 0};
  for (const double v : {-0.3, 1e-9, 0.02})
    CHECK_CLOSE(plate_bingham_mixed_force(&at_rest, 0, v, nullptr),
                plate_bingham_force(&valve, 0, v, nullptr), 1e-15, 0);
}
