#include "dashpot/base/merge_stores.h"

#include <map>
#include <memory>
#include <optional>

#include "dashpot/error.h"
#include "dashpot/value.h"

namespace dashpot {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kAtOnce = 1000;  // results in one transaction

std::string shortened(const std::string& text) {
  constexpr std::size_t kMost = 60;
  return text.size() <= kMost ? text : text.substr(0, kMost) + "...";
}

/// Where two values differ, and both: "parameters[2] is 1.5 and 1.6".
std::string first_difference(const Value& a, const Value& b, const std::string& where) {
  const auto named = [&](const std::string& name) {
    return where.empty() ? name : where + '.' + name;
  };

  // Members of the one, then those that only the other has. The time that a task took may differ.
  if (a.kind() == Value::Kind::Object && b.kind() == Value::Kind::Object) {
    for (const auto& [name, value] : a.members()) {
      if (where.empty() && name == "seconds") continue;
      const Value* other = b.find(name);
      if (!other) return named(name) + " is in the first alone";
      if (std::string found = first_difference(value, *other, named(name)); !found.empty())
        return found;
    }
    for (const auto& [name, value] : b.members())
      if (!a.find(name)) return named(name) + " is in the second alone";
    return {};
  }

  if (a.kind() == Value::Kind::Array && b.kind() == Value::Kind::Array &&
      a.items().size() == b.items().size()) {
    for (std::size_t k = 0; k < a.items().size(); ++k)
      if (std::string found =
              first_difference(a.items()[k], b.items()[k], where + '[' + std::to_string(k) + ']');
          !found.empty())
        return found;
    return {};
  }

  const std::string left = format_json(a, false), right = format_json(b, false);
  return left == right ? "" : where + " is " + shortened(left) + " and " + shortened(right);
}

}  // namespace

std::string json_difference(std::string_view a, std::string_view b) {
  if (a == b) return {};
  try {
    return first_difference(parse_json(std::string(a), "the first"),
                            parse_json(std::string(b), "the second"), "");
  } catch (const Error& error) {
    return error.what();
  }
}

MergeReport merge_stores(const std::vector<fs::path>& sources, const fs::path& target,
                         const StoreFormat& format, const StoreDifference& difference) {
  // What was joined before is a store like the others.
  std::vector<fs::path> stores = sources;
  if (fs::exists(target)) stores.insert(stores.begin(), target);
  const NamedTexts basis = store_mark(stores.front()).basis;

  // A fresh file beside it takes them all, and its name in the end.
  const fs::path joined = target.string() + ".joining";
  Store::remove(joined);
  MergeReport report;
  try {
    Store store(joined, format, basis);
    std::map<std::string, std::string, std::less<>> pending;  // not yet in the store
    const auto flush = [&] {
      std::vector<Store::Result> results;
      for (auto& [key, bytes] : pending) results.push_back({key, std::move(bytes)});
      store.save(results);
      pending.clear();
    };

    std::vector<fs::path> before;
    // The store that a result came from, found only where two differ.
    const auto origin = [&](const std::string& key) {
      for (const fs::path& path : before)
        if (Store(path, format, basis).load(key)) return path.string();
      return joined.string();
    };
    for (const fs::path& path : stores) {
      const Store source(path, format, basis);
      report.dropped += source.dropped();
      source.for_each([&](std::string_view key, std::string_view bytes) {
        const std::string name(key);
        if (const std::optional<std::string> there = store.load(name)) {
          ++report.repeated;
          if (const std::string differs = difference(*there, bytes); !differs.empty())
            throw Error(
                path.string(),
                "disagrees with " + origin(name) + " on '" + name + "': there and here " + differs,
                "find out which is right, and leave the other out");
          return;
        }
        pending.emplace(name, bytes);
        if (pending.size() >= kAtOnce) flush();
      });
      flush();
      before.push_back(path);
    }
    report.results = store.size();
  } catch (...) {
    Store::remove(joined);
    throw;
  }
  fs::rename(joined, target);
  return report;
}

}  // namespace dashpot
