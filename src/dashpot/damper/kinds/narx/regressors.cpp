#include "dashpot/damper/kinds/narx/regressors.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/network/network_model.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

std::size_t largest(const std::vector<std::size_t>& lags) {
  return lags.empty() ? 0 : *std::max_element(lags.begin(), lags.end());
}

void require_lags(const std::vector<std::size_t>& lags, std::size_t least,
                  const std::string& where) {
  for (const std::size_t lag : lags)
    if (lag < least || lag > Regressors::kMostLag)
      throw Error(where, "a lag of " + std::to_string(lag) + " steps",
                  std::to_string(least) + " to " + std::to_string(Regressors::kMostLag));
}

Value lags_to_json(const std::vector<std::size_t>& lags) {
  return Value::array(std::vector<double>(lags.begin(), lags.end()));
}

std::vector<std::size_t> read_lags(const Value& value) {
  std::vector<std::size_t> lags;
  for (const Value& item : value.items()) {
    const double lag = item.as_number();
    if (!(lag >= 0 && lag <= Regressors::kMostLag && lag == std::floor(lag)))
      throw Error(item.where(), "a lag of " + format_number(lag) + " steps",
                  "write a whole number, at most " + std::to_string(Regressors::kMostLag));
    lags.push_back(static_cast<std::size_t>(lag));
  }
  return lags;
}

}  // namespace

std::size_t Regressors::Input::depth() const { return largest(lags); }

Regressors Regressors::of(const std::vector<std::string>& inputs, std::size_t delays,
                          std::size_t fed_back, double sample_time) {
  Regressors regressors;
  regressors.sample_time = sample_time;
  std::vector<std::size_t> lags;
  for (std::size_t lag = 0; lag <= delays; ++lag) lags.push_back(lag);
  for (const std::string& input : inputs) regressors.inputs.push_back({input, lags});
  for (std::size_t lag = 1; lag <= fed_back; ++lag) regressors.feedback.push_back(lag);
  return regressors;
}

std::size_t Regressors::input_count() const {
  std::size_t count = 0;
  for (const Input& input : inputs) count += input.lags.size();
  return count;
}

std::size_t Regressors::feedback_depth() const { return largest(feedback); }

std::size_t Regressors::depth() const {
  std::size_t depth = feedback_depth();
  for (const Input& input : inputs) depth = std::max(depth, input.depth());
  return depth;
}

bool Regressors::needs_displacement() const {
  return std::any_of(inputs.begin(), inputs.end(),
                     [](const Input& input) { return input.name == "displacement"; });
}

void require_usable(const Regressors& regressors, const std::string& where) {
  if (regressors.inputs.empty()) throw Error(where, "has no inputs", "one at least");
  for (const Regressors::Input& input : regressors.inputs) {
    input_field(input.name, where);
    if (input.lags.empty())
      throw Error(where, "the input " + input.name + " has no lags", "one at least");
    require_lags(input.lags, 0, where);
  }
  require_lags(regressors.feedback, 1, where);
  if (!(regressors.sample_time > 0 && std::isfinite(regressors.sample_time)))
    throw Error(where, "the sample time is not a positive number");
}

std::vector<double> regressor_rows(const Regressors& regressors,
                                   const std::vector<DamperInput>& inputs,
                                   const std::vector<double>& force) {
  std::vector<double> rows;
  for (std::size_t k = regressors.depth(); k < inputs.size(); ++k) {
    for (const Regressors::Input& input : regressors.inputs) {
      const auto field = input_field(input.name, {});
      for (const std::size_t lag : input.lags) rows.push_back(inputs[k - lag].*field);
    }
    for (const std::size_t lag : regressors.feedback) rows.push_back(force[k - lag]);
  }
  return rows;
}

Value to_json(const Regressors& regressors) {
  Value inputs = Value::array();
  for (const Regressors::Input& input : regressors.inputs)
    inputs.push_back(Value::object({{"name", input.name}, {"lags", lags_to_json(input.lags)}}));
  return Value::object({{"inputs", std::move(inputs)},
                        {"feedback", lags_to_json(regressors.feedback)},
                        {"sample_time", regressors.sample_time}});
}

Regressors read_regressors(const Value& value) {
  ObjectReader reader(value, "the regressors");
  Regressors regressors;
  for (const Value& item : reader.required("inputs").items()) {
    ObjectReader input(item, "an input");
    std::string name = input.string("name");
    regressors.inputs.push_back({std::move(name), read_lags(input.required("lags"))});
    input.finish();
  }
  regressors.feedback = read_lags(reader.required("feedback"));
  regressors.sample_time = reader.number("sample_time");
  reader.finish();
  return regressors;
}

}  // namespace dashpot
