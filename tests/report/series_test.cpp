#include "dashpot/report/series.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "support.h"

using namespace dashpot;

namespace {

std::vector<std::size_t> all(std::size_t n) { return thinned_indices({std::vector<double>(n)}, n); }

}  // namespace

TEST_CASE("thinning keeps the ends and every extreme, in order") {
  std::vector<double> wave(10000), spike(10000);
  for (std::size_t i = 0; i < wave.size(); ++i) wave[i] = std::sin(0.01 * static_cast<double>(i));
  spike[4321] = 7;
  spike[8765] = -7;
  const auto chosen = thinned_indices({wave, spike}, 400);
  CHECK(chosen.size() <= 402);
  CHECK(chosen.size() > 150);
  CHECK(chosen.front() == 0);
  CHECK(chosen.back() == 9999);
  CHECK(std::ranges::is_sorted(chosen));
  CHECK(std::ranges::count(chosen, 4321u) == 1);
  CHECK(std::ranges::count(chosen, 8765u) == 1);
  CHECK(std::ranges::count(chosen, std::ranges::max_element(wave) - wave.begin()) == 1);
  CHECK(thinned_indices({wave}, 10000).size() == 10000);
  CHECK(thinned_indices({}, 10).empty());
}

TEST_CASE("thinning keeps the course of a curve beside forty others") {
  const std::vector<std::vector<double>> waves(42, std::vector<double>(10000));
  const auto chosen = thinned_indices({waves.begin(), waves.end()}, 600);
  CHECK(chosen.size() <= 602);
  for (std::size_t k = 1; k < chosen.size(); ++k) CHECK(chosen[k] - chosen[k - 1] <= 34);
}

TEST_CASE("base64 as RFC 4648, section 10 has it") {
  CHECK(base64("") == "");
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64("\xFF\xFE\xFD") == "//79");
}

TEST_CASE("packed samples: little-endian float32, and int16 over the range") {
  const std::vector<double> samples{-1, 0, std::nan(""), 1};
  CHECK(pack_float32(std::vector<double>{1}, all(1)).find("float32")->as_string() ==
        "AACAPw==");  // 0x3F800000
  const Value packed = pack_int16(samples, all(4));
  CHECK(packed.find("low")->as_number() == -1);
  CHECK_CLOSE(packed.find("step")->as_number(), 1.0 / 32767, 1e-15, 0);
  // Codes -32767, 0, -32768 (not a number), 32767.
  CHECK(packed.find("int16")->as_string() ==
        base64(std::string_view("\x01\x80\x00\x00\x00\x80\xFF\x7F", 8)));
}

TEST_CASE("a constant, nothing but NaN, and the widest range can be packed") {
  constexpr double kHuge = std::numeric_limits<double>::max();
  CHECK(pack_int16(std::vector<double>{5, 5}, all(2)).find("low")->as_number() == 5);
  CHECK(pack_int16(std::vector<double>{std::nan("")}, all(1)).find("step")->as_number() == 0);
  CHECK(std::isfinite(
      pack_int16(std::vector<double>{-kHuge, kHuge}, all(2)).find("step")->as_number()));
}
