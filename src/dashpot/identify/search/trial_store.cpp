#include "dashpot/identify/search/trial_store.h"

#include <algorithm>
#include <utility>

#include "dashpot/base/any_number.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/value.h"

namespace dashpot {
namespace {

constexpr std::pair<const char*, double ErrorSums::*> kSums[] = {
    {"squared", &ErrorSums::squared},
    {"absolute", &ErrorSums::absolute},
    {"largest", &ErrorSums::largest},
    {"force", &ErrorSums::force},
    {"force_squared", &ErrorSums::force_squared},
    {"error", &ErrorSums::error},
    {"force_min", &ErrorSums::force_min},
    {"force_max", &ErrorSums::force_max}};

std::string text_of(const TrialStore::Key& key) {
  return key.design + ' ' + format_exact(key.share) + ' ' + std::to_string(key.fold);
}

std::string format_result(const FoldResult& result) {
  Value value = Value::object({{"failure", result.failure},
                               {"parameters", result.parameters},
                               {"samples", result.sums.n},
                               {"diverged", result.diverged},
                               {"worst_esr", any_number(result.worst_esr)},
                               {"seconds", result.seconds}});
  for (const auto& [name, sum] : kSums) value.add(name, any_number(result.sums.*sum));
  return format_json(value, false);
}

std::size_t read_count(ObjectReader& reader, std::string_view key) {
  return static_cast<std::size_t>(std::clamp(reader.number(key), 0.0, 1e15));
}

/// Throws Error, naming the key, when the text is not the result of a fold.
FoldResult parse_result(const std::string& text, const std::string& key) {
  const Value value = parse_json(text, key);
  ObjectReader reader(value, "a kept result");
  FoldResult result;
  result.failure = reader.string("failure");
  result.parameters = read_count(reader, "parameters");
  result.sums.n = read_count(reader, "samples");
  result.diverged = read_count(reader, "diverged");
  result.worst_esr = read_any_number(reader.required("worst_esr"));
  result.seconds = reader.number("seconds");
  for (const auto& [name, sum] : kSums) result.sums.*sum = read_any_number(reader.required(name));
  reader.finish();
  return result;
}

}  // namespace

TrialStore::TrialStore(const std::filesystem::path& path, const NamedTexts& search)
    : store_(path, kFormat, search) {}

std::optional<FoldResult> TrialStore::load(const Key& key) const {
  const std::string name = text_of(key);
  const std::optional<std::string> bytes = store_.load(name);
  if (!bytes) return std::nullopt;

  // A damaged result is as good as none: the caller makes it again and saves it in this one's
  // place.
  try {
    return parse_result(*bytes, name);
  } catch (const Error&) {
    return std::nullopt;
  }
}

void TrialStore::save(const Key& key, const FoldResult& result) {
  store_.save(text_of(key), format_result(result));
}

}  // namespace dashpot
