#include "dashpot/damper/kinds/passive_hybrid/passive_hybrid_model.h"

#include <utility>

#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/passive_hybrid/presets.h"
#include "dashpot/error.h"

namespace dashpot {

PassiveHybridModel::PassiveHybridModel(LawModel law, PassiveNetworkModel network,
                                       double network_share, double offset,
                                       const std::string& where)
    : law_(std::move(law)),
      network_(std::move(network)),
      network_share_(network_share),
      offset_(offset) {
  const std::string place = where.empty() ? name() : where;
  if (!is_law_of_passive_hybrids(law_.law().name))
    throw Error(place,
                "has the law " + law_.name() + ", which may feed energy in within its bounds",
                "one that dissipates wherever they hold: bingham, dahl, bouc_wen ...");
  if (!(network_share_ >= 0 && network_share_ <= 1))
    throw Error(place, "the network's share is " + format_number(network_share_),
                "0 to 1, the rest is the law's: one of a negative share would generate energy");
}

std::string PassiveHybridModel::name() const { return passive_hybrid_name(law_.law().name); }

bool PassiveHybridModel::needs_displacement() const noexcept {
  return law_.needs_displacement() || network_.needs_displacement();
}

std::size_t PassiveHybridModel::parameter_count() const noexcept {
  return law_.parameter_count() + network_.parameter_count() + 1;
}

std::size_t PassiveHybridModel::state_size() const noexcept {
  return law_.state_size() + network_.state_size();
}

void PassiveHybridModel::rest(const DamperInput& input, std::span<double> state) const noexcept {
  law_.rest(input, state.first(law_.state_size()));
  network_.rest(input, state.subspan(law_.state_size()));
}

void PassiveHybridModel::advance(const DamperInput& from, const DamperInput& to, double dt,
                                 std::span<double> state) const noexcept {
  law_.advance(from, to, dt, state.first(law_.state_size()));
  network_.advance(from, to, dt, state.subspan(law_.state_size()));
}

double PassiveHybridModel::force(const DamperInput& input,
                                 std::span<const double> state) const noexcept {
  const double of_law = law_.force(input, state.first(law_.state_size()));
  const double of_network = network_.force(input, state.subspan(law_.state_size()));
  return law_share() * of_law + network_share_ * of_network + offset_;
}

double PassiveHybridModel::flow(const DamperInput& input, std::span<const double> state,
                                std::span<double> rates) const noexcept {
  const std::size_t of_law = law_.state_size();
  law_.flow(input, state.first(of_law), rates.first(of_law));
  network_.flow(input, state.subspan(of_law), rates.subspan(of_law));
  return force(input, state);
}

double PassiveHybridModel::spread(const DamperInput& input,
                                  std::span<const double> state) const noexcept {
  return network_share_ * network_.spread(input, state.subspan(law_.state_size()));
}

std::unique_ptr<DamperModel> PassiveHybridModel::with_offset(double newton) const {
  return std::make_unique<PassiveHybridModel>(law_, network_, network_share_, offset_ + newton);
}

Value PassiveHybridModel::to_json() const {
  return Value::object({{"law", law_.to_json()},
                        {"network", network_.to_json()},
                        {"network_share", network_share_},
                        {"offset", offset_}});
}

std::unique_ptr<PassiveHybridModel> passive_hybrid_model_from_json(const Value& value) {
  ObjectReader reader(value, "a passive hybrid model");
  const std::unique_ptr<LawModel> law = law_model_from_json(reader.required("law"));
  const auto network = passive_network_model_from_json(reader.required("network"));
  const double network_share = reader.number("network_share");
  const double offset = reader.number("offset");
  reader.finish();
  return std::make_unique<PassiveHybridModel>(*law, *network, network_share, offset, value.where());
}

}  // namespace dashpot
