#include <algorithm>
#include <unordered_set>

#include <yaml-cpp/yaml.h>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/value.h"

// The only file that includes the YAML library.
namespace dashpot {
namespace {

constexpr int kDeepestYaml = 50, kMostYamlEntries = 100000;

std::string place(const std::string& source, const YAML::Mark& mark) {
  return mark.is_null() ? source : source + ":" + std::to_string(mark.line + 1);
}

[[noreturn]] void refuse_size(const std::string& source) {
  throw Error(source, "has more than " + std::to_string(kMostYamlEntries) + " entries");
}

Value placed(Value value, std::string where) {
  value.set_place(std::make_shared<Value::Place>(Value::Place{.name = std::move(where)}));
  return value;
}

/// YAML 1.2 core schema for what was written without quotes.
Value from_scalar(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  if (node.Tag() == "!") return Value(text);  // quoted
  if (text == "true" || text == "True") return Value(true);
  if (text == "false" || text == "False") return Value(false);
  if (text == "null" || text == "~" || text.empty()) return Value();
  if (const auto number = parse_number(text)) return Value(*number);
  return Value(text);
}

Value from_yaml(const YAML::Node& node, const std::string& source, int depth, int& budget) {
  // An alias is expanded wherever it stands: without a bound, a short text could fill the memory.
  if (--budget < 0) refuse_size(source);
  if (depth > kDeepestYaml)
    throw Error(place(source, node.Mark()),
                "is nested more than " + std::to_string(kDeepestYaml) + " levels deep");
  Value value;
  if (node.IsScalar()) {
    value = from_scalar(node);
  } else if (node.IsSequence()) {
    value = Value::array();
    for (const YAML::Node& item : node) value.push_back(from_yaml(item, source, depth + 1, budget));
  } else if (node.IsMap()) {
    value = Value::object();
    std::unordered_set<std::string> keys;
    for (const auto& member : node) {
      if (!member.first.IsScalar())
        throw Error(place(source, member.first.Mark()), "a key must be plain text");
      const std::string& key = member.first.Scalar();
      if (!keys.insert(key).second)
        throw Error(place(source, member.first.Mark()), "the key '" + key + "' stands twice");
      value.add(key, placed(from_yaml(member.second, source, depth + 1, budget),
                            place(source, member.first.Mark())));
    }
  }
  return placed(std::move(value), place(source, node.Mark()));
}

/// Refuses, before a tree is made that takes a hundred times its room, a text with many times the
/// signs that so many entries need.
void require_yaml_within_budget(std::string_view text, const std::string& source) {
  constexpr std::ptrdiff_t kSignsPerEntry = 5;
  const auto separates = [](char c) {
    return std::string_view(",[{:\n").find(c) != std::string_view::npos;
  };
  if (std::ranges::count_if(text, separates) > kSignsPerEntry * kMostYamlEntries)
    refuse_size(source);
}

}  // namespace

Value parse_yaml(std::string_view text, const std::string& source) {
  require_yaml_within_budget(text, source);
  try {
    const YAML::Node root = YAML::Load(std::string(text));
    int budget = kMostYamlEntries;
    return from_yaml(root, source, 0, budget);
  } catch (const YAML::Exception& error) {
    throw Error(place(source, error.mark), "is not valid YAML: " + error.msg);
  }
}

}  // namespace dashpot
