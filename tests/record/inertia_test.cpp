#include "dashpot/record/inertia.h"

#include <cmath>

#include "dashpot/base/random.h"
#include "support.h"

using namespace dashpot;

// A record of that velocity alone.
static Record with_velocity(std::vector<double> velocity, double sample_time) {
  Record record;
  record.sample_time = sample_time;
  for (std::size_t k = 0; k < velocity.size(); ++k)
    record.time.push_back(sample_time * static_cast<double>(k));
  record.channels.push_back({"velocity", "m/s", std::move(velocity), "measured"});
  return record;
}

// Noise has the highest cut-off, where a step and two opposite samples grow most.
TEST_CASE("the usual acceleration stays below what the differences of the velocity allow") {
  Random random(1);
  std::vector<double> noise(3000), walk(3000), steps(3000), alternating(3000), slow(3000);
  for (std::size_t k = 0; k < noise.size(); ++k) {
    noise[k] = random.normal();
    walk[k] = (k > 0 ? walk[k - 1] : 0) + random.normal();
    steps[k] = k % 100 < 50 ? 1 : -1;
    alternating[k] = k % 2 ? 1 : -1;
    slow[k] = std::sin(0.01 * static_cast<double>(k));
  }
  for (const auto& velocity : {noise, walk, steps, alternating, slow})
    for (const double sample_time : {1e-4, 1e-2}) {
      const Record record = with_velocity(velocity, sample_time);
      CHECK(usual_acceleration(acceleration_of(record)) <= greatest_acceleration(record));
    }
  CHECK(greatest_acceleration(with_velocity(slow, 1e-3)) < 3.1 * 10.01);

  // A few samples, and a recorded acceleration, are looked at themselves.
  Record recorded = with_velocity(slow, 1e-3);
  recorded.channels.push_back({"acceleration", "m/s2", slow, "measured"});
  CHECK(std::isinf(greatest_acceleration(recorded)));
  slow.resize(100);
  CHECK(std::isinf(greatest_acceleration(with_velocity(slow, 1e-3))));
}
