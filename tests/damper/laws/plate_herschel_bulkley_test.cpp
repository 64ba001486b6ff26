#include "dashpot/damper/laws/plate_herschel_bulkley.h"

#include "dashpot/damper/laws/plate_bingham.h"
#include "support.h"

TEST_CASE("plate_herschel_bulkley gives the pressures of TC-5.2, times the piston's area") {
  const double area = 1.6029e-4, v_r = 0.1;
  const PlateGap gap{.length = 6e-3, .width = 0.02487, .height = 1e-3};
  const auto pressure = [&](double n, double consistency, double v) {
    const PlateHerschelBulkley p{
        .f_v = area * plate_power_law_pressure(&gap, consistency, n, area * v_r),
        .f_y = area * plate_yield_pressure(&gap, 20122.8539),
        .n = n,
        .v_r = v_r,
        .f0 = 0,
        .v_s = 0,
    };
    CHECK(plate_herschel_bulkley_force(&p, 0, -v, nullptr) ==
          -plate_herschel_bulkley_force(&p, 0, v, nullptr));
    return plate_herschel_bulkley_force(&p, 0, v, nullptr) / area;
  };
  CHECK_CLOSE(pressure(1, 0.28, 0.034), 270197.19, 3e-8, 0);
  CHECK_CLOSE(pressure(0.7, 3, 0.034), 266658.75, 3e-8, 0);
  CHECK_CLOSE(pressure(0.7, 3, 0.3), 307989.86, 3e-8, 0);
  CHECK_CLOSE(pressure(0.5, 15, 0.034), 264041.9, 3e-7, 0);
  CHECK_CLOSE(pressure(0.5, 15, 0.3), 289923.66, 3e-8, 0);
}

TEST_CASE(
    "plate_herschel_bulkley with n = 1 is plate_bingham, and the offset alone at standstill") {
  const PlateHerschelBulkley p{.f_v = 300, .f_y = 800, .n = 1, .v_r = 0.25, .f0 = 7, .v_s = 0.001};
  const PlateBingham bingham{.c0 = 1200, .f_y = 800, .f0 = 7, .v_s = 0.001};
  for (const double v : {-0.5, -1e-4, 0.0, 1e-6, 0.03, 2.0})
    CHECK_CLOSE(plate_herschel_bulkley_force(&p, 0, v, nullptr),
                plate_bingham_force(&bingham, 0, v, nullptr), 1e-12, 0);
}
