#include "dashpot/damper/law_list.h"

#include <algorithm>
#include <array>

namespace dashpot {

// Every law once, in alphabetical order: the names under which their tables are defined.
#define DASHPOT_LAWS         \
  LAW(kArctan)               \
  LAW(kBingham)              \
  LAW(kBiviscous)            \
  LAW(kBoucWen)              \
  LAW(kChebyshev)            \
  LAW(kCompressibleChambers) \
  LAW(kDahl)                 \
  LAW(kElastoplastic)        \
  LAW(kExtendedBingham)      \
  LAW(kFieldChain)           \
  LAW(kHystereticBiviscous)  \
  LAW(kLandauSurrogate)      \
  LAW(kLargeScaleBoucWen)    \
  LAW(kLookupMap)            \
  LAW(kModifiedBoucWen)      \
  LAW(kModifiedLugre)        \
  LAW(kNormalisedBoucWen)    \
  LAW(kPlateBingham)         \
  LAW(kPlateBinghamMixed)    \
  LAW(kPlateBinghamShear)    \
  LAW(kPlateHerschelBulkley) \
  LAW(kPolynomial)           \
  LAW(kSemiPhenomenological) \
  LAW(kSigmoid)              \
  LAW(kTanhAcceleration)     \
  LAW(kTanhGuo)              \
  LAW(kTanhKwok)             \
  LAW(kViscousDahl)

#define LAW(name) extern const Law name;
DASHPOT_LAWS
#undef LAW

namespace {

#define LAW(name) &name,
constexpr std::array kLaws{DASHPOT_LAWS};
#undef LAW

const Law* law_named(std::string_view name) {
  const auto found = std::ranges::find(kLaws, name, &Law::name);
  return found == kLaws.end() ? nullptr : *found;
}

}  // namespace

std::span<const Law* const> laws() { return kLaws; }

const Law& find_law(std::string_view name, const std::string& where) {
  if (const Law* law = law_named(name)) return *law;
  std::vector<std::string> known;
  for (const Law* law : laws()) known.emplace_back(law->name);
  throw_unknown_model(name, where, known);
}

bool is_law(std::string_view name) { return law_named(name) != nullptr; }

ModelInfo info_of(const Law& law) {
  ModelInfo info{law.name, ModelKind::Law, law.title, law.equation, law.source, law.remarks};
  info.inputs = {"velocity", "current"};
  if (law.needs_displacement) info.inputs.insert(info.inputs.begin(), "displacement");
  info.law = &law;
  return info;
}

}  // namespace dashpot
