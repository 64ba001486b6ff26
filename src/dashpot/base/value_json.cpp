#include <cmath>

#include <nlohmann/json.hpp>

#include "dashpot/error.h"
#include "dashpot/value.h"

// The only file that includes the JSON library.
namespace dashpot {
namespace {

using Json = nlohmann::ordered_json;

std::string place(const std::string& source, const std::string& path) {
  return path.empty() ? source : source + ", " + path;
}

Value from_json(const Json& json, const std::string& source, const std::string& path) {
  Value value;
  if (json.is_boolean()) {
    value = Value(json.get<bool>());
  } else if (json.is_number()) {
    value = Value(json.get<double>());
  } else if (json.is_string()) {
    value = Value(json.get<std::string>());
  } else if (json.is_array()) {
    std::vector<Value> items;
    for (const Json& item : json)
      items.push_back(from_json(item, source, path + "[" + std::to_string(items.size()) + "]"));
    value = Value::array(std::move(items));
  } else if (json.is_object()) {
    value = Value::object();
    for (const auto& [key, item] : json.items())
      value.add(key, from_json(item, source, path.empty() ? key : path + "." + key));
  }

  // Later messages name the file and the way to this value.
  value.set_where(place(source, path));
  return value;
}

Json to_json(const Value& value) {
  switch (value.kind()) {
    case Value::Kind::Null:
      return nullptr;
    case Value::Kind::Bool:
      return value.as_bool();
    case Value::Kind::String:
      return value.as_string();
    case Value::Kind::Number: {
      const double number = value.as_number();
      if (!std::isfinite(number))
        throw Error(value.where(), "a number that is not finite cannot be written as JSON");

      // Whole numbers are written as such: 5, not 5.0. Minus zero keeps its sign.
      constexpr double kLargestExactInteger = 9007199254740992.0;
      if (number == std::floor(number) && std::abs(number) < kLargestExactInteger &&
          !(number == 0 && std::signbit(number)))
        return static_cast<std::int64_t>(number);
      return number;
    }
    case Value::Kind::Array: {
      Json array = Json::array();
      for (const Value& item : value.items()) array.push_back(to_json(item));
      return array;
    }
    case Value::Kind::Object: {
      Json object = Json::object();
      for (const auto& [key, item] : value.members()) object[key] = to_json(item);
      return object;
    }
  }
  return nullptr;
}

/// Line of a byte position, counted from 1.
std::size_t line_at(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

/// Refuses what would overflow the stack of any recursive reader.
void require_shallow(std::string_view text, const std::string& source) {
  constexpr int kDeepest = 200;
  int depth = 0;
  bool in_string = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];

    // Brackets inside a string do not count; a backslash hides the sign behind it.
    if (in_string) {
      if (c == '\\')
        ++k;
      else if (c == '"')
        in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kDeepest) throw Error(source, "is nested more than 200 levels deep");
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
}

}  // namespace

Value parse_json(std::string_view text, const std::string& source) {
  require_shallow(text, source);
  try {
    return from_json(Json::parse(text), source, "");
  } catch (const Json::parse_error& error) {
    const std::string message = error.what();
    const std::size_t detail = message.find("syntax error");
    throw Error(
        source + ":" + std::to_string(line_at(text, error.byte)),
        "is not valid JSON: " + (detail == std::string::npos ? message : message.substr(detail)));
  } catch (const Json::exception& error) {
    throw Error(source, std::string("is not valid JSON: ") + error.what());
  }
}

std::string format_json(const Value& value, bool pretty) {
  try {
    // File names may hold bytes that are not UTF-8: they must not cost anybody a result.
    constexpr auto kReplace = Json::error_handler_t::replace;
    return to_json(value).dump(pretty ? 2 : -1, ' ', false, kReplace) + (pretty ? "\n" : "");
  } catch (const Json::exception& error) {
    throw Error("", std::string("cannot be written as JSON: ") + error.what());
  }
}

}  // namespace dashpot
