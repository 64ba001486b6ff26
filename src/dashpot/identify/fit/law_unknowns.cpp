#include "dashpot/identify/fit/law_unknowns.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr double kSlowestRate = 0.05,
                 kFastestRate = 50;  // rates of an exponential, per range of the drive

/// How many levels the drive of these data stands for: one that varies little tells as little as a
/// single level, since whatever it says of others is blown up on the way to them.
std::size_t levels_told(const DriveRange& drive) {
  constexpr double kOneLevel = 0.1, kTwoLevels = 0.3;  // of the greatest
  if (!drive.varies) return std::clamp<std::size_t>(drive.levels, 1, 4);
  const double span = drive.high - drive.low;
  const double share = span / std::max(std::abs(drive.low), std::abs(drive.high));
  return share < kOneLevel ? 1 : share < kTwoLevels ? 2 : 4;
}

/// The form as far as these currents determine it: two levels allow a line at most, and with one
/// nothing depends on current.
Form simplest(Form form, const DriveRange& drive) {
  const std::size_t levels = levels_told(drive);
  if (coefficient_count(form) <= levels) return form;
  return static_cast<Form>(levels - 1);
}

/// Coefficients, from power 0 up, of the polynomial that is 1 at node `node` of `count` nodes
/// spread evenly over [first, first + span] and 0 at the others.
std::vector<double> lagrange(std::size_t node, std::size_t count, double first, double span) {
  const auto place = [&](std::size_t k) {
    return count == 1 ? first
                      : first + span * static_cast<double>(k) / static_cast<double>(count - 1);
  };
  std::vector<double> c = {1};
  for (std::size_t other = 0; other < count; ++other) {
    if (other == node) continue;
    const double scale = 1 / (place(node) - place(other));
    c.push_back(0);
    for (std::size_t k = c.size(); k-- > 0;)
      c[k] = scale * ((k > 0 ? c[k - 1] : 0) - place(other) * c[k]);
  }
  return c;
}

/// Coefficients of an exponential that is `first` without drive and `last` at `drive`, where it has
/// come most of its way.
std::vector<double> exponential_through(double first, double last, double drive) {
  const double left = std::exp(-1.0);
  return {first, (last - left * first) / (1 - left), 1 / (drive != 0 ? drive : 1)};
}

double half_span(const std::vector<double>& samples) {
  const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
  return (*high - *low) / 2;
}

}  // namespace

double DataScale::of_unit(std::string_view unit) const {
  // Mass appears through force only; what remains of metres and seconds is stroke and stroke /
  // speed.
  const Dimension d = require_unit(unit, "unit of a parameter").dimension;
  const int kg = d[0], m = d[1], s = d[2];
  return std::pow(force, kg) * std::pow(stroke, m - kg) * std::pow(stroke / speed, s + 2 * kg);
}

DataScale data_scale(const std::vector<Record>& records, DriveUnit drive_unit) {
  DataScale scale{.force = 0, .stroke = 0, .speed = 0, .drive = drive_range(records, drive_unit)};

  // The largest span and speed of any record.
  for (const Record& record : records) {
    scale.force = std::max(scale.force, half_span(record.channel("force").samples));
    if (const Channel* displacement = record.find("displacement"))
      scale.stroke = std::max(scale.stroke, half_span(displacement->samples));
    for (const double v : record.channel("velocity").samples)
      scale.speed = std::max(scale.speed, std::abs(v));
  }

  // Refuse what cannot tell a law.
  if (scale.force <= 0 || scale.speed <= 0)
    throw Error(
        "training records",
        scale.speed <= 0 ? "nothing moves in any of them"
                         : "the force is constant in every one of them",
        "a damper shows its law only while it moves; 'dashpot inspect' shows what was read");
  if (scale.stroke <= 0)
    scale.stroke = scale.speed;  // no displacement channel: one second at full speed
  return scale;
}

