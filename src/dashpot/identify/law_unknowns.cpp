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

constexpr double kSlowest = 0.05, kFastest = 50;  // rates of an exponential, per range of the drive

/// What these currents can tell: with two levels a parabola is a line, with one nothing depends on current.
Form simplest(Form form, const DriveRange& drive) {
  const std::size_t levels = drive.varies ? 4 : std::clamp<std::size_t>(drive.levels, 1, 4);
  if (coefficient_count(form) <= levels) return form;
  return static_cast<Form>(levels - 1);
}

/// Coefficients, from power 0 up, of the polynomial that is 1 at node `node` of `count` nodes spread evenly
/// over [first, first + span] and 0 at the others.
std::vector<double> lagrange(std::size_t node, std::size_t count, double first, double span) {
  const auto place = [&](std::size_t k) {
    return count == 1 ? first : first + span * static_cast<double>(k) / static_cast<double>(count - 1);
  };
  std::vector<double> c = {1};
  for (std::size_t other = 0; other < count; ++other) {
    if (other == node) continue;
    const double scale = 1 / (place(node) - place(other));
    c.push_back(0);
    for (std::size_t k = c.size(); k-- > 0;) c[k] = scale * ((k > 0 ? c[k - 1] : 0) - place(other) * c[k]);
  }
  return c;
}

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
  for (const ParamInfo& param : law.params) {
    Row row;
    row.first = size();
    row.value = param.value;
    const bool bias_is_nuisance = param.fit == Fit::Bias && offset == OffsetMode::Record;
    if (bias_is_nuisance) row.value = 0;
    if (param.fit == Fit::Scale)
      row.value = std::clamp(scale.of_unit(param.unit) * param.start, param.lower, param.upper);
    if (is_estimated(param.fit) && !bias_is_nuisance) {
      row.form = simplest(param.form, scale.drive);
      row.size = scale.of_unit(param.unit) * (param.start != 0 ? std::abs(param.start) : 1);
      add_unknowns(row, param);
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

void LawUnknowns::add_unknowns(Row& row, const ParamInfo& param) {
  row.count = coefficient_count(row.form);
  const double lower = param.lower / row.size, upper = param.upper / row.size;
  const double start = std::clamp((param.start > 0) - (param.start < 0) + 0.0, lower, upper);
  lower_.insert(lower_.end(), row.count, lower);
  upper_.insert(upper_.end(), row.count, upper);
  start_.insert(start_.end(), row.count, start);
  if (row.form != Form::Exponential) return;
  // Its ends apart from each other, or the rate would be without effect at the start.
  *(start_.end() - 3) = std::clamp(0.5 * start, lower, upper);
  *(start_.end() - 2) = std::clamp(1.5 * start, lower, upper);
  lower_.back() = kSlowest;
  upper_.back() = kFastest;
  start_.back() = 1;
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

/// One coefficient of a parameter as a linear combination of its unknowns.
std::vector<double> LawUnknowns::weights(const Row& row, std::size_t coefficient) const {
  std::vector<double> w(row.count, 0.0);
  if (row.form == Form::Exponential) {
    w[coefficient] = coefficient < 2 ? row.size : 1 / drive_span();
    return w;
  }
  for (std::size_t node = 0; node < row.count; ++node)
    w[node] = row.size * lagrange(node, row.count, drive_min_, drive_span())[coefficient];
  return w;
}

LawModel LawUnknowns::model(std::span<const double> unknowns) const {
  Dependence dependence;
  for (std::size_t p = 0; p < rows_.size(); ++p) {
    const Row& row = rows_[p];
    if (law_->params[p].fit == Fit::Drive) {
      dependence.forms.push_back(Form::Linear);
      dependence.coefficients.push_back({0, 1});
      continue;
    }
    dependence.forms.push_back(row.form);
    if (row.count == 0) {
      dependence.coefficients.push_back({row.value});
      continue;
    }
    std::vector<double> coefficients;
    for (std::size_t c = 0; c < row.count; ++c) {
      const std::vector<double> w = weights(row, c);
      double sum = 0;
      for (std::size_t k = 0; k < row.count; ++k) sum += w[k] * unknowns[row.first + k];
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
    if (param.fit == Fit::Drive) continue;
    for (std::size_t c = 0; c < coefficient_count(row.form); ++c) {
      Coefficient coefficient{.name = coefficient_name(param.name, row.form, c),
                              .unit = coefficient_unit(param.unit, row.form, c, drive_unit_),
                              .meaning = std::string(param.meaning),
                              .value = fitted.parameters().coefficients[p][c],
                              .first = row.first};
      if (row.count > 0) {
        coefficient.weights = weights(row, c);
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
