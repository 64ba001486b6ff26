#include <algorithm>
#include <cmath>

#include "dashpot/base/find_row.h"
#include "dashpot/damper/kinds/family/family_force.h"
#include "dashpot/damper/nets/mlp_json.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

template <double FamilyMember::* field>
double of_member(const FamilyMember& member, const DamperInput&) {
  return member.*field;
}
template <double DamperInput::* field>
double of_instant(const FamilyMember&, const DamperInput& input) {
  return input.*field;
}

constexpr struct {
  std::string_view name;
  FamilyInput read;
} kInputs[] = {{"piston_area", of_member<&FamilyMember::piston_area>},
               {"gap_area", of_member<&FamilyMember::gap_area>},
               {"gap", of_member<&FamilyMember::gap>},
               {"pole_length", of_member<&FamilyMember::pole_length>},
               {"viscosity", of_member<&FamilyMember::viscosity>},
               {kYieldStress, [](const FamilyMember& m,
                                 const DamperInput& input) { return m.yield.at(input.current); }},
               {"velocity", of_instant<&DamperInput::velocity>},
               {"displacement", of_instant<&DamperInput::displacement>},
               {"current", of_instant<&DamperInput::current>}};

}  // namespace

FamilyInput family_input_named(std::string_view name, const std::string& where) {
  return find_row(kInputs, name, "input", where).read;
}

FamilyNetwork::FamilyNetwork(std::vector<std::string> inputs, std::vector<Mlp> members,
                             const std::string& where)
    : inputs_(std::move(inputs)), mlps_(std::move(members)) {
  if (mlps_.empty()) throw Error(where, "has no members", "a network at least");
  for (const std::string& input : inputs_) reads_.push_back(family_input_named(input, where));
  for (const Mlp& mlp : mlps_) {
    require_shape(mlp, inputs_.size(), where);
    evaluators_.emplace_back(mlp);
  }
}

bool FamilyNetwork::needs_displacement() const noexcept {
  return std::find(inputs_.begin(), inputs_.end(), "displacement") != inputs_.end();
}

std::size_t FamilyNetwork::parameter_count() const noexcept {
  std::size_t count = 0;
  for (const Mlp& mlp : mlps_) count += mlp.parameters.size();
  return count;
}

FamilyNetwork::Row FamilyNetwork::read(const FamilyMember& member,
                                       const DamperInput& input) const noexcept {
  Row row;
  for (std::size_t k = 0; k < reads_.size(); ++k) row[k] = reads_[k](member, input);
  return row;
}

double FamilyNetwork::force(const FamilyMember& member, const DamperInput& input,
                            std::span<const double>) const noexcept {
  const Row row = read(member, input);
  double sum = 0;
  for (const MlpEvaluator<double>& evaluator : evaluators_) sum += evaluator.evaluate(row.data());
  return sum / static_cast<double>(evaluators_.size());
}

double FamilyNetwork::spread(const FamilyMember& member, const DamperInput& input) const noexcept {
  if (!is_ensemble()) return 0;
  const Row row = read(member, input);
  const double mean = force(member, input, {});
  double squares = 0;
  for (const MlpEvaluator<double>& evaluator : evaluators_) {
    const double off = evaluator.evaluate(row.data()) - mean;
    squares += off * off;
  }
  return std::sqrt(squares / static_cast<double>(evaluators_.size() - 1));
}

Value FamilyNetwork::to_json() const {
  Value members = Value::array();
  for (const Mlp& mlp : mlps_) {
    Value member = Value::object();
    add_mlp(member, mlp);
    members.push_back(std::move(member));
  }
  return Value::object(
      {{"kind", "network"}, {"inputs", Value::array(inputs_)}, {"members", std::move(members)}});
}

}  // namespace dashpot
