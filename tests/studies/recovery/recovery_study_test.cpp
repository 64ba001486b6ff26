#include "studies/recovery/recovery_study.h"

#include <atomic>

#include "dashpot/error.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("the truth lies in 95 % intervals about as often as they say") {
  // A small part of what `dashpot study recovery` does. 3 laws x 4 repetitions give about 90
  // intervals: fewer than 84 % inside has odds below 1 in 10^4 when 95 % is right.
  RecoveryStudyOptions options;
  options.laws = {"bingham", "biviscous", "tanh_kwok"};
  options.repetitions = 4;
  int inside = 0, counted = 0;
  for (const LawRecovery& law : study_recovery(options)) {
    CHECK(law.failed == 0);
    inside += law.inside();
    counted += law.counted();
  }
  CHECK(counted >= 60);
  CHECK(inside >= 0.84 * counted);
}

TEST_CASE("the same bits on any number of threads; a study can be stopped") {
  RecoveryStudyOptions options;
  options.laws = {"bingham"};
  options.repetitions = 3;
  options.threads = 1;
  const LawRecovery one = study_recovery(options).front();
  options.threads = 3;
  const LawRecovery three = study_recovery(options).front();
  for (std::size_t k = 0; k < one.parameters.size(); ++k) {
    CHECK(one.parameters[k].inside == three.parameters[k].inside);
    CHECK(one.parameters[k].bias == three.parameters[k].bias);
  }
  const std::atomic<bool> stop = true;
  options.monitor.stop = &stop;
  CHECK_THROWS_AS(study_recovery(options), Interrupted);
}