LawUnknowns::LawUnknowns(const Law& law, const DataScale& scale, DriveUnit drive_unit,
                         OffsetMode offset, const std::vector<ParameterChoice>& choices,
                         std::string_view model)
    : law_(&law),
      drive_unit_(drive_unit),
      drive_min_(scale.drive.low),
      drive_max_(scale.drive.high) {
  if (model.empty()) model = law.name;
  for (const ParamInfo& param : law.params)
    rows_.push_back(make_row(param, choice_for(choices, model, param), scale, offset));
  if (scale.drive.varies && levels_told(scale.drive) < 4)
    warnings_.push_back(
        "the drive goes from " + format_number(scale.drive.low, 3) + " to " +
        format_number(scale.drive.high, 3) + " " + to_string(drive_unit) +
        " only: the force is taken to follow it " +
        (levels_told(scale.drive) < 2 ? "not at all" : "by a straight line at most"));
  if (scale.drive.varies)
    lag_ = make_row(kLagParameter, choice_for(choices, model, kLagParameter), scale, offset);
}

LawUnknowns::Row LawUnknowns::make_row(const ParamInfo& table, const ParameterChoice& choice,
                                       const DataScale& scale, OffsetMode offset) {
  Row row{.param = with_choice(table, choice), .first = size(), .prior = choice.prior};
  const ParamInfo& param = row.param;
  const bool bias_is_nuisance = param.fit == Fit::Bias && offset == OffsetMode::Record;
  row.value = bias_is_nuisance ? 0 : param.value;
  if (param.fit == Fit::Scale)
    row.value = std::clamp(scale.of_unit(param.unit) * param.start, param.lower, param.upper);
  if (!is_estimated(param.fit) || bias_is_nuisance) return row;
  row.form = simplest(param.form, scale.drive);
  if (choice.form && row.form != param.form)
    warnings_.push_back(std::string(param.name) + " is " + std::string(name_of(row.form)) +
                        ", not " + std::string(name_of(param.form)) +
                        ": these data hold too few currents to tell");
  // The lag has a rate of its own; all else has the size of the data.
  const double unit = &table == &kLagParameter ? 1 : scale.of_unit(param.unit);
  row.size = unit * (param.start != 0 ? std::abs(param.start) : 1);
  add_unknowns(row);
  return row;
}

