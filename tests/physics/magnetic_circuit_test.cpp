#include "dashpot/physics/magnetic_circuit.h"

#include "support.h"

TEST_CASE("the family paper's magnetic circuit gives TC-3.2") {
  const MagneticCircuit circuit{.turns = 200,
                                .core_length = 0.06,
                                .gap_length = 0.002,
                                .area = 6.4e-5,
                                .permeability = 2000,
                                .saturation = 1.5,
                                .gap_permeability = 1};
  CHECK_CLOSE(core_reluctance(&circuit), 373019.4, 1e-7, 0);
  CHECK_CLOSE(gap_reluctance(&circuit), 24867960, 2e-8, 0);
  CHECK_CLOSE(magnetic_flux(&circuit, 1), 7.9236229e-06, 1e-8, 0);
  CHECK_CLOSE(magnetic_flux(&circuit, 10) / circuit.area, 1.2380661, 4e-8, 0);
  CHECK_CLOSE(circuit_flux_density(&circuit, 1), 0.11436701, 5e-8, 0);
  CHECK_CLOSE(circuit_flux_density(&circuit, 10), 0.67825212, 1e-8, 0);
  CHECK_CLOSE(circuit_flux_density(&circuit, -10), -0.67825212, 1e-8, 0);
}

TEST_CASE(
    "current to yield stress: TC-3.2b, and within 12 Pa the inputs of the published data set") {
  const double flux_density[] = {0.38871269, 0.60853272, 0.74988865, 0.84842939,
                                 0.92104884, 0.97678608, 1.02091511};
  const double field[] = {35.587409,  71.678113,  105.562021, 135.426660,
                          161.183219, 183.303507, 202.356364};
  const double stress[] = {20121.717, 34513.214, 44914.487, 51686.399,
                           55792.833, 58081.816, 59164.705};
  const double published[] = {20122.8539, 34514.5968, 44913.555, 51685.2669,
                              55789.03,   58081.95,   59176.47};
  for (int k = 0; k < 7; ++k) {
    const double b = saturated_flux_density(2.15216 * 0.25 * (k + 1), 1.40056);
    const double h = family_field(&kFamily140CG, b), tau = family_yield_stress(&kFamily140CG, h);
    // The two numbers that make the flux density are given to six digits.
    CHECK_CLOSE(b, flux_density[k], 2e-6, 0);
    CHECK_CLOSE(h, 1e3 * field[k], 2.5e-6, 0);
    CHECK_CLOSE(tau, stress[k], 2e-6, 0);
    CHECK_CLOSE(tau, published[k], 0, 12);
  }
}
