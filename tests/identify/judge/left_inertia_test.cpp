#include "dashpot/identify/judge/left_inertia.h"

#include <cmath>

#include "support.h"

using namespace dashpot;

TEST_CASE("the error that follows the acceleration is told as a mass, with its share") {
  // Two records: an error of 2.5 kg times the acceleration, one in quadrature with it, an offset.
  Evaluation evaluation;
  for (const double f : {3.0, 11.0}) {
    RecordResult record;
    const double w = 2 * M_PI * f;
    for (int k = 0; k <= 5000; ++k) {
      const double t = k * 2e-4, v = std::sin(w * t), a = w * std::cos(w * t);
      record.time.push_back(t);
      record.velocity.push_back(v);
      record.modelled.push_back(800 * v);
      record.measured.push_back(800 * v + 2.5 * a + 2.5 * w * std::sin(w * t) + 40);
    }
    evaluation.records.push_back(std::move(record));
  }
  const LeftInertia left = left_inertia(evaluation);
  CHECK_CLOSE(left.mass, 2.5, 2e-3, 0);
  CHECK_CLOSE(left.share, 0.5, 5e-3, 0);

  // A run that diverged says nothing, and no record at all neither.
  evaluation.records[0].diverged_at = 1;
  evaluation.records[1].diverged_at = 1;
  CHECK(left_inertia(evaluation).share == 0);
  CHECK(left_inertia({}).mass == 0);
}
