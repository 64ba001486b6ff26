// Layer: damper
#pragma once

// The kinds of models, and the rule that holds every layer's table of kinds complete.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace dashpot {

/// The kinds of models, in the order in which lists show them. A kind has one name everywhere: its
/// folder in damper/kinds/, its file in identify/fit/ and in export/c/, its word in model files.
enum class ModelKind {
  Law,
  Network,
  Narx,
  HysteresisNetwork,
  StateSpace,
  PassiveNetwork,
  Fuzzy,
  Hybrid,
  PassiveHybrid,
  Family,
  Mean,
  Other  ///< stands last, behind the kinds that model files have: a passive curve, for example
};
constexpr std::size_t kModelKinds = static_cast<std::size_t>(ModelKind::Other);

/// The name of a kind in model files and in lists.
struct ModelKindName {
  ModelKind kind;
  std::string_view name;
  std::string_view former = {};  ///< in files of earlier versions, which are still read
};
inline constexpr std::array kModelKindNames{
    ModelKindName{ModelKind::Law, "law"},
    ModelKindName{ModelKind::Network, "network"},
    ModelKindName{ModelKind::Narx, "narx"},
    ModelKindName{ModelKind::HysteresisNetwork, "hysteresis_network", "state_network"},
    ModelKindName{ModelKind::StateSpace, "state_space"},
    ModelKindName{ModelKind::PassiveNetwork, "passive_network"},
    ModelKindName{ModelKind::Fuzzy, "fuzzy"},
    ModelKindName{ModelKind::Hybrid, "hybrid"},
    ModelKindName{ModelKind::PassiveHybrid, "passive_hybrid"},
    ModelKindName{ModelKind::Family, "family"},
    ModelKindName{ModelKind::Mean, "mean"},
};

namespace detail {
template <const auto& kTable, ModelKind kKind>
struct RowOfKind {
  static constexpr auto kPlace = static_cast<std::size_t>(kKind);
  static constexpr bool kStands = kPlace < kTable.size() && kTable[kPlace].kind == kKind;
  static_assert(kStands, "the table has no row for this kind of model where ModelKind has it");
};

template <const auto& kTable, std::size_t... kPlaces>
constexpr bool has_rows(std::index_sequence<kPlaces...>) {
  return (RowOfKind<kTable, static_cast<ModelKind>(kPlaces)>::kStands && ...) &&
         kTable.size() == sizeof...(kPlaces);
}
}  // namespace detail

/// The row of a kind, which must not be Other, in a layer's table: an array with one row per kind,
/// each with a `kind`, in the order of ModelKind. A table that lacks a row does not compile, and
/// the message names the table and the kind.
template <const auto& kTable>
constexpr const auto& row_of(ModelKind kind) {
  static_assert(detail::has_rows<kTable>(std::make_index_sequence<kModelKinds>{}),
                "the table has not one row for every kind of model");
  return kTable[static_cast<std::size_t>(kind)];
}

/// The name of a kind in model files and lists: "law", "state_space".
std::string_view name_of(ModelKind kind);

/// The kind of that name, or of the name that earlier versions wrote. Throws Error(where, "unknown
/// kind ...") which says what is known.
ModelKind parse_model_kind(std::string_view name, const std::string& where);

}  // namespace dashpot
