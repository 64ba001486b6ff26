#pragma once
#include <memory>
#include <string>
#include <vector>

#include "dashpot/damper_model.h"

namespace dashpot {

/// One way in which a damper may have become another than its model: what a given amount of it
/// adds to the model's force. It works for any model.
struct Wear {
  std::string name;                                         ///< "force"
  std::string unit;                                         ///< of an amount, SI; "1": a share
  std::string meaning;                                      ///< for people
  double usual;                                             ///< an amount that is small and shows
  double (*added)(const DamperInput& input, double force);  ///< N per unit of it
};
const std::vector<Wear>& wears();
/// Throws Error that names the known ones.
const Wear& find_wear(const std::string& name, const std::string& where);

/// A damper after so much wear: the force of its model and, of each wear, its amount's part. The
/// model is to be in equilibrium at rest, so that no wear moves that.
class WornDamper final : public DamperModel {
 public:
  struct Amount {
    const Wear* wear;
    double value;
  };
  /// offset: N, added to the worn force.
  WornDamper(std::shared_ptr<const DamperModel> as_new, std::vector<Amount> amounts,
             double offset = 0)
      : as_new_(std::move(as_new)), amounts_(std::move(amounts)), offset_(offset) {}

  ModelKind kind() const override { return as_new_->kind(); }
  std::string name() const override { return as_new_->name(); }
  bool needs_displacement() const noexcept override { return true; }
  std::size_t parameter_count() const noexcept override { return as_new_->parameter_count(); }
  std::size_t state_size() const noexcept override { return as_new_->state_size(); }
  void rest(const DamperInput& input, std::span<double> state) const noexcept override {
    as_new_->rest(input, state);
  }
  void advance(const DamperInput& from, const DamperInput& to, double dt,
               std::span<double> state) const noexcept override {
    as_new_->advance(from, to, dt, state);
  }
  double force(const DamperInput& input, std::span<const double> state) const noexcept override {
    return worn(input, as_new_->force(input, state));
  }
  bool flows() const noexcept override { return as_new_->flows(); }
  double flow(const DamperInput& input, std::span<const double> state,
              std::span<double> rates) const noexcept override {
    return worn(input, as_new_->flow(input, state, rates));
  }
  std::unique_ptr<DamperModel> with_offset(double newton) const override;
  /// Throws Error: no file holds a worn damper.
  Value to_json() const override;

 private:
  double worn(const DamperInput& input, double force) const noexcept {
    double sum = force + offset_;
    for (const Amount& one : amounts_) sum += one.value * one.wear->added(input, force);
    return sum;
  }

  std::shared_ptr<const DamperModel> as_new_;
  std::vector<Amount> amounts_;
  double offset_;
};

}  // namespace dashpot
