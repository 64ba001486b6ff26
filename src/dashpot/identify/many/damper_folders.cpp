#include "dashpot/identify/many/damper_folders.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string_view>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kStatement = "dataset.yaml";
constexpr std::string_view kDigits = "0123456789";

/// The last number in a name. Nothing where there is none, or one with more digits than a number
/// keeps.
std::optional<double> serial_of(const std::string& name) {
  constexpr std::size_t kMostDigits = 15;
  const std::string stem = fs::path(name).stem().string();
  const std::size_t last = stem.find_last_of(kDigits);
  if (last == std::string::npos) return std::nullopt;
  const std::size_t before = stem.find_last_not_of(kDigits, last);
  const std::size_t first = before == std::string::npos ? 0 : before + 1;
  if (last + 1 - first > kMostDigits) return std::nullopt;
  return parse_number(std::string_view(stem).substr(first, last + 1 - first));
}

/// The serial numbers of these names, where each has one of its own.
std::optional<std::vector<double>> serials_of(const std::vector<std::string>& names) {
  std::vector<double> serials;
  for (const std::string& name : names) {
    const std::optional<double> serial = serial_of(name);
    if (!serial) return std::nullopt;
    serials.push_back(*serial);
  }
  std::vector<double> sorted = serials;
  std::ranges::sort(sorted);
  if (std::ranges::adjacent_find(sorted) != sorted.end()) return std::nullopt;
  return serials;
}

}  // namespace

DamperFolders find_dampers(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw Error(folder.string(), "is no folder", "name the folder that holds the dampers");
  DamperFolders found{.folder = folder};

  // Subfolders, else files.
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.')) continue;
    if (entry.is_directory())
      found.names.push_back(name);
    else if (name == kStatement)
      found.statement = entry.path();
    else
      files.push_back(name);
  }
  (found.names.empty() ? found.names : found.passed_over) = std::move(files);
  if (found.names.empty())
    throw Error(folder.string(), "holds no damper",
                "give each damper a folder of its recordings there, or a file");
  std::ranges::sort(found.names);
  std::ranges::sort(found.passed_over);

  // In the order of the serial numbers.
  const std::optional<std::vector<double>> serials = serials_of(found.names);
  found.has_serials = serials.has_value();
  std::vector<std::size_t> order(found.names.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (serials) std::ranges::stable_sort(order, {}, [&](std::size_t k) { return (*serials)[k]; });
  std::vector<std::string> names;
  for (const std::size_t k : order) {
    found.serials.push_back(serials ? (*serials)[k] : static_cast<double>(names.size() + 1));
    names.push_back(std::move(found.names[k]));
  }
  found.names = std::move(names);
  return found;
}

fs::path DamperFolders::statement_of(std::size_t damper) const {
  return fs::exists(path_of(damper) / kStatement) ? fs::path() : statement;
}

std::string DamperFolders::content_of(std::size_t damper) const {
  const fs::path path = path_of(damper);
  std::vector<fs::path> files;
  if (fs::is_directory(path)) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path))
      if (entry.is_regular_file()) files.push_back(entry.path());
    std::ranges::sort(files);
  } else {
    files.push_back(path);
  }

  std::string text;
  for (const fs::path& file : files)
    text += file.lexically_relative(folder).string() + '\n' + sha256_of_file(file) + '\n';
  if (const fs::path stated = statement_of(damper); !stated.empty()) text += sha256_of_file(stated);
  return sha256(text);
}

}  // namespace dashpot
