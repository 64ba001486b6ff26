#include "dashpot/numerics/filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

/// One pass of the cascade in place (direct form II transposed), started in the steady state that a
/// constant input of the first sample would have reached.
template <class Iterator>
void filter_in_place(const std::vector<Biquad>& sections, Iterator begin, Iterator end) {
  double level = *begin;
  for (const Biquad& s : sections) {
    // Both memories stand where a constant `level` would have brought them, so that the start makes
    // no transient.
    const double settled = level * (s.b0 + s.b1 + s.b2) / (1 + s.a1 + s.a2);
    double z2 = s.b2 * level - s.a2 * settled;
    double z1 = s.b1 * level - s.a1 * settled + z2;

    for (Iterator sample = begin; sample != end; ++sample) {
      const double in = *sample;
      const double out = s.b0 * in + z1;
      z1 = s.b1 * in - s.a1 * out + z2;
      z2 = s.b2 * in - s.a2 * out;
      *sample = out;
    }

    // The next section's input starts at what this one settles to.
    level = settled;
  }
}

/// x with `margin` samples more at each end: x turned by 180 degrees about its first and last
/// sample.
std::vector<double> extend_odd(std::span<const double> x, std::size_t margin) {
  std::vector<double> extended;
  extended.reserve(x.size() + 2 * margin);
  for (std::size_t i = margin; i > 0; --i) extended.push_back(2 * x.front() - x[i]);
  extended.insert(extended.end(), x.begin(), x.end());
  for (std::size_t i = 1; i <= margin; ++i) extended.push_back(2 * x.back() - x[x.size() - 1 - i]);
  return extended;
}

}  // namespace

std::vector<Biquad> butterworth_lowpass(int order, double cutoff_hz, double dt) {
  if (order < 2 || order % 2 != 0)
    throw Error("low-pass filter", "order " + std::to_string(order) + " is not even",
                "use 2, 4, 6, ...");
  if (!(dt > 0) || !(cutoff_hz > 0) || !(cutoff_hz * dt < 0.5))
    throw Error("low-pass filter",
                "cut-off " + format_number(cutoff_hz) + " Hz does not fit a sample time of " +
                    format_number(dt) + " s",
                "the cut-off must lie above 0 and below half the sample rate" +
                    (dt > 0 ? ", " + format_number(0.5 / dt) + " Hz" : std::string()));

  // Each pair of poles of the prototype, s^2 + s / Q + 1, with s = (z - 1) / (z + 1) / k; low Q
  // first.
  const double k = std::tan(std::numbers::pi * cutoff_hz * dt);
  std::vector<Biquad> sections;
  for (int pair = order / 2; pair-- > 0;) {
    const double inverse_q = 2 * std::sin(std::numbers::pi * (2 * pair + 1) / (2 * order));
    const double scale = 1 / (1 + inverse_q * k + k * k);
    const double b = k * k * scale;
    sections.push_back({b, 2 * b, b, 2 * (k * k - 1) * scale, (1 - inverse_q * k + k * k) * scale});
  }
  return sections;
}

std::vector<double> filter_zero_phase(const std::vector<Biquad>& sections,
                                      std::span<const double> x, std::size_t margin) {
  if (x.empty()) return {};

  // Lengthen both ends, so that what transient is left dies outside of the record.
  if (margin == 0) margin = 3 * (2 * sections.size() + 1);
  margin = std::min(margin, x.size() - 1);
  std::vector<double> y = extend_odd(x, margin);

  // A second pass from the end takes back the phase shift of the first.
  filter_in_place(sections, y.begin(), y.end());
  filter_in_place(sections, y.rbegin(), y.rend());

  // Cut in place: a second copy of a long record would cost its size again.
  y.resize(margin + x.size());
  y.erase(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(margin));
  return y;
}

}  // namespace dashpot
