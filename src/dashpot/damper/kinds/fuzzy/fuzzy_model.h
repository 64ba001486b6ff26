#pragma once
#include <memory>
#include <string>
#include <vector>

#include "dashpot/damper/kinds/fuzzy/fuzzy_inputs.h"
#include "dashpot/damper/kinds/fuzzy/sugeno.h"
#include "dashpot/damper_model.h"

namespace dashpot {

/// A Takagi-Sugeno model: inputs, two of them after a lag -> force.
class FuzzyModel final : public DamperModel {
 public:
  /// Throws Error, beginning with `where` (the name when empty), when the parts do not fit
  /// together.
  FuzzyModel(std::string name, FuzzyInputs inputs, Sugeno sugeno, double offset = 0,
             const std::string& where = {});

  ModelKind kind() const override { return ModelKind::Fuzzy; }
  std::string name() const override { return name_; }
  bool needs_displacement() const noexcept override { return inputs_.has("displacement"); }
  /// The rules' and memberships', and a lag for each state.
  std::size_t parameter_count() const noexcept override {
    return sugeno_.parameter_count() + inputs_.state_size();
  }
  std::size_t state_size() const noexcept override { return inputs_.state_size(); }
  void rest(const DamperInput& input, std::span<double> state) const noexcept override {
    inputs_.rest(input, state);
  }
  void advance(const DamperInput& from, const DamperInput& to, double dt,
               std::span<double> state) const noexcept override {
    inputs_.advance(from, to, dt, state);
  }
  double force(const DamperInput& input, std::span<const double> state) const noexcept override;
  std::unique_ptr<DamperModel> with_offset(double newton) const override;
  Value to_json() const override;

  const FuzzyInputs& inputs() const { return inputs_; }
  const Sugeno& sugeno() const { return sugeno_; }
  double offset() const { return offset_; }

 private:
  std::string name_;
  FuzzyInputs inputs_;
  Sugeno sugeno_;
  double offset_;
};

std::unique_ptr<FuzzyModel> fuzzy_model_from_json(const Value& value);

}  // namespace dashpot
