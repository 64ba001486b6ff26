#pragma once
#include <array>
#include <cstdint>

namespace dashpot {

/// xoshiro256++ seeded through splitmix64: the same numbers on every machine, unlike the
/// distributions of the standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed);
  std::uint64_t next();
  double uniform();  ///< in [0, 1)
  double uniform(double low, double high);
  double normal();                       ///< mean 0, variance 1
  std::size_t index(std::size_t count);  ///< in [0, count)

 private:
  std::array<std::uint64_t, 4> state_;
  double spare_ = 0;
  bool has_spare_ = false;
};

}  // namespace dashpot
