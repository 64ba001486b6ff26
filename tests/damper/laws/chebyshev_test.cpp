#include "dashpot/damper/laws/chebyshev.h"

#include "support.h"

TEST_CASE("the restoring-force surface gives the force of TC-4.12") {
  Chebyshev p{};
  p.f0 = 10, p.c01 = 200;
  p.c10 = 300, p.c11 = -20, p.c12 = 5;
  p.c21 = 15, p.c22 = -8;
  p.x_mid = 0.001, p.x_half = 0.02, p.v_half = 0.5;
  CHECK_CLOSE(chebyshev_force(&p, 0.001 + 0.3 * 0.02, -0.6 * 0.5, nullptr), -11.2768, 0, 1e-10);
}

TEST_CASE("each coefficient multiplies its own pair: T_j(cos h) = cos(j h)") {
  double Chebyshev::* const coefficients[3][6] = {
      {&Chebyshev::f0, &Chebyshev::c01, &Chebyshev::c02, &Chebyshev::c03, &Chebyshev::c04,
       &Chebyshev::c05},
      {&Chebyshev::c10, &Chebyshev::c11, &Chebyshev::c12, &Chebyshev::c13, &Chebyshev::c14,
       &Chebyshev::c15},
      {&Chebyshev::c20, &Chebyshev::c21, &Chebyshev::c22, &Chebyshev::c23, &Chebyshev::c24,
       &Chebyshev::c25}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 6; ++j) {
      Chebyshev p{};
      p.x_half = 1, p.v_half = 1;
      p.*coefficients[i][j] = 1;
      const double force = chebyshev_force(&p, std::cos(0.7), std::cos(2.1), nullptr);
      CHECK_CLOSE(force, std::cos(0.7 * i) * std::cos(2.1 * j), 0, 1e-14);
    }
}

TEST_CASE("outside the data the surface is held at its edge") {
  Chebyshev p{};
  p.c05 = 100, p.c21 = 30, p.x_half = 0.02, p.v_half = 0.5;
  CHECK(chebyshev_force(&p, 1, 10, nullptr) == chebyshev_force(&p, 0.02, 0.5, nullptr));
  CHECK(chebyshev_force(&p, -1, -10, nullptr) == chebyshev_force(&p, -0.02, -0.5, nullptr));
}
