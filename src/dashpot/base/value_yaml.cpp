#include <yaml-cpp/yaml.h>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/value.h"

// The only file that includes the YAML library.
namespace dashpot {
namespace {

std::string place(const std::string& source, const YAML::Mark& mark) {
  return mark.is_null() ? source : source + ":" + std::to_string(mark.line + 1);
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
  if (--budget < 0) throw Error(source, "has more than 100000 entries");
  if (depth > 50) throw Error(place(source, node.Mark()), "is nested more than 50 levels deep");
  Value value;
  if (node.IsScalar()) {
    value = from_scalar(node);
  } else if (node.IsSequence()) {
    value = Value::array();
    for (const YAML::Node& item : node) value.push_back(from_yaml(item, source, depth + 1, budget));
  } else if (node.IsMap()) {
    value = Value::object();
    for (const auto& member : node) {
      if (!member.first.IsScalar())
        throw Error(place(source, member.first.Mark()), "a key must be plain text");
      const std::string& key = member.first.Scalar();
      if (value.find(key))
        throw Error(place(source, member.first.Mark()), "the key '" + key + "' stands twice");
      Value item = from_yaml(member.second, source, depth + 1, budget);
      item.set_where(place(source, member.first.Mark()));
      value.add(key, std::move(item));
    }
  }
  value.set_where(place(source, node.Mark()));
  return value;
}

}  // namespace

Value parse_yaml(std::string_view text, const std::string& source) {
  try {
    const YAML::Node root = YAML::Load(std::string(text));
    int budget = 100000;
    return from_yaml(root, source, 0, budget);
  } catch (const YAML::Exception& error) {
    throw Error(place(source, error.mark), "is not valid YAML: " + error.msg);
  }
}

}  // namespace dashpot
