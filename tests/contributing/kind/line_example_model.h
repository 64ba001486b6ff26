#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "dashpot/damper/model_info.h"
#include "dashpot/damper_model.h"

namespace dashpot {

/// A kind of model for CONTRIBUTING.md: a straight line, F = c v + f0. No state.
class LineExampleModel final : public DamperModel {
 public:
  LineExampleModel(double damping, double offset) : damping_(damping), offset_(offset) {}

  ModelKind kind() const override { return ModelKind::LineExample; }
  std::string name() const override { return "line_example"; }
  bool needs_displacement() const noexcept override { return false; }
  std::size_t parameter_count() const noexcept override { return 1; }
  std::size_t state_size() const noexcept override { return 0; }
  void rest(const DamperInput&, std::span<double>) const noexcept override {}
  void advance(const DamperInput&, const DamperInput&, double,
               std::span<double>) const noexcept override {}
  double force(const DamperInput& input, std::span<const double>) const noexcept override {
    return damping_ * input.velocity + offset_;
  }
  std::unique_ptr<DamperModel> with_offset(double newton) const override {
    return std::make_unique<LineExampleModel>(damping_, offset_ + newton);
  }
  Value to_json() const override;

  double damping() const { return damping_; }
  double offset() const { return offset_; }

 private:
  double damping_;  ///< N*s/m
  double offset_;   ///< N
};

std::unique_ptr<LineExampleModel> line_example_model_from_json(const Value& value);

struct LineExamplePreset {
  std::string_view name, title, equation, source, remarks;

  ModelInfo info() const;
};
std::span<const LineExamplePreset> line_example_presets();

}  // namespace dashpot
