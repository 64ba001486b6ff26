#pragma once
#include <span>
#include <string>
#include <vector>

#include "dashpot/base/random.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/drive.h"
#include "dashpot/evaluate.h"
#include "dashpot/identify/fit/parameter_choice.h"

namespace dashpot {

/// How large the quantities in a set of records are: what a fit's starting values are scaled by.
struct DataScale {
  double force = 1;   ///< N, half the largest force span of a record
  double stroke = 1;  ///< m, half the largest displacement span
  double speed = 1;   ///< m/s, largest |v|
  DriveRange drive;

  /// Size of a quantity of this unit in these data: N -> force, s/m -> 1/speed, 1/m^2 -> 1/stroke^2
  /// ...
  double of_unit(std::string_view unit) const;
};
DataScale data_scale(const std::vector<Record>& records, DriveUnit drive_unit);

/// The unknowns of a law's fit. A parameter that depends on current is described by its values at
/// one to four currents across the data's range (an exponential one by its ends and its rate), so
/// that the table's bounds are box bounds; each value is counted in the size expected from the
/// data. The coil's lag rate joins them when the drive varies within a record.
class LawUnknowns {
 public:
  /// model: whose choices hold, a hybrid's or the law's own (when empty).
  LawUnknowns(const Law& law, const DataScale& scale, DriveUnit drive_unit, OffsetMode offset,
              const std::vector<ParameterChoice>& choices = {}, std::string_view model = {});

  std::size_t size() const { return lower_.size(); }
  const std::vector<double>& lower() const { return lower_; }
  const std::vector<double>& upper() const { return upper_; }
  /// The start of the fit; with `random`, each value is moved by a factor of 1/3 to 3.
  std::vector<double> start(Random* random = nullptr) const;
  /// The unknowns, with those that stand at a bound back inside.
  std::vector<double> off_bounds(std::vector<double> unknowns) const;
  LawModel model(std::span<const double> unknowns) const;
  /// The unknowns of a model of this law; a parameter of another form by its values over the drive
  /// of the data.
  std::vector<double> of(const LawModel& model) const;
  /// The form in which these unknowns describe a parameter.
  Form form_of(std::size_t parameter) const { return rows_[parameter].form; }
  bool fits_lag() const { return lag_.has_value(); }

  /// From now on a model's filter is no quicker than this share of the law's fastest_rate, at every
  /// drive of the data.
  void slow_filter(double share) { filter_share_ = share; }
  bool slows_filter() const { return filter_share_ > 0; }
  /// Warnings, in words, of wishes that these data cannot fulfil.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// One coefficient of the model as a linear combination of unknowns.
  struct Coefficient {
    std::string name, unit, meaning;
    double value = 0;
    std::size_t first = 0;        ///< index of the first unknown it depends on
    std::vector<double> weights;  ///< empty: fixed
    bool at_bound = false;
  };
  std::vector<Coefficient> coefficients(std::span<const double> unknowns) const;

  /// The unknowns first ... first + count - 1 act through one parameter of the law.
  struct Group {
    std::size_t parameter = 0, first = 0, count = 0;
  };
  std::vector<Group> groups() const;
  /// From where a fit may end elsewhere: one parameter after the other that follows the drive as a
  /// polynomial is at all drives what it is at the greatest.
  struct Flattened {
    Group group;
    std::vector<double> unknowns;
  };
  std::vector<Flattened> flattened(std::span<const double> unknowns) const;
  /// A small step of the group's parameter, in its unit, that stays within its bounds where it can.
  double step(std::span<const double> unknowns, const Group& group) const;
  /// The model with the group's parameter moved by `step` at every current.
  LawModel moved(std::span<const double> unknowns, const Group& group, double step) const;
  /// d parameter / d unknown first + k, at that current.
  double slope(std::span<const double> unknowns, const Group& group, std::size_t k,
               double current) const;

  /// (size * unknown - value) / deviation is standard normal before the fit.
  struct PriorTerm {
    std::size_t unknown = 0;
    double size = 1;
    Prior prior;

    /// Beside residuals whose standard deviation is `noise`.
    double residual(double x, double noise) const {
      return noise * (size * x - prior.value) / prior.deviation;
    }
    double slope(double noise) const { return noise * size / prior.deviation; }
  };
  std::vector<PriorTerm> priors() const;

 private:
  struct Row {
    ParamInfo param;        ///< as chosen
    std::size_t first = 0;  ///< index of its first unknown
    std::size_t count = 0;  ///< unknowns; 0: fixed at `value`
    double size = 1;        ///< SI value of one unit of the unknown
    double value = 0;
    Form form = Form::Constant;
    std::optional<Prior> prior;
  };
  Row make_row(const ParamInfo& table, const ParameterChoice& choice, const DataScale& scale,
               OffsetMode offset);
  void add_unknowns(Row& row);
  std::vector<double> weights(const Row& row, std::size_t coefficient) const;
  std::vector<double> values(const Row& row, std::span<const double> unknowns) const;
  bool at_bound(std::span<const double> unknowns, std::size_t k) const;
  Dependence dependence(std::span<const double> unknowns) const;
  void slow_filter_of(Dependence& dependence) const;
  LawModel model_of(Dependence dependence, std::span<const double> unknowns) const;
  double drive_span() const { return drive_max_ > drive_min_ ? drive_max_ - drive_min_ : 1; }

  const Law* law_;
  DriveUnit drive_unit_;
  double drive_min_, drive_max_;
  std::vector<Row> rows_;    ///< one per parameter of the law
  std::optional<Row> lag_;   ///< when the drive varies
  double filter_share_ = 0;  ///< 0: the filter stays as it is
  std::vector<double> lower_, upper_, start_;
  std::vector<std::string> warnings_;
};

}  // namespace dashpot