void LawUnknowns::add_unknowns(Row& row) {
  const ParamInfo& param = row.param;
  row.count = coefficient_count(row.form);
  const double lower = param.lower / row.size, upper = param.upper / row.size;
  double start = (param.start > 0) - (param.start < 0) + 0.0;
  // A parameter that the table switches off by its start is without effect there: it starts beside.
  constexpr double kBeside = 0.1;
  if (start <= lower || start >= upper)
    start = upper - lower > 2 * kBeside ? std::clamp(start, lower + kBeside, upper - kBeside)
                                        : lower + 0.5 * (upper - lower);
  if (row.prior) start = row.prior->value / row.size;
  lower_.insert(lower_.end(), row.count, lower);
  upper_.insert(upper_.end(), row.count, upper);
  start_.insert(start_.end(), row.count, start);
  if (row.form != Form::Exponential) return;
  // Its ends apart from each other, or the rate would be without effect at the start.
  *(start_.end() - 3) = std::clamp(0.5 * start, lower, upper);
  *(start_.end() - 2) = std::clamp(1.5 * start, lower, upper);
  lower_.back() = kSlowestRate;
  upper_.back() = kFastestRate;
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

bool LawUnknowns::at_bound(std::span<const double> unknowns, std::size_t k) const {
  const double margin = 1e-6 * std::max(1.0, std::abs(unknowns[k]));
  return unknowns[k] <= lower_[k] + margin || unknowns[k] >= upper_[k] - margin;
}

std::vector<double> LawUnknowns::off_bounds(std::vector<double> unknowns) const {
  constexpr double kShort = 0.1;  // of the start, for what has fallen to its lower bound
  for (std::size_t k = 0; k < unknowns.size(); ++k)
    if (at_bound(unknowns, k))
      unknowns[k] = std::clamp(unknowns[k] < start_[k] ? kShort * start_[k] : start_[k], lower_[k],
                               upper_[k]);
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

/// The parameter's coefficients.
std::vector<double> LawUnknowns::values(const Row& row, std::span<const double> unknowns) const {
  if (row.count == 0) return {row.value};
  std::vector<double> coefficients;
  for (std::size_t c = 0; c < row.count; ++c) {
    const std::vector<double> w = weights(row, c);
    double sum = 0;
    for (std::size_t k = 0; k < row.count; ++k) sum += w[k] * unknowns[row.first + k];
    coefficients.push_back(sum);
  }
  return coefficients;
}

Dependence LawUnknowns::dependence(std::span<const double> unknowns) const {
  Dependence result;
  for (const Row& row : rows_) {
    const bool is_drive = row.param.fit == Fit::Drive;
    result.forms.push_back(is_drive ? Form::Linear : row.form);
    result.coefficients.push_back(is_drive ? std::vector<double>{0, 1} : values(row, unknowns));
  }
  return result;
}

/// Brings the filter's rate to what the other parameters allow at the drive where they allow least.
void LawUnknowns::slow_filter_of(Dependence& dependence) const {
  constexpr int kDrives = 9;
  double share = 1;
  std::vector<double> p(law_->params.size());
  for (int k = 0; k < kDrives; ++k) {
    const double drive = drive_min_ + (drive_max_ - drive_min_) * k / (kDrives - 1);
    for (std::size_t n = 0; n < p.size(); ++n) p[n] = dependence.at(n, drive);
    share = std::min(share, filter_share_ * law_->fastest_rate(p.data()) / p[law_->rate_parameter]);
  }

  // All coefficients but an exponential's rate scale with the parameter.
  std::vector<double>& rate = dependence.coefficients[law_->rate_parameter];
  const bool is_exponential = dependence.forms[law_->rate_parameter] == Form::Exponential;
  const double floor = law_->params[law_->rate_parameter].lower / rate.front();
  for (std::size_t c = 0; c < (is_exponential ? 2 : rate.size()); ++c)
    rate[c] *= std::max(share, floor);
}

LawModel LawUnknowns::model_of(Dependence dependence, std::span<const double> unknowns) const {
  if (slows_filter()) slow_filter_of(dependence);
  return LawModel(*law_, std::move(dependence), drive_unit_,
                  lag_ ? values(*lag_, unknowns).front() : 0);
}

LawModel LawUnknowns::model(std::span<const double> unknowns) const {
  return model_of(dependence(unknowns), unknowns);
}

std::vector<double> LawUnknowns::of(const LawModel& model) const {
  std::vector<double> unknowns = start_;
  for (std::size_t p = 0; p < rows_.size(); ++p) {
    const Row& row = rows_[p];
    std::vector<double> c = model.parameters().coefficients[p];
    if (row.form == Form::Exponential && is_polynomial(model.parameters().forms[p]))
      c = exponential_through(model.parameters().at(p, 0),
                              model.parameters().at(p, drive_min_ + drive_span()),
                              drive_min_ + drive_span());

    // An exponential by its ends and rate, a polynomial by its values at the nodes.
    for (std::size_t k = 0; k < row.count; ++k) {
      const double node = row.count == 1 ? drive_min_
                                         : drive_min_ + drive_span() * static_cast<double>(k) /
                                                            static_cast<double>(row.count - 1);
      unknowns[row.first + k] = row.form != Form::Exponential
                                    ? model.parameters().at(p, node) / row.size
                                : k < 2 ? c[k] / row.size
                                        : c[k] * drive_span();
    }
  }
  if (lag_ && lag_->count > 0) unknowns[lag_->first] = model.lag_rate() / lag_->size;

  for (std::size_t k = 0; k < unknowns.size(); ++k)
    unknowns[k] = std::clamp(unknowns[k], lower_[k], upper_[k]);
  return unknowns;
}

std::vector<LawUnknowns::Group> LawUnknowns::groups() const {
  std::vector<Group> out;
  for (std::size_t p = 0; p < rows_.size(); ++p)
    if (rows_[p].count > 0) out.push_back({p, rows_[p].first, rows_[p].count});
  return out;
}

std::vector<LawUnknowns::Flattened> LawUnknowns::flattened(std::span<const double> unknowns) const {
  std::vector<Flattened> all;
  for (const Group& group : groups()) {
    if (group.count < 2 || !is_polynomial(form_of(group.parameter))) continue;
    all.push_back({group, {unknowns.begin(), unknowns.end()}});
    const std::span<double> own = std::span(all.back().unknowns).subspan(group.first, group.count);
    std::ranges::fill(own, own.back());
  }
  return all;
}

double LawUnknowns::step(std::span<const double> unknowns, const Group& group) const {
  constexpr double kStep = 1e-6;
  const Row& row = rows_[group.parameter];
  const std::size_t ends = row.form == Form::Exponential ? 2 : row.count;
  const std::span<const double> own = unknowns.subspan(group.first, ends);
  const auto [low, high] = std::minmax_element(own.begin(), own.end());
  const double length = kStep * std::max({1.0, std::abs(*low), std::abs(*high)});
  const bool upward = *high + length <= upper_[group.first] || *low - length < lower_[group.first];
  return row.size * (upward ? length : -length);
}

LawModel LawUnknowns::moved(std::span<const double> unknowns, const Group& group,
                            double step) const {
  Dependence result = dependence(unknowns);
  result.coefficients[group.parameter][0] += step;
  if (result.forms[group.parameter] == Form::Exponential)
    result.coefficients[group.parameter][1] += step;
  return model_of(std::move(result), unknowns);
}

double LawUnknowns::slope(std::span<const double> unknowns, const Group& group, std::size_t k,
                          double current) const {
  const Row& row = rows_[group.parameter];
  if (row.form == Form::Exponential) {
    const double decay = std::exp(-unknowns[row.first + 2] / drive_span() * current);
    if (k < 2) return row.size * (k == 0 ? decay : 1 - decay);
    return row.size * (unknowns[row.first + 1] - unknowns[row.first]) * current / drive_span() *
           decay;
  }
  double sum = 0;
  for (std::size_t c = row.count; c-- > 0;) sum = sum * current + weights(row, c)[k];
  return sum;
}

std::vector<LawUnknowns::PriorTerm> LawUnknowns::priors() const {
  std::vector<PriorTerm> terms;
  const auto add = [&](const Row& row) {
    if (!row.prior) return;
    const std::size_t values = row.form == Form::Exponential ? 2 : row.count;
    for (std::size_t k = 0; k < values; ++k) terms.push_back({row.first + k, row.size, *row.prior});
  };
  for (const Row& row : rows_) add(row);
  if (lag_) add(*lag_);
  return terms;
}

std::vector<LawUnknowns::Coefficient> LawUnknowns::coefficients(
    std::span<const double> unknowns) const {
  std::vector<Coefficient> out;
  const auto add = [&](const Row& row, const std::vector<double>& fitted) {
    if (row.param.fit == Fit::Drive) return;

    for (std::size_t c = 0; c < coefficient_count(row.form); ++c) {
      Coefficient coefficient{.name = coefficient_name(row.param.name, row.form, c),
                              .unit = coefficient_unit(row.param.unit, row.form, c, drive_unit_),
                              .meaning = std::string(row.param.meaning),
                              .value = fitted[c],
                              .first = row.first};

      // A fitted one is a weighted sum of its parameter's unknowns.
      if (row.count > 0) {
        coefficient.weights = weights(row, c);
        for (std::size_t k = 0; k < row.count; ++k)
          coefficient.at_bound |= at_bound(unknowns, row.first + k);
      }
      out.push_back(std::move(coefficient));
    }
  };

  // The law's parameters in the order of its table, then the lag.
  const Dependence own = model(unknowns).parameters();
  for (std::size_t p = 0; p < rows_.size(); ++p) add(rows_[p], own.coefficients[p]);
  if (lag_) add(*lag_, values(*lag_, unknowns));
  return out;
}

}  // namespace dashpot
