#include "dashpot/damper/kinds/mean/mean_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

/// Calls use(member, its part of the state) for one after the other.
template <class State, class Use>
void for_each_part(const std::vector<MeanModel::Member>& members, State state, Use&& use) {
  for (const MeanModel::Member& member : members) {
    use(member, state.first(member.model->state_size()));
    state = state.subspan(member.model->state_size());
  }
}

}  // namespace

bool MeanModel::may_be_member(const DamperModel& model) {
  return model.feedback_step() == 0 && model.kind() != ModelKind::Family &&
         model.kind() != ModelKind::Mean && model.kind() != ModelKind::Other;
}

MeanModel::MeanModel(std::vector<Member> members, double offset, const std::string& where)
    : members_(std::move(members)), offset_(offset) {
  constexpr double kRounding = 1e-9;
  const std::string place = where.empty() ? name() : where;
  if (members_.size() < 2)
    throw Error(place, "has " + std::to_string(members_.size()) + " members", "two or more");
  double sum = 0;
  for (const Member& member : members_) {
    if (!may_be_member(*member.model))
      throw Error(place, "has the member " + member.model->name(),
                  "models of one damper, none of which feeds its force back or is a mean");
    if (!(member.weight > 0))
      throw Error(place, "has the weight " + format_number(member.weight), "weights above 0");
    sum += member.weight;
  }
  if (std::abs(sum - 1) > kRounding)
    throw Error(place, "has weights that add up to " + format_number(sum), "1");
}

std::string MeanModel::name() const { return std::string(mean_info().name); }

bool MeanModel::needs_displacement() const noexcept {
  return std::ranges::any_of(members_,
                             [](const Member& m) { return m.model->needs_displacement(); });
}

std::size_t MeanModel::parameter_count() const noexcept {
  std::size_t count = members_.size() - 1;  // weights
  for (const Member& member : members_) count += member.model->parameter_count();
  return count;
}

std::size_t MeanModel::state_size() const noexcept {
  std::size_t size = 0;
  for (const Member& member : members_) size += member.model->state_size();
  return size;
}

void MeanModel::rest(const DamperInput& input, std::span<double> state) const noexcept {
  for_each_part(members_, state, [&](const Member& member, std::span<double> own) {
    member.model->rest(input, own);
  });
}

void MeanModel::advance(const DamperInput& from, const DamperInput& to, double dt,
                        std::span<double> state) const noexcept {
  for_each_part(members_, state, [&](const Member& member, std::span<double> own) {
    member.model->advance(from, to, dt, own);
  });
}

double MeanModel::force(const DamperInput& input, std::span<const double> state) const noexcept {
  double force = offset_;
  for_each_part(members_, state, [&](const Member& member, std::span<const double> own) {
    force += member.weight * member.model->force(input, own);
  });
  return force;
}

bool MeanModel::flows() const noexcept {
  return std::ranges::all_of(members_, [](const Member& m) { return m.model->flows(); });
}

double MeanModel::flow(const DamperInput& input, std::span<const double> state,
                       std::span<double> rates) const noexcept {
  double force = offset_;
  for_each_part(members_, state, [&](const Member& member, std::span<const double> own) {
    force += member.weight * member.model->flow(input, own, rates.first(own.size()));
    rates = rates.subspan(own.size());
  });
  return force;
}

double MeanModel::spread(const DamperInput& input, std::span<const double> state) const noexcept {
  const double mean = force(input, state) - offset_;
  double square = 0;
  for_each_part(members_, state, [&](const Member& member, std::span<const double> own) {
    const double apart = member.model->force(input, own) - mean;
    const double within = member.model->spread(input, own);
    square += member.weight * (apart * apart + within * within);
  });
  return std::sqrt(square);
}

std::unique_ptr<DamperModel> MeanModel::with_offset(double newton) const {
  return std::make_unique<MeanModel>(members_, offset_ + newton);
}

Value MeanModel::to_json() const {
  Value members = Value::array();
  for (const Member& member : members_)
    members.push_back(Value::object({{"kind", name_of(member.model->kind())},
                                     {"weight", member.weight},
                                     {"model", member.model->to_json()}}));
  return Value::object({{"members", std::move(members)}, {"offset", offset_}});
}

std::unique_ptr<MeanModel> mean_model_from_json(
    const Value& value, std::unique_ptr<DamperModel> (*read)(ModelKind kind, const Value& value)) {
  ObjectReader reader(value, "a mean of models");
  std::vector<MeanModel::Member> members;
  for (const Value& item : reader.required("members").items()) {
    ObjectReader member(item, "a member of a mean");
    const Value& kind = member.required("kind");
    members.push_back(
        {read(parse_model_kind(kind.as_string(), kind.where()), member.required("model")),
         member.number("weight")});
    member.finish();
  }
  const double offset = reader.number("offset");
  reader.finish();
  return std::make_unique<MeanModel>(std::move(members), offset, value.where());
}

ModelInfo mean_info() {
  return {
      .name = "mean",
      .kind = ModelKind::Mean,
      .title = "Mean of the best models of a ranking",
      .equation = "F = sum_m w_m F_m,  w_m = (1 / E_m) / sum_k (1 / E_k),  of the best two to four",
      .source =
          "weights of independent errors: Bates and Granger, Operational Research "
          "Quarterly 20 (1969) 451",
      .remarks =
          "E: the squared error that each model leaves on records that its fit has not seen. "
          "Made by `rank` and `identify` of the models that they fit and may recommend, of as "
          "many as leave the least. Its force costs what theirs cost together. None of its members "
          "feeds its force back.",
      .inputs = {"velocity", "current"},
      .usual = false};
}

}  // namespace dashpot
