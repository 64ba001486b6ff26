#include "dashpot/record/readers/tdms_scale.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr std::size_t kRawInput = 0xFFFFFFFF;
constexpr std::size_t kMostSteps = 64, kMostNumbers = 10'000;

/// The properties of one step.
class StepProperties {
 public:
  StepProperties(const TdmsProperties& all, std::size_t step, std::string file)
      : all_(all), begin_("NI_Scale[" + std::to_string(step) + "]_"), file_(std::move(file)) {}

  std::string kind() const {
    const auto found = all_.find(begin_ + "Scale_Type");
    const auto* text = found == all_.end() ? nullptr : std::get_if<std::string>(&found->second);
    return text ? *text : "";
  }
  double number(const std::string& name) const {
    const auto found = all_.find(begin_ + name);
    const auto* value = found == all_.end() ? nullptr : std::get_if<double>(&found->second);
    if (!value) throw Error(file_, "a scale lacks its property " + begin_ + name);
    return *value;
  }
  std::size_t count(const std::string& name) const {
    const double value = number(name);
    if (!(value >= 0 && value <= double(kMostNumbers)))
      throw Error(file_, begin_ + name + " is no number of values");
    return static_cast<std::size_t>(value);
  }
  /// The step that another one reads, or kRawInput.
  std::size_t input(const std::string& name) const {
    if (!all_.contains(begin_ + name)) return kRawInput;
    const double value = number(name);
    return value >= 0 && value < double(kMostSteps) ? static_cast<std::size_t>(value) : kRawInput;
  }
  std::vector<double> numbers(const std::string& name, std::size_t size) const {
    std::vector<double> all;
    for (std::size_t k = 0; k < size; ++k)
      all.push_back(number(name + "[" + std::to_string(k) + "]"));
    return all;
  }

 private:
  const TdmsProperties& all_;
  const std::string begin_, file_;
};

/// How many steps are stated; 0 where the values are scaled already.
std::size_t steps_of(const TdmsProperties& properties) {
  const auto status = properties.find("NI_Scaling_Status");
  if (status != properties.end())
    if (const auto* text = std::get_if<std::string>(&status->second); text && *text == "scaled")
      return 0;
  const auto stated = properties.find("NI_Number_Of_Scales");
  if (stated != properties.end())
    if (const auto* number = std::get_if<double>(&stated->second))
      return *number >= 1 ? static_cast<std::size_t>(std::min(*number, double(kMostSteps))) : 0;
  std::size_t steps = 0;
  while (steps < kMostSteps &&
         properties.contains("NI_Scale[" + std::to_string(steps) + "]_Scale_Type"))
    ++steps;
  return steps;
}

/// Straight between the pairs, and as they end beyond them.
double from_pairs(const std::vector<double>& pairs, double x) {
  const std::size_t count = pairs.size() / 2;
  if (count == 0 || std::isnan(x)) return x;
  std::size_t above = 0;
  while (above < count && pairs[2 * above] < x) ++above;
  if (above == 0) return pairs[1];
  if (above == count) return pairs[2 * count - 1];
  const double x0 = pairs[2 * above - 2], y0 = pairs[2 * above - 1];
  const double x1 = pairs[2 * above], y1 = pairs[2 * above + 1];
  return y0 + (y1 - y0) * (x - x0) / (x1 - x0);
}

}  // namespace

TdmsScale TdmsScale::of(const std::vector<const TdmsProperties*>& sets, const std::string& file) {
  TdmsScale scale;
  const auto stated =
      std::ranges::find_if(sets, [](const TdmsProperties* set) { return steps_of(*set) > 0; });
  if (stated == sets.end()) return scale;

  for (std::size_t k = 0; k < steps_of(**stated); ++k) {
    const StepProperties step(**stated, k, file);
    const std::string kind = step.kind();
    using Kind = Step::Kind;
    if (kind.empty()) {  // what DAQmx gives
      scale.steps_.push_back({Kind::Raw, kRawInput, kRawInput, {}});
    } else if (kind == "AdvancedAPI") {
      scale.steps_.push_back(
          {Kind::Polynomial, step.input("AdvancedAPI_Input_Source"), kRawInput, {0, 1}});
    } else if (kind == "Linear") {
      scale.steps_.push_back({Kind::Polynomial,
                              step.input("Linear_Input_Source"),
                              kRawInput,
                              {step.number("Linear_Y_Intercept"), step.number("Linear_Slope")}});
    } else if (kind == "Polynomial") {
      const std::size_t size = step.count("Polynomial_Coefficients_Size");
      scale.steps_.push_back({Kind::Polynomial, step.input("Polynomial_Input_Source"), kRawInput,
                              step.numbers("Polynomial_Coefficients", size)});
    } else if (kind == "Table") {
      const std::size_t size = std::min(step.count("Table_Pre_Scaled_Values_Size"),
                                        step.count("Table_Scaled_Values_Size"));
      const auto scaled = step.numbers("Table_Scaled_Values", size);
      const auto raw = step.numbers("Table_Pre_Scaled_Values", size);
      const bool descending = size > 1 && raw.front() > raw.back();
      std::vector<double> pairs;
      for (std::size_t j = 0; j < size; ++j) {
        const std::size_t at = descending ? size - 1 - j : j;
        pairs.push_back(raw[at]), pairs.push_back(scaled[at]);
      }
      scale.steps_.push_back(
          {Kind::Table, step.input("Table_Input_Source"), kRawInput, std::move(pairs)});
    } else if (kind == "Add" || kind == "Subtract") {
      scale.steps_.push_back({kind == "Add" ? Kind::Add : Kind::Subtract,
                              step.input(kind + "_Left_Operand_Input_Source"),
                              step.input(kind + "_Right_Operand_Input_Source"),
                              {}});
    } else {
      scale.unread_ = "its scale is of the kind '" + kind + "'";
      return scale;
    }
    // A step reads earlier ones alone, so that none waits for itself.
    for (const std::size_t input : {scale.steps_.back().input, scale.steps_.back().second})
      if (input != kRawInput && input >= k)
        throw Error(file, "scale " + std::to_string(k) + " reads scale " + std::to_string(input));
  }
  return scale;
}

double TdmsScale::operator()(double raw) const {
  // Each step reads the raw value or the outcome of an earlier step.
  std::array<double, kMostSteps> values;
  const auto value_of = [&](std::size_t step) { return step == kRawInput ? raw : values[step]; };

  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const Step& step = steps_[k];
    const double x = value_of(step.input);
    switch (step.kind) {
      case Step::Kind::Raw:
        values[k] = raw;
        break;
      case Step::Kind::Polynomial:
        values[k] = 0;
        for (std::size_t j = step.numbers.size(); j-- > 0;)
          values[k] = values[k] * x + step.numbers[j];
        break;
      case Step::Kind::Table:
        values[k] = from_pairs(step.numbers, x);
        break;
      case Step::Kind::Add:
        values[k] = x + value_of(step.second);
        break;
      case Step::Kind::Subtract:  // NI's own programs take the left from the right
        values[k] = value_of(step.second) - x;
        break;
    }
  }

  // The last step's outcome is the channel's value.
  return steps_.empty() ? raw : values[steps_.size() - 1];
}

}  // namespace dashpot
