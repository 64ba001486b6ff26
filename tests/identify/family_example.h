#pragma once
#include <cmath>
#include <string>
#include <vector>

#include "dashpot/dataset.h"
#include "dashpot/drive.h"

namespace dashpot {

/// Two lengths, two gaps, two fluids, at two field levels: a friction that grows with the yield
/// stress and a viscous force. Three cycles of 24 samples each. Made up; nothing was measured.
inline Dataset small_family() {
  Dataset family;
  family.name = "small";
  family.drive_unit = DriveUnit::Ampere;
  for (const double viscosity : {0.28, 0.042})
    for (const double length : {0.006, 0.01})
      for (const double gap : {0.001, 0.002})
        for (const double yield : {1e3, 4e4}) {
          Record record;
          record.condition = "damper " + std::to_string(family.records.size() / 2);
          record.name = record.condition + ", " + std::to_string(yield) + " Pa";
          record.sample_time = 0.1;
          record.conditions = {{"viscosity", viscosity}, {"piston_area", 1.6e-4},
                               {"gap_area", 2.5e-5},     {"gap", gap},
                               {"pole_length", length},  {"yield_stress", yield}};
          Channel x{"displacement", "m", {}, ""}, v{"velocity", "m/s", {}, ""},
              f{"force", "N", {}, ""}, i{"current", "A", {}, ""};
          for (int k = 0; k < 72; ++k) {
            const double angle = 2 * 3.14159265358979 * (k - 3.5) / 24;
            record.time.push_back(0.1 * k);
            x.samples.push_back(-0.01 * std::cos(angle));
            v.samples.push_back(0.03 * std::sin(angle));
            i.samples.push_back(yield / 4e4);
            f.samples.push_back(length / gap * (10 * viscosity + 1e-5 * yield) *
                                std::tanh(2 * std::sin(angle)));
          }
          record.channels = {x, v, f, i};
          record.drive_level = yield / 4e4;
          family.records.push_back(std::move(record));
        }
  return family;
}

}  // namespace dashpot
