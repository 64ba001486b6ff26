#include "dashpot/damper/kinds/narx/narx_model.h"

#include <algorithm>
#include <cmath>

#include "dashpot/damper/kinds/network/network_model.h"
#include "dashpot/damper/nets/mlp_json.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr double kSlack = 1e-6;  // of a step of the grid: what sums of time steps may miss it by
constexpr double kMostSteps =
    10000;  // of the grid in one advance; nothing remembers what lay before
constexpr std::size_t kRestSteps = 300;  // at most, for the forces to settle

/// Between an older and a newer value; exact at both ends.
double between(double older, double newer, double share) noexcept {
  if (share == 0) return older;
  return share == 1 ? newer : older + share * (newer - older);
}

DamperInput between(const DamperInput& from, const DamperInput& to, double share) noexcept {
  return {between(from.displacement, to.displacement, share),
          between(from.velocity, to.velocity, share), between(from.current, to.current, share)};
}

void push(double value, std::span<double> history) noexcept {
  std::copy_backward(history.begin(), history.end() - 1, history.end());
  history.front() = value;
}

}  // namespace

NarxModel::NarxModel(std::string name, Regressors regressors, std::vector<Mlp> members,
                     double offset, const std::string& where)
    : name_(std::move(name)),
      regressors_(std::move(regressors)),
      members_(std::move(members)),
      offset_(offset),
      force_size_(regressors_.feedback_depth() + 1),
      needs_displacement_(regressors_.needs_displacement()) {
  // Check that the parts fit together.
  const std::string& place = where.empty() ? name_ : where;
  require_usable(regressors_, place);
  if (members_.empty()) throw Error(place, "has no members", "a network at least");
  for (const Mlp& member : members_) {
    require_shape(member, regressors_.count(), place);
    evaluators_.emplace_back(member);
  }

  // Lay out the state: the past of each input, then that of the forces.
  for (const Regressors::Input& input : regressors_.inputs) {
    inputs_.push_back({input_field(input.name, place), &input.lags, forces_at_, input.depth() + 1});
    forces_at_ += inputs_.back().size;
  }
}

std::size_t NarxModel::parameter_count() const noexcept {
  std::size_t count = 0;
  for (const Mlp& member : members_) count += member.parameters.size();
  return count;
}

std::size_t NarxModel::force_place(std::size_t member) const noexcept {
  return forces_at_ + member * force_size_;
}

std::size_t NarxModel::state_size() const noexcept { return force_place(members_.size()); }

void NarxModel::rest(const DamperInput& input, std::span<double> state) const noexcept {
  const DamperInput still{input.displacement, 0, input.current};
  std::fill(state.begin(), state.end(), 0.0);
  for (const Past& past : inputs_) std::fill_n(&state[past.first], past.size, still.*past.field);
  for (std::size_t m = 0; m < members_.size(); ++m)
    std::fill_n(&state[force_place(m)], force_size_, members_[m].output_mean);
  for (std::size_t k = 0; k < kRestSteps; ++k) tick(still, state);
}

void NarxModel::advance(const DamperInput& from, const DamperInput& to, double dt,
                        std::span<double> state) const noexcept {
  if (!(dt > 0) || !std::isfinite(dt)) return;
  const double step = regressors_.sample_time;
  double pending = state[kPending], done = 0;
  if (dt > kMostSteps * step) {
    done = dt - kMostSteps * step;
    pending = 0;
  }

  // Tick at every instant of the grid that the step passes.
  while (pending + (dt - done) >= step * (1 - kSlack)) {
    done += step - pending;
    tick(std::abs(dt - done) <= kSlack * step ? to : between(from, to, done / dt), state);
    pending = 0;
  }
  pending += dt - done;
  state[kPending] = pending > kSlack * step ? pending : 0;
}

/// At an instant `share` of a step after the last one of the grid, at which the input is `input`.
double NarxModel::evaluate(std::size_t member, const DamperInput& input, double share,
                           std::span<const double> state) const noexcept {
  std::array<double, Mlp::kMaxWidth> raw;
  double* to = raw.data();
  for (const Past& past : inputs_)
    for (const std::size_t lag : *past.lags) {
      const double* at = &state[past.first + lag];
      *to++ = lag == 0 ? input.*past.field : between(*at, at[-1], share);
    }
  for (const std::size_t lag : regressors_.feedback) {
    const double* at = &state[force_place(member) + lag];
    *to++ = between(*at, at[-1], share);
  }
  return evaluators_[member].evaluate(raw.data());
}

