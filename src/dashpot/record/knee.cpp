#include "dashpot/record/knee.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "dashpot/numerics/linear_algebra.h"

namespace dashpot {
namespace {

constexpr double kAlike = 0.05;      // speeds within this share count as one
constexpr double kDegressive = 0.7;  // a knee has less slope than this share above it
constexpr double kSignificance = 0.01;
constexpr std::array kWidths = {0.0, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5};  // of the knee's speed
constexpr std::size_t kSpeedsForWidth = 6;
constexpr int kPlaces = 120;
constexpr double kOffEdge = 1e-4, kErrorsOffEdge = 2;  // of the fastest place; standard errors

/// The bend: 0 at v = 0, slope 0 far below the knee and 1 far above it.
double bend(double v, double knee, double width) {
  const auto rise = [&](double u) { return 0.5 * (u + std::sqrt(u * u + width * width)); };
  return rise(v - knee) - rise(-knee);
}

/// The least-squares line, with the bend as a third term where the knee is above 0.
struct BentLine {
  std::vector<double> coefficients;  // at v = 0, slope, change of slope
  double squares = std::numeric_limits<double>::infinity();
};
BentLine fit_line(std::span<const double> v, std::span<const double> f, double knee, double width) {
  const std::size_t terms = knee > 0 ? 3 : 2;
  std::vector<double> normal(terms * terms), right(terms);
  const auto row = [&](std::size_t k) {
    return std::array{1.0, v[k], knee > 0 ? bend(v[k], knee, width) : 0.0};
  };
  for (std::size_t k = 0; k < v.size(); ++k) {
    const auto r = row(k);
    for (std::size_t i = 0; i < terms; ++i) {
      right[i] += r[i] * f[k];
      for (std::size_t j = 0; j < terms; ++j) normal[i * terms + j] += r[i] * r[j];
    }
  }

  BentLine line;
  line.coefficients.resize(terms);
  if (!solve_positive_definite(normal, right, line.coefficients)) return line;
  line.squares = 0;
  for (std::size_t k = 0; k < v.size(); ++k) {
    const auto r = row(k);
    double error = f[k];
    for (std::size_t i = 0; i < terms; ++i) error -= line.coefficients[i] * r[i];
    line.squares += error * error;
  }
  return line;
}

/// Speeds that differ by more than kAlike, ascending: the mean of each group.
std::vector<double> distinct(std::vector<double> speeds) {
  std::ranges::sort(speeds);
  std::vector<double> groups;
  double first = -1, sum = 0;
  std::size_t count = 0;
  for (const double v : speeds) {
    if (count > 0 && v > first * (1 + kAlike)) {
      groups.push_back(sum / static_cast<double>(count));
      count = 0;
    }
    if (count == 0) first = v, sum = 0;
    sum += v;
    ++count;
  }
  if (count > 0) groups.push_back(sum / static_cast<double>(count));
  return groups;
}

/// Standard errors of the force at v = 0 and of the knee, from the slopes of the curve with
/// respect to its numbers.
std::pair<double, double> errors_of(std::span<const double> v, const BentLine& line, double knee,
                                    double width, double variance) {
  const std::size_t terms = knee > 0 ? 4 : 2;
  const double step = 1e-4 * knee;
  std::vector<double> normal(terms * terms);
  for (const double speed : v) {
    std::array<double, 4> r{1, speed, 0, 0};
    if (knee > 0) {
      r[2] = bend(speed, knee, width);
      r[3] = line.coefficients[2] *
             (bend(speed, knee + step, width) - bend(speed, knee - step, width)) / (2 * step);
    }
    for (std::size_t i = 0; i < terms; ++i)
      for (std::size_t j = 0; j < terms; ++j) normal[i * terms + j] += r[i] * r[j];
  }
  const std::vector<double> covariance = invert_symmetric(normal, terms, 1e-15).inverse;
  return {std::sqrt(variance * covariance[0]),
          knee > 0 ? std::sqrt(variance * covariance[15]) : kNoNumber};
}

/// The bend that leaves the least squares: places of the knee between the second and the last but
/// one of the speeds, first on a grid, then by halving its step.
struct Bend {
  double knee = 0, width = 0;
  BentLine line;
  double first = 0, last = 0;  // between which it was looked for
};
Bend best_bend(std::span<const double> v, std::span<const double> f,
               const std::vector<double>& speeds) {
  const double low = speeds[1], high = speeds[speeds.size() - 2];
  const std::size_t widths = speeds.size() >= kSpeedsForWidth ? kWidths.size() : 1;
  Bend best;
  const auto attempt = [&](double knee, double width) {
    if (knee < low || knee > high) return;
    BentLine line = fit_line(v, f, knee, width);
    if (line.squares < best.line.squares) best = {knee, width, std::move(line)};
  };
  for (std::size_t w = 0; w < widths; ++w)
    for (int k = 0; k <= kPlaces; ++k) {
      const double knee = low + (high - low) * k / kPlaces;
      attempt(knee, kWidths[w] * knee);
    }
  for (double step = (high - low) / kPlaces; step > 1e-5 * high; step /= 2)
    for (const double knee : {best.knee - step, best.knee + step}) attempt(knee, best.width);
  best.first = low, best.last = high;
  return best;
}

/// The fit without the points from `first` to before `end`.
KneeFit fit_without(std::vector<double> speed, std::vector<double> force, std::size_t first,
                    std::size_t end) {
  for (std::vector<double>* values : {&speed, &force})
    values->erase(values->begin() + static_cast<std::ptrdiff_t>(first),
                  values->begin() + static_cast<std::ptrdiff_t>(end));
  return fit_knee(speed, force);
}

/// The jackknife's standard error of one number, from the fits without one group after the other.
double jackknife_error(const std::vector<KneeFit>& without, Measured KneeFit::* number) {
  if (without.size() < 2) return kNoNumber;
  const auto groups = static_cast<double>(without.size());
  double mean = 0, squares = 0;
  for (const KneeFit& fit : without) mean += (fit.*number).value / groups;
  for (const KneeFit& fit : without) squares += std::pow((fit.*number).value - mean, 2);
  return std::sqrt((groups - 1) / groups * squares);
}

}  // namespace

bool Measured::is_told() const { return std::isfinite(value); }

KneeFit fit_knee(const std::vector<double>& speed, const std::vector<double>& force) {
  KneeFit fit;
  const std::vector<double> speeds = distinct(speed);
  if (speeds.size() < 3) {
    fit.why_no_knee = "fewer than three speeds";
    return fit;
  }

  // One straight line, which stands where no knee is seen.
  const auto points = static_cast<double>(speed.size());
  const BentLine straight = fit_line(speed, force, 0, 0);
  fit.slope_below = fit.slope_above = straight.coefficients[1];
  fit.scatter = std::sqrt(straight.squares / points);
  const double variance = straight.squares / std::max(1.0, points - 2);
  fit.yield =
      fit.at_rest = {straight.coefficients[0], errors_of(speed, straight, 0, 0, variance).first};
  if (speeds.size() < 4 || points < 6) {
    fit.why_no_knee = "too few speeds to tell a knee from a straight line";
    return fit;
  }

  // A bend, where the F test prefers it: with two more numbers its tail is in closed form.
  const Bend bent = best_bend(speed, force, speeds);
  const double left = points - (bent.width > 0 ? 5 : 4);
  const double ratio = (straight.squares - bent.line.squares) / 2 / (bent.line.squares / left);
  if (!(std::pow(1 + 2 * ratio / left, -left / 2) < kSignificance)) {
    fit.why_no_knee = "one straight line fits as well";
    return fit;
  }
  const double below = bent.line.coefficients[1], above = below + bent.line.coefficients[2];
  fit.at_rest = {bent.line.coefficients[0], kNoNumber};
  fit.slope_below = below;
  fit.slope_above = above;
  fit.width = bent.width;
  fit.scatter = std::sqrt(bent.line.squares / points);
  const auto [rest_error, knee_error] =
      errors_of(speed, bent.line, bent.knee, bent.width, bent.line.squares / left);
  fit.at_rest.error = rest_error;

  // One whose place would be beyond the speeds comes to lie at the last of them, but for noise.
  const double margin = kOffEdge * bent.last + kErrorsOffEdge * knee_error;
  const bool is_at_first = bent.knee - bent.first < margin,
             is_at_last = bent.last - bent.knee < margin;

  // Far above the knee the bend is v - knee - (what makes it 0 at v = 0).
  const double start = 0.5 * (std::hypot(bent.knee, bent.width) - bent.knee);
  fit.yield = {fit.at_rest.value - bent.line.coefficients[2] * (bent.knee + start), rest_error};
  if (above >= kDegressive * below)
    fit.why_no_knee = above > below ? "the force grows faster at higher speed: progressive"
                                    : "the slope hardly changes";
  else if (is_at_first || is_at_last)
    fit.is_knee_beyond_speeds = true;
  else
    fit.knee = {bent.knee, knee_error};
  if (!fit.knee.is_told() && !fit.is_knee_beyond_speeds) fit.yield = fit.at_rest;

  // Beyond the speeds one of the lines stands on one of them alone, and leads nowhere.
  if (fit.is_knee_beyond_speeds && is_at_last) {
    fit.why_no_knee = "it lies at the second fastest speed or above; record faster ones";
    fit.yield = fit.at_rest;
  } else if (fit.is_knee_beyond_speeds) {
    fit.why_no_knee = "it lies at the second slowest speed or below; record slower ones";
    fit.at_rest = {};
  }
  return fit;
}

KneeFit fit_knee_of_parts(const std::vector<double>& speed, const std::vector<double>& force,
                          const std::vector<std::size_t>& ends) {
  constexpr std::size_t kMostGroups = 10;
  KneeFit fit = fit_knee(speed, force);

  // Neighbouring parts go together where there are many.
  const std::size_t groups = std::min(ends.size(), kMostGroups);
  std::vector<KneeFit> without;
  for (std::size_t group = 0, first = 0; group < groups && groups > 1; ++group) {
    const std::size_t end = ends[(group + 1) * ends.size() / groups - 1];
    without.push_back(fit_without(speed, force, first, end));
    first = end;
  }

  // Figures of a curve with a knee and of one without are not the same figures.
  const bool are_alike = std::ranges::all_of(without, [&](const KneeFit& other) {
    return other.knee.is_told() == fit.knee.is_told() &&
           other.at_rest.is_told() == fit.at_rest.is_told();
  });
  for (Measured KneeFit::* number : {&KneeFit::at_rest, &KneeFit::yield, &KneeFit::knee})
    (fit.*number).error = are_alike ? jackknife_error(without, number) : kNoNumber;
  return fit;
}

}  // namespace dashpot
