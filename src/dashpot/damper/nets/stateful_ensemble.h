#pragma once
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "dashpot/damper_model.h"
#include "dashpot/error.h"
#include "dashpot/value.h"

namespace dashpot {

/// A model from motion and current to force through states of its own: the mean of a few members.
/// Immutable; the caller's state holds the members' states one after the other.
///
/// A Member has states(), with rest, advance, flow and size as HysteresisBank has them,
/// force(input, state), parameter_count(), to_json() and require_sound(where).
template <class Member>
class StatefulEnsemble : public DamperModel {
 public:
  std::string name() const override { return name_; }
  bool needs_displacement() const noexcept override { return false; }
  std::size_t parameter_count() const noexcept override {
    std::size_t count = 0;
    for (const Member& member : members_) count += member.parameter_count();
    return count;
  }
  std::size_t state_size() const noexcept override { return state_size_; }

  void rest(const DamperInput& input, std::span<double> state) const noexcept override {
    for (const Member& member : members_) member.states().rest(input, own(member, state));
  }
  void advance(const DamperInput& from, const DamperInput& to, double dt,
               std::span<double> state) const noexcept override {
    for (const Member& member : members_) member.states().advance(from, to, dt, own(member, state));
  }
  double force(const DamperInput& input, std::span<const double> state) const noexcept override {
    double sum = 0;
    for (const Member& member : members_) sum += member.force(input, own(member, state));
    return sum / static_cast<double>(members_.size()) + offset_;
  }
  bool flows() const noexcept override { return true; }
  double flow(const DamperInput& input, std::span<const double> state,
              std::span<double> rates) const noexcept override {
    std::span<const double> now = state;
    for (const Member& member : members_) {
      const auto part = own(member, now);
      member.states().flow(input, part, own(member, rates));
    }
    return force(input, state);
  }
  bool is_ensemble() const noexcept override { return members_.size() > 1; }
  double spread(const DamperInput& input, std::span<const double> state) const noexcept override {
    if (!is_ensemble()) return 0;
    const double mean = force(input, state) - offset_;
    double squares = 0;
    for (const Member& member : members_) {
      const double apart = member.force(input, own(member, state)) - mean;
      squares += apart * apart;
    }
    return std::sqrt(squares / static_cast<double>(members_.size() - 1));
  }

  Value to_json() const override {
    Value members = Value::array();
    for (const Member& member : members_) members.push_back(member.to_json());
    return Value::object({{"name", name_}, {"members", std::move(members)}, {"offset", offset_}});
  }

  const std::vector<Member>& members() const { return members_; }
  double offset() const { return offset_; }

 protected:
  /// Throws Error, beginning with `where` (the name when empty), when a member's parts do not fit
  /// together: Member::require_sound says so.
  StatefulEnsemble(std::string name, std::vector<Member> members, double offset,
                   const std::string& where)
      : name_(std::move(name)), members_(std::move(members)), offset_(offset) {
    const std::string& place = where.empty() ? name_ : where;
    if (members_.empty())
      throw Error(place, "has no members", "states and the network that reads them");
    for (const Member& member : members_) {
      member.require_sound(place);
      state_size_ += member.states().size();
    }
  }

 private:
  /// A member's part of the state; the rest stays in `state`.
  template <class Number>
  static std::span<Number> own(const Member& member, std::span<Number>& state) {
    const std::span<Number> part = state.first(member.states().size());
    state = state.subspan(part.size());
    return part;
  }

  std::string name_;
  std::vector<Member> members_;
  double offset_;
  std::size_t state_size_ = 0;
};

/// A range that a member has seen, in files: [low, high].
inline Value range_value(double low, double high) {
  return Value::array(std::vector<double>{low, high});
}
inline void read_range(ObjectReader& reader, const char* key, double& low, double& high) {
  const std::vector<double> ends = reader.required(key).as_numbers();
  if (ends.size() != 2) throw Error(reader.required(key).where(), "is not a range", "two numbers");
  low = ends[0];
  high = ends[1];
}

/// Reads what to_json() wrote; `what` names the model in errors. Throws Error.
template <class Model, class ReadMember>
std::unique_ptr<Model> stateful_ensemble_from_json(const Value& value, const char* what,
                                                   ReadMember read_member) {
  ObjectReader reader(value, what);
  std::string name = reader.string("name");
  std::vector<decltype(read_member(value))> members;
  for (const Value& item : reader.required("members").items()) members.push_back(read_member(item));
  const double offset = reader.number("offset");
  reader.finish();
  return std::make_unique<Model>(std::move(name), std::move(members), offset, value.where());
}

}  // namespace dashpot
