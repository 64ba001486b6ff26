#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "dashpot/damper/model_info.h"
#include "dashpot/damper_model.h"
#include "dashpot/value.h"

namespace dashpot {

/// The weighted mean of models of one damper, of whatever kinds (Bates and Granger, Operational
/// Research Quarterly 20, 1969, 451): F = sum_m w_m F_m + offset. It generates no energy where none
/// of them does. Its state: theirs, one after the other.
class MeanModel final : public DamperModel {
 public:
  struct Member {
    std::shared_ptr<const DamperModel> model;
    double weight = 0;
  };

  /// Throws Error, beginning with `where` (the name when empty), at fewer than two members, weights
  /// that are not above 0 or do not add up to 1, and a member that may_be_member() refuses.
  explicit MeanModel(std::vector<Member> members, double offset = 0, const std::string& where = {});

  /// Whether a mean may hold it: not one that feeds its force back, is of a whole family, or is a
  /// mean itself.
  static bool may_be_member(const DamperModel& model);

  ModelKind kind() const override { return ModelKind::Mean; }
  std::string name() const override;
  bool needs_displacement() const noexcept override;
  std::size_t parameter_count() const noexcept override;
  std::size_t state_size() const noexcept override;
  void rest(const DamperInput& input, std::span<double> state) const noexcept override;
  void advance(const DamperInput& from, const DamperInput& to, double dt,
               std::span<double> state) const noexcept override;
  double force(const DamperInput& input, std::span<const double> state) const noexcept override;
  bool flows() const noexcept override;
  double flow(const DamperInput& input, std::span<const double> state,
              std::span<double> rates) const noexcept override;
  bool is_ensemble() const noexcept override { return true; }
  /// By how much the members differ, and each of them within itself.
  double spread(const DamperInput& input, std::span<const double> state) const noexcept override;
  std::unique_ptr<DamperModel> with_offset(double newton) const override;
  Value to_json() const override;

  const std::vector<Member>& members() const { return members_; }
  double offset() const { return offset_; }

 private:
  std::vector<Member> members_;
  double offset_;
};

/// read: of a member of that kind, what its to_json() wrote.
std::unique_ptr<MeanModel> mean_model_from_json(
    const Value& value, std::unique_ptr<DamperModel> (*read)(ModelKind kind, const Value& value));

ModelInfo mean_info();  ///< what the registry says of it

}  // namespace dashpot