double NarxModel::held(std::size_t member, double force, double last) const noexcept {
  if (std::isnan(force)) return last;
  if (regressors_.feedback.empty()) return force;
  const double reach = kRange * members_[member].output_scale, mean = members_[member].output_mean;
  return std::clamp(force, mean - reach, mean + reach);
}

void NarxModel::tick(const DamperInput& input, std::span<double> state) const noexcept {
  if (has_diverged(state)) return;
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const std::span<double> forces = state.subspan(force_place(m), force_size_);
    const double force = evaluate(m, input, 1, state), kept = held(m, force, forces.front());
    if (kept != force && !regressors_.feedback.empty()) state[kDiverged] = 1;
    push(kept, forces);
  }
  for (const Past& past : inputs_) push(input.*past.field, state.subspan(past.first, past.size));
}

bool NarxModel::is_now(const DamperInput& input, std::span<const double> state) const noexcept {
  return state[kPending] == 0 && std::all_of(inputs_.begin(), inputs_.end(), [&](const Past& past) {
           return state[past.first] == input.*past.field;
         });
}

double NarxModel::force(const DamperInput& input, std::span<const double> state) const noexcept {
  const bool known = has_diverged(state) || is_now(input, state);
  double sum = 0;
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const double last = state[force_place(m)];
    const double share = state[kPending] / regressors_.sample_time;
    sum += known ? last : held(m, evaluate(m, input, share, state), last);
  }
  return sum / static_cast<double>(members_.size()) + offset_;
}

bool NarxModel::can_diverge() const {
  if (regressors_.feedback.empty()) return false;
  return std::any_of(members_.begin(), members_.end(), [](const Mlp& mlp) {
    const std::size_t last = mlp.layers.size() - 1, neurons = mlp.layers[last - 1];
    const auto is_bounded = [&](std::size_t layer) {
      const Activation kind = mlp.activation(layer);
      return kind == Activation::Tanh || kind == Activation::Sigmoid;
    };
    if (is_bounded(last)) return false;
    if (last == 1 || !is_bounded(last - 1)) return true;

    // Bounded neurons hold the force as far as the weights behind them reach.
    double most = 0;  // neurons at 1 or -1, each as its weight wants it
    for (auto weight = mlp.parameters.end() - static_cast<std::ptrdiff_t>(neurons + 1);
         weight != mlp.parameters.end(); ++weight)
      most += std::abs(*weight);
    return most > kRange;
  });
}

void NarxModel::observe(double force, std::span<double> state) const noexcept {
  if (state[kPending] != 0) return;
  for (std::size_t m = 0; m < members_.size(); ++m) state[force_place(m)] = force - offset_;
}

std::unique_ptr<DamperModel> NarxModel::with_offset(double newton) const {
  return std::make_unique<NarxModel>(name_, regressors_, members_, offset_ + newton);
}

Value NarxModel::to_json() const {
  Value members = Value::array();
  for (const Mlp& mlp : members_) {
    Value member = Value::object();
    add_mlp(member, mlp);
    members.push_back(std::move(member));
  }
  return Value::object({{"name", name_},
                        {"regressors", dashpot::to_json(regressors_)},
                        {"members", std::move(members)},
                        {"offset", offset_}});
}

std::unique_ptr<NarxModel> narx_model_from_json(const Value& value) {
  ObjectReader reader(value, "a NARX model");
  std::string name = reader.string("name");
  Regressors regressors = read_regressors(reader.required("regressors"));
  std::vector<Mlp> members;
  for (const Value& item : reader.required("members").items()) {
    ObjectReader member(item, "a member");
    members.push_back(read_mlp(member));
    member.finish();
  }
  const double offset = reader.number("offset");
  reader.finish();
  return std::make_unique<NarxModel>(std::move(name), std::move(regressors), std::move(members),
                                     offset, value.where());
}

}  // namespace dashpot
