#pragma once
#include <array>
#include <cstddef>
#include <vector>

namespace dashpot {

/// The degree to which a value belongs to a fuzzy set on one (standardised) input, 0 ... 1.
struct Membership {
  enum class Shape {
    Bell,      ///< 1 / (1 + |(x - centre) / width|^(2 slope))
    Gaussian,  ///< exp(-((x - centre) / width)^2 / 2)
    Sigmoid    ///< 1 / (1 + exp(-slope (x - centre)))
  };
  Shape shape = Shape::Bell;
  std::size_t input = 0;
  double centre = 0;
  double width = 1;  ///< positive; not of a sigmoid
  double slope = 1;  ///< positive for a bell, any for a sigmoid; not of a Gaussian

  /// Never 0, so that rules which all hold far away only still have a mean.
  double at(double x) const noexcept;
  /// d ln(at) / d (centre, ln width, ln |slope|); 0 by what the shape has not. `value` is at(x).
  std::array<double, 3> log_gradient(double x, double value) const noexcept;
  std::size_t parameter_count() const noexcept { return shape == Shape::Bell ? 3 : 2; }
};

/// Takagi-Sugeno inference of first order: each rule is a linear function of the inputs, and the
/// output is their mean, weighted by how far each rule holds (product of its memberships). Takagi &
/// Sugeno, IEEE Trans. SMC 15 (1985) 116; Jang, IEEE Trans. SMC 23 (1993) 665.
struct Sugeno {
  /// standardised = (raw - mean) / scale. Memberships see it held within low ... high: beyond the
  /// data the mixture of rules stays as at their edge, and the output goes on along a straight
  /// line.
  struct Input {
    double mean = 0, scale = 1;
    double low = -1, high = 1;  ///< standardised
  };
  std::vector<Input> inputs;
  std::vector<Membership> memberships;
  std::vector<std::vector<std::size_t>> rules;  ///< per rule: its memberships
  std::vector<double> consequents;  ///< rule after rule: a slope per input, then the constant
  double output_mean = 0, output_scale = 1;  ///< raw = mean + scale * standardised

  static constexpr std::size_t kMaxInputs = 8, kMaxMemberships = 64, kMaxRules = 256;
  static constexpr std::size_t kMaxTerms = 8;  ///< memberships of one rule

  std::size_t consequent_count() const noexcept { return rules.size() * (inputs.size() + 1); }
  std::size_t parameter_count() const noexcept;  ///< of memberships and consequents

  /// Output at one raw input, in raw units. Allocates nothing.
  double evaluate(const double* raw) const noexcept;
  /// Standardised inputs, and those held within the data, as the memberships see them.
  void standardise(const double* raw, double* linear, double* held) const noexcept;
  /// Values of the memberships, and the share of each rule (sum 1).
  void share(const double* held, double* values, double* shares) const noexcept;
};

}  // namespace dashpot
