#include "dashpot/suspension/dampers/passive_curve.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/data_folder.h"
#include "dashpot/error.h"
#include "dashpot/record/columns.h"
#include "dashpot/record/readers/reader.h"

namespace dashpot {
namespace {

constexpr double kSteepest = 1e12;  // N*s/m

void require_curve(const std::string& name, const std::vector<double>& v,
                   const std::vector<double>& f) {
  if (v.size() < 2 || f.size() != v.size())
    throw Error(name, "a curve of " + std::to_string(std::min(v.size(), f.size())) + " points",
                "two at least");
  for (std::size_t k = 0; k < v.size(); ++k) {
    if (!std::isfinite(v[k]) || !std::isfinite(f[k]))
      throw Error(name, "point " + std::to_string(k + 1) + " is not finite");
    if (k > 0 && !(v[k] > v[k - 1]))
      throw Error(name, "the velocity does not rise at point " + std::to_string(k + 1),
                  "one force per velocity, the least velocity first");
    if (k > 0 && !(std::abs(f[k] - f[k - 1]) <= kSteepest * (v[k] - v[k - 1])))
      throw Error(name, "the force leaps at point " + std::to_string(k + 1),
                  "points further apart, or one of the two");
  }
}

/// Slopes at the points, of a curve that rises or falls wherever its points do and has no kink: the
/// harmonic mean of the secants, weighted by the lengths of the pieces.
std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<double> secant;
  for (std::size_t k = 1; k < x.size(); ++k)
    secant.push_back((y[k] - y[k - 1]) / (x[k] - x[k - 1]));
  std::vector<double> slope{secant.front()};
  for (std::size_t k = 1; k < secant.size(); ++k) {
    const double before = x[k] - x[k - 1], after = x[k + 1] - x[k];
    const double w1 = 2 * after + before, w2 = after + 2 * before;
    const bool turns = secant[k - 1] * secant[k] <= 0;
    slope.push_back(turns ? 0 : (w1 + w2) / (w1 / secant[k - 1] + w2 / secant[k]));
  }
  slope.push_back(secant.back());
  return slope;
}

std::vector<double> column_of(const RawTable& table, const ColumnUses& uses,
                              const std::string& channel) {
  const auto use = std::ranges::find(uses.used, channel, &ColumnUse::channel);
  if (use == uses.used.end())
    throw Error(table.file, "has no column '" + channel + "'; it has " + table.column_list(),
                "velocity and force, as 'velocity [m/s]', 'force [N]'");
  std::vector<double> values;
  for (const double value : table.columns[use->column].values)
    values.push_back(use->factor * (value - use->raw_offset));
  return values;
}

}  // namespace

PassiveCurve::PassiveCurve(std::string name, std::vector<double> velocity,
                           std::vector<double> force)
    : name_(std::move(name)), velocity_(std::move(velocity)), force_(std::move(force)) {
  require_curve(name_, velocity_, force_);
  slope_ = monotone_slopes(velocity_, force_);
}

double PassiveCurve::force(const DamperInput& input, std::span<const double>) const noexcept {
  const double v = input.velocity;
  if (v <= velocity_.front()) return force_.front() + slope_.front() * (v - velocity_.front());
  if (v >= velocity_.back()) return force_.back() + slope_.back() * (v - velocity_.back());
  const auto above = std::upper_bound(velocity_.begin(), velocity_.end(), v) - velocity_.begin();
  const auto k =
      static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above, 1, std::ssize(velocity_) - 1));
  const double h = velocity_[k] - velocity_[k - 1], t = (v - velocity_[k - 1]) / h, u = 1 - t;
  return u * u * ((1 + 2 * t) * force_[k - 1] + t * h * slope_[k - 1]) +
         t * t * ((1 + 2 * u) * force_[k] - u * h * slope_[k]);
}

std::unique_ptr<DamperModel> PassiveCurve::with_offset(double newton) const {
  std::vector<double> force = force_;
  for (double& value : force) value += newton;
  return std::make_unique<PassiveCurve>(name_, velocity_, std::move(force));
}

Value PassiveCurve::to_json() const {
  return Value::object(
      {{"name", name_}, {"velocity", Value::array(velocity_)}, {"force", Value::array(force_)}});
}

std::vector<std::string> passive_curve_names() { return data_names("curves", ".csv"); }

PassiveCurve load_passive_curve(const std::string& name_or_path) {
  const std::vector<std::string> known = passive_curve_names();
  const bool shipped = std::ranges::find(known, name_or_path) != known.end();
  const std::filesystem::path path = shipped ? data_folder("curves") / (name_or_path + ".csv")
                                             : std::filesystem::path(name_or_path);
  const RawTable table = read_tables(path).front();
  const ColumnUses uses = understand_columns(table, {}, {});
  return {path.stem().string(), column_of(table, uses, "velocity"),
          column_of(table, uses, "force")};
}

}  // namespace dashpot
