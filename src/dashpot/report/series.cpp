#include "dashpot/report/series.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string_view>

namespace dashpot {

std::vector<std::size_t> thinned_indices(const std::vector<std::span<const double>>& series,
                                         std::size_t points) {
  const std::size_t n = series.empty() ? 0 : series.front().size();
  std::vector<std::size_t> chosen;
  if (n <= points || n <= 2) {
    chosen.resize(n);
    std::iota(chosen.begin(), chosen.end(), std::size_t{0});
    return chosen;
  }

  // Half of the room goes to the course of the curves.
  const std::size_t half = points / 2;
  chosen = {0, n - 1};
  for (std::size_t k = 0; k < half; ++k) chosen.push_back(k * n / half);

  // In the other half every stretch keeps the extremes of every series.
  const std::size_t stretches = std::max<std::size_t>(1, half / (2 * series.size()));
  for (std::size_t k = 0; k < stretches; ++k) {
    const std::size_t first = k * n / stretches, last = (k + 1) * n / stretches;
    for (const std::span<const double> one : series) {
      const auto [least, greatest] = std::minmax_element(one.begin() + first, one.begin() + last);
      chosen.push_back(least - one.begin());
      chosen.push_back(greatest - one.begin());
    }
  }

  // Several series may have chosen the same sample.
  std::ranges::sort(chosen);
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  result.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t here = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < here ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      result += k <= here ? kLetters[group >> (18 - 6 * k) & 63] : '=';
  }
  return result;
}

namespace {

template <class Bits>
void append_little_endian(std::string& bytes, Bits bits) {
  for (std::size_t k = 0; k < sizeof bits; ++k) bytes += static_cast<char>(bits >> (8 * k) & 0xFF);
}

}  // namespace

Value pack_float32(std::span<const double> samples, const std::vector<std::size_t>& chosen) {
  std::string bytes;
  for (const std::size_t i : chosen)
    append_little_endian(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(samples[i])));
  return Value::object({{"float32", base64(bytes)}});
}

Value pack_int16(std::span<const double> samples, const std::vector<std::size_t>& chosen) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::size_t i : chosen)
    if (std::isfinite(samples[i]))
      low = std::min(low, samples[i]), high = std::max(high, samples[i]);
  if (low > high) low = high = 0;
  // Halved before the subtraction, so that the widest range of doubles does not overflow.
  const double step = high > low ? (high / 2 - low / 2) / 32767 : 0;
  std::string bytes;
  for (const std::size_t i : chosen) {
    std::int16_t code = -32768;
    if (std::isfinite(samples[i]))
      code = static_cast<std::int16_t>(
          step > 0 ? std::lround(std::min(2 * ((samples[i] / 2 - low / 2) / step), 65534.0)) - 32767
                   : -32767);
    append_little_endian(bytes, static_cast<std::uint16_t>(code));
  }
  return Value::object({{"low", low}, {"step", step}, {"int16", base64(bytes)}});
}

}  // namespace dashpot
