#include "dashpot/identify/law_unknowns.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dashpot/base/error.h"
#include "dashpot/base/units.h"

namespace dashpot {
namespace {

constexpr double kLagStart = 100;                  // 1/s
constexpr double kLagLower = 1, kLagUpper = 5000;  // 1/s

double half_span(const std::vector<double>& samples) {
  const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
  return (*high - *low) / 2;
}

}  // namespace

double DataScale::of_unit(std::string_view unit) const {
  // Mass appears through force only; what remains of metres and seconds is stroke and stroke / speed.
  const Dimension d = require_unit(unit, "unit of a parameter").dimension;
  const int kg = d[0], m = d[1], s = d[2];
  return std::pow(force, kg) * std::pow(stroke, m - kg) * std::pow(stroke / speed, s + 2 * kg);
}

DataScale data_scale(const std::vector<Record>& records, std::string_view drive_unit) {
  DataScale scale{.force = 0, .stroke = 0, .speed = 0, .drive = drive_range(records, drive_unit)};
  for (const Record& record : records) {
    scale.force = std::max(scale.force, half_span(record.channel("force").samples));
    if (const Channel* displacement = record.find("displacement"))
      scale.stroke = std::max(scale.stroke, half_span(displacement->samples));
    for (const double v : record.channel("velocity").samples)
      scale.speed = std::max(scale.speed, std::abs(v));
  }
  if (scale.force <= 0 || scale.speed <= 0)
    throw Error(
        "training records",
        scale.speed <= 0 ? "nothing moves in any of them" : "the force is constant in every one of them",
        "a damper shows its law only while it moves; 'dashpot inspect' shows what was read");
  if (scale.stroke <= 0) scale.stroke = scale.speed;  // no displacement channel: one second at full speed
  return scale;
}

LawUnknowns::LawUnknowns(const Law& law, const DataScale& scale, std::string drive_unit, OffsetMode offset)
    : law_(&law),
      drive_unit_(std::move(drive_unit)),
      drive_min_(scale.drive.low),
      drive_max_(scale.drive.high) {
  // With two levels of current a parabola cannot be told from a line, with one nothing can.
  const std::size_t levels = scale.drive.varies ? 3 : std::clamp<std::size_t>(scale.drive.levels, 1, 3);
  for (const ParamInfo& param : law.params) {
    Row row;
    row.first = size();
    row.value = param.value;
    const bool bias_is_nuisance = param.bias && offset == OffsetMode::Record;
    if (bias_is_nuisance) row.value = 0;
    if (!param.fixed && !bias_is_nuisance) {
      row.form = std::min(param.form, static_cast<Form>(levels - 1));
      row.count = coefficient_count(row.form);
      row.size = scale.of_unit(param.unit) * (param.start != 0 ? std::abs(param.start) : 1);
      const double start = std::clamp((param.start > 0) - (param.start < 0) + 0.0, param.lower / row.size,
                                      param.upper / row.size);
      lower_.insert(lower_.end(), row.count, param.lower / row.size);
      upper_.insert(upper_.end(), row.count, param.upper / row.size);
      start_.insert(start_.end(), row.count, start);
    }
    rows_.push_back(row);
  }
  fits_lag_ = scale.drive.varies;
  if (fits_lag_) {
    lower_.push_back(kLagLower / kLagStart);
    upper_.push_back(kLagUpper / kLagStart);
    start_.push_back(1);
  }
}

std::vector<double> LawUnknowns::start(Random* random) const {
  std::vector<double> unknowns = start_;
  if (!random) return unknowns;
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    const double factor = std::exp(random->uniform(-1, 1) * std::log(3.0));
    unknowns[k] = std::clamp(unknowns[k] * factor, lower_[k], upper_[k]);
  }
  return unknowns;
}

/// Row `coefficient` of the matrix that turns values at the nodes into polynomial coefficients.
std::vector<double> LawUnknowns::weights(Form form, std::size_t coefficient) const {
  const double a = drive_min_, b = drive_max_, m = (a + b) / 2;
  if (form == Form::Constant) return {1};
  if (form == Form::Linear) {
    const double d = b - a;
    return coefficient == 0 ? std::vector{b / d, -a / d} : std::vector{-1 / d, 1 / d};
  }
  // Lagrange's polynomials at a, m, b
  const double da = (a - m) * (a - b), dm = (m - a) * (m - b), db = (b - a) * (b - m);
  if (coefficient == 0) return {m * b / da, a * b / dm, a * m / db};
  if (coefficient == 1) return {-(m + b) / da, -(a + b) / dm, -(a + m) / db};
  return {1 / da, 1 / dm, 1 / db};
}

LawModel LawUnknowns::model(std::span<const double> unknowns) const {
  Dependence dependence;
  for (const Row& row : rows_) {
    dependence.forms.push_back(row.form);
    if (row.count == 0) {
      dependence.coefficients.push_back({row.value});
      continue;
    }
    std::vector<double> coefficients;
    for (std::size_t c = 0; c < row.count; ++c) {
      const std::vector<double> w = weights(row.form, c);
      double sum = 0;
      for (std::size_t k = 0; k < row.count; ++k) sum += w[k] * row.size * unknowns[row.first + k];
      coefficients.push_back(sum);
    }
    dependence.coefficients.push_back(std::move(coefficients));
  }
  const double lag_rate = fits_lag_ ? kLagStart * unknowns.back() : 0;
  return LawModel(*law_, std::move(dependence), drive_unit_, lag_rate);
}

std::vector<LawUnknowns::Coefficient> LawUnknowns::coefficients(std::span<const double> unknowns) const {
  const LawModel fitted = model(unknowns);
  const auto at_bound = [&](std::size_t k) {
    const double margin = 1e-6 * std::max(1.0, std::abs(unknowns[k]));
    return unknowns[k] <= lower_[k] + margin || unknowns[k] >= upper_[k] - margin;
  };
  std::vector<Coefficient> out;
  for (std::size_t p = 0; p < rows_.size(); ++p) {
    const Row& row = rows_[p];
    const ParamInfo& param = law_->params[p];
    for (std::size_t c = 0; c < coefficient_count(row.form); ++c) {
      Coefficient coefficient{.name = coefficient_name(param.name, row.form, c),
                              .unit = coefficient_unit(param.unit, c, drive_unit_),
                              .meaning = std::string(param.meaning),
                              .value = fitted.parameters().coefficients[p][c],
                              .first = row.first};
      if (row.count > 0) {
        coefficient.weights = weights(row.form, c);
        for (double& w : coefficient.weights) w *= row.size;
        for (std::size_t k = 0; k < row.count; ++k) coefficient.at_bound |= at_bound(row.first + k);
      }
      out.push_back(std::move(coefficient));
    }
  }
  if (fits_lag_)
    out.push_back({.name = "lag_rate",
                   .unit = "1/s",
                   .meaning = "rate of the coil's first-order lag",
                   .value = fitted.lag_rate(),
                   .first = size() - 1,
                   .weights = {kLagStart},
                   .at_bound = at_bound(size() - 1)});
  return out;
}

}  // namespace dashpot
