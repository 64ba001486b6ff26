#include "dashpot/suspension/ride/weighting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "dashpot/base/find_row.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/numerics/constants.h"
#include "dashpot/numerics/root_mean_square.h"

namespace dashpot {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::array kWeightings{
    Weighting{"Wb", "vertical, trains (BS 6841)", 0.4, 100, 16, 16, 0.55, 2.5, 0.9, 4, 0.95},
    Weighting{"Wc", "seat back, horizontal", 0.4, 100, 8, 8, 0.63, 0, 1, 0, 1},
    Weighting{"Wd", "seated or standing, horizontal", 0.4, 100, 2, 2, 0.63, 0, 1, 0, 1},
    Weighting{"We", "rotation", 0.4, 100, 1, 1, 0.63, 0, 1, 0, 1},
    Weighting{"Wf", "motion sickness, vertical", 0.08, 0.63, kInfinity, 0.25, 0.86, 0.0625, 0.8,
              0.1, 0.8},
    Weighting{"Wj", "head of a lying person", 0.4, 100, kInfinity, kInfinity, 1, 3.75, 0.91, 5.32,
              0.91},
    Weighting{"Wk", "seated or standing, vertical", 0.4, 100, 12.5, 12.5, 0.63, 2.37, 0.91, 3.35,
              0.91}};

/// (n0 + n1 s + n2 s^2) / (d0 + d1 s + d2 s^2), and the frequency in rad/s that its digital form
/// keeps exactly.
struct Section {
  double n0, n1, n2, d0, d1, d2, kept;
};

/// 1 / w, 0 where the frequency is infinite.
double time_of(double f) { return std::isinf(f) ? 0 : 1 / (kTurn * f); }

std::vector<Section> sections_of(const Weighting& w) {
  const double root = std::numbers::sqrt2, w1 = kTurn * w.f1, w2 = kTurn * w.f2;
  std::vector<Section> sections{{0, 0, 1, w1 * w1, root * w1, 1, w1},
                                {w2 * w2, 0, 0, w2 * w2, root * w2, 1, w2}};
  if (!std::isinf(w.f4)) {
    const double t3 = time_of(w.f3), t4 = time_of(w.f4);
    sections.push_back({1, t3, 0, 1, t4 / w.q4, t4 * t4, kTurn * w.f4});
  }
  if (w.f5 > 0) {
    const double w5 = kTurn * w.f5, w6 = kTurn * w.f6;
    sections.push_back({w5 * w5, w5 / w.q5, 1, w6 * w6, w6 / w.q6, 1, w6});
  }
  return sections;
}

/// Wb alone has a gain in the standard's formulas.
double gain_of(const Weighting& w) { return w.name == "Wb" ? 1.024 : 1; }

Biquad digital(const Section& s, double dt) {
  const double k = s.kept / std::tan(0.5 * s.kept * dt), kk = k * k;
  const double d = s.d0 + s.d1 * k + s.d2 * kk;
  return {(s.n0 + s.n1 * k + s.n2 * kk) / d, 2 * (s.n0 - s.n2 * kk) / d,
          (s.n0 - s.n1 * k + s.n2 * kk) / d, 2 * (s.d0 - s.d2 * kk) / d,
          (s.d0 - s.d1 * k + s.d2 * kk) / d};
}

void filter_in_place(const Biquad& b, std::vector<double>& x) {
  double s1 = 0, s2 = 0;
  for (double& value : x) {
    const double in = value, out = b.b0 * in + s1;
    s1 = b.b1 * in - b.a1 * out + s2;
    s2 = b.b2 * in - b.a2 * out;
    value = out;
  }
}

double greatest_running_rms(std::span<const double> x, double dt) {
  const auto window = std::min(x.size(), static_cast<std::size_t>(std::lround(1 / dt)));
  double sum = 0, greatest = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    sum += x[k] * x[k];
    if (k >= window) sum -= x[k - window] * x[k - window];
    if (k + 1 >= window) greatest = std::max(greatest, sum / static_cast<double>(window));
  }
  return std::sqrt(greatest);
}

}  // namespace

const Weighting& find_weighting(std::string_view name, const std::string& where) {
  return find_row(kWeightings, name, "weighting", where);
}

std::complex<double> weighting_response(const Weighting& weighting, double f) {
  const std::complex<double> s(0, kTurn * f);
  std::complex<double> h = gain_of(weighting);
  for (const Section& part : sections_of(weighting))
    h *= (part.n0 + s * (part.n1 + s * part.n2)) / (part.d0 + s * (part.d1 + s * part.d2));
  return h;
}

std::vector<Biquad> weighting_filter(const Weighting& weighting, double dt) {
  if (!(dt > 0 && dt <= 0.25 / weighting.f2))
    throw Error("weighting " + std::string(weighting.name),
                "a sample time of " + format_number(dt) + " s",
                format_number(0.25 / weighting.f2) + " s at most");
  std::vector<Biquad> cascade;
  for (const Section& part : sections_of(weighting)) cascade.push_back(digital(part, dt));
  for (double* b : {&cascade[0].b0, &cascade[0].b1, &cascade[0].b2}) *b *= gain_of(weighting);
  return cascade;
}

std::vector<double> weigh(const Weighting& weighting, std::span<const double> signal, double dt) {
  std::vector<double> out(signal.begin(), signal.end());
  for (const Biquad& section : weighting_filter(weighting, dt)) filter_in_place(section, out);
  return out;
}

RideComfort ride_comfort(const Weighting& weighting, std::span<const double> acceleration,
                         double dt, double discard) {
  const auto first = static_cast<std::size_t>(std::lround(discard / dt));
  if (first >= acceleration.size())
    throw Error("ride comfort", "the signal lasts no longer than the " + format_number(discard) +
                                    " s that are discarded");

  // Means over what is kept, filtered from the start on.
  const std::vector<double> weighted = weigh(weighting, acceleration, dt);
  const std::span kept = std::span(weighted).subspan(first);
  RideComfort comfort{.rms = root_mean_square(acceleration.subspan(first)),
                      .weighted_rms = root_mean_square(kept),
                      .mtvv = greatest_running_rms(kept, dt)};

  // The fourth-power dose and the crest factor, which show single shocks.
  double fourth = 0, greatest = 0;
  for (const double a : kept) {
    fourth += a * a * a * a;
    greatest = std::max(greatest, std::abs(a));
  }
  comfort.vdv = std::pow(fourth * dt, 0.25);
  comfort.crest = comfort.weighted_rms > 0 ? greatest / comfort.weighted_rms : 0;
  return comfort;
}

std::string_view RideComfort::feeling() const {
  if (weighted_rms < 0.315) return "not uncomfortable";
  if (weighted_rms < 0.57) return "a little uncomfortable";
  if (weighted_rms < 0.9) return "fairly uncomfortable";
  if (weighted_rms < 1.43) return "uncomfortable";
  return weighted_rms < 2.25 ? "very uncomfortable" : "extremely uncomfortable";
}

}  // namespace dashpot
