#include "dashpot/damper/laws/viscous_dahl.h"

#include "damper/laws/sine_drive.h"
#include "dashpot/damper/registry.h"

using namespace dashpot;

TEST_CASE("viscous and Dahl: TC-4.13, 0 V") {
  // The set of docs/sources.md in SI: 0.7682 N*s/mm, 57.42 N, 27.45 mm^-1
  const LawModel model = LawModel::constant(find_law("viscous_dahl"), {768.2, 57.42, 27450, 0});
  check_forces(at_times(model, {0.012375, 0.8403}, {0.05, 0.2, 0.5, 1, 2}),
               {105.87312, 82.13446, -101.42628, 84.394005, -78.619315});
}

TEST_CASE("viscous and Dahl is the normalised Bouc-Wen law with sigma = 1, n = 1") {
  const LawModel one = LawModel::constant(find_law("viscous_dahl"), {768.2, 57.42, 27450, 5});
  const LawModel other =
      LawModel::constant(find_law("normalised_bouc_wen"), {768.2, 57.42, 27450, 1, 1, 5});
  const auto a = at_times(one, {0.012375, 0.8403}, {0.05, 0.31, 0.5, 0.93}, 1e-3);
  const auto b = at_times(other, {0.012375, 0.8403}, {0.05, 0.31, 0.5, 0.93}, 1e-3);
  for (std::size_t k = 0; k < a.size(); ++k) CHECK_CLOSE(a[k].force, b[k].force, 1e-12, 0);
}
