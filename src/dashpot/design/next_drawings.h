#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "dashpot/damper/bench_test.h"
#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/design/design_request.h"
#include "dashpot/monitor.h"

namespace dashpot {

// Which prototype next? A family of physics knows how well its recordings have told its numbers
// (FamilyPhysics::information), and how builds differ from their drawings. The drawings that are
// proposed are those whose recording would leave the least mean square of what the family does not
// know of the force, over the drawings of a request and the tests (an I-optimal design, the fit
// linearised about the numbers found): picked one by one, and then exchanged while that gains. They
// keep to the inner part of each range, for a model is not the truth: G. E. P. Box, N. R. Draper,
// J. Am. Stat. Assoc. 54 (1959) 622-654, recalled. Fedorov, Theory of Optimal Experiments, 1972;
// Atkinson, Donev, Tobias, Optimum Experimental Designs, with SAS, 2007.

/// One recording: a sine at a constant current.
struct DrawingTest {
  SineMotion motion;
  double current = 0;  ///< A
};

struct NextOptions {
  std::size_t count = 1;           ///< drawings wanted
  std::vector<DrawingTest> tests;  ///< that each is to go through; one at least
  std::uint64_t seed = 1;
  int threads = 0;  ///< the result does not depend on it
  Monitor monitor;
};

/// A drawing to be built and recorded.
struct NextDrawing {
  DamperDescription damper;
  double band = 0;  ///< of the region, as in NextReport, once it and those before are recorded
  /// Places of NextOptions::tests, the one that tells most first, and the band once the recordings
  /// up to it are made.
  std::vector<std::size_t> tests;
  std::vector<double> band_after;
  std::vector<std::string> outside;  ///< in which it lies beyond the family's dampers, in words
};

/// Bands are half widths that claim 90 %, in shares of the force, root mean square over the region.
struct NextReport {
  std::vector<NextDrawing> drawings;
  double before = 0;  ///< what the family does not know of the force, before
  double random = 0;  ///< the median over as many drawings taken by chance
  double grid = 0;    ///< over as many of an even grid
  /// What builds and the family's error of a drawing add in quadrature to the band of a new damper,
  /// however many drawings are recorded.
  double builds = 0;
  std::size_t candidates = 0;
};

/// The request says what may vary; its goals and constraints have no part in it. Throws Error where
/// the model is not of family_physics or does not know what its recordings told, where the request
/// has fewer possible drawings than are wanted, or where the damper's yield stress is a number.
NextReport next_drawings(const DesignRequest& request, const FamilyModel& family,
                         const NextOptions& options);

/// Drawings of a request, each possible: by chance, evenly spread (a Latin hypercube); and of an
/// even grid over the inner part of the ranges. Fewer where some are not possible.
std::vector<DamperDescription> random_drawings(const DesignRequest& request, std::size_t count,
                                               std::uint64_t seed);
std::vector<DamperDescription> grid_drawings(const DesignRequest& request, std::size_t count);

}  // namespace dashpot
