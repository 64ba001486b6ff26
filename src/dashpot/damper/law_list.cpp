#include "dashpot/damper/law_list.h"

#include <algorithm>
#include <array>
#include <deque>
#include <memory>
#include <mutex>

#include "dashpot/damper/kinds/law/law_text.h"
#include "dashpot/error.h"

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

const Law* own_law(std::string_view name) {
  const auto found = std::ranges::find(kLaws, name, &Law::name);
  return found == kLaws.end() ? nullptr : *found;
}

/// A law that was read from a file.
struct FileLaw {
  std::shared_ptr<const LawText> text;
  ModelInfo info;
};

std::mutex guard;
std::deque<FileLaw> file_laws;  // the latest first; they stay where they are

const Law* law_named(std::string_view name) {
  if (const Law* law = own_law(name)) return law;
  const ModelInfo* info = file_law_info(name);
  return info ? info->law : nullptr;
}

}  // namespace

std::span<const Law* const> laws() { return kLaws; }

const Law& find_law(std::string_view name, const std::string& where) {
  if (const Law* law = law_named(name)) return *law;
  std::vector<std::string> known;
  for (const Law* law : laws()) known.emplace_back(law->name);
  for (const std::string& law : laws_of_files()) known.push_back(law);
  throw_unknown_model(name, where, known);
}

bool is_own_law(std::string_view name) { return own_law(name) != nullptr; }

bool is_law(std::string_view name) { return law_named(name) != nullptr; }

const Law& know_law(const std::filesystem::path& file) {
  const std::shared_ptr<const LawText> text = load_law_text(file);
  if (own_law(text->law().name))
    throw Error(file.string(), "'" + std::string(text->law().name) + "' is a law of Dashpot's own",
                "give the law another name");

  // The same text again is the same law.
  const std::lock_guard lock(guard);
  const auto is_same = [&](const FileLaw& known) {
    return format_json(known.text->definition()) == format_json(text->definition());
  };
  const auto found = std::ranges::find_if(file_laws, is_same);
  if (found != file_laws.end()) return found->text->law();
  file_laws.push_front({text, info_of(text->law())});
  return text->law();
}

std::vector<std::string> laws_of_files() {
  const std::lock_guard lock(guard);
  std::vector<std::string> names;
  for (const FileLaw& law : file_laws)
    if (std::ranges::find(names, law.info.name) == names.end()) names.emplace_back(law.info.name);
  return names;
}

const ModelInfo* file_law_info(std::string_view name) {
  const std::lock_guard lock(guard);
  const auto found =
      std::ranges::find(file_laws, name, [](const FileLaw& law) { return law.info.name; });
  return found == file_laws.end() ? nullptr : &found->info;
}

ModelInfo info_of(const Law& law) {
  ModelInfo info{law.name, ModelKind::Law, law.title, law.equation, law.source, law.remarks};
  info.inputs = {"velocity", "current"};
  if (law.needs_displacement) info.inputs.insert(info.inputs.begin(), "displacement");
  info.law = &law;
  return info;
}

}  // namespace dashpot
