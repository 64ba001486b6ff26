#include <cmath>
#include <string_view>
#include <unordered_set>

#include <nlohmann/json.hpp>

#include "dashpot/error.h"
#include "dashpot/value.h"

// The only file that includes the JSON library.
namespace dashpot {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kDeepestJson = 200;
constexpr std::size_t kMostJsonValues = 2'000'000;

/// Throws Error where a key stands twice; in linear time, as the reading of the keys.
void require_different_keys(const Value& object) {
  std::unordered_set<std::string_view> keys;
  for (const auto& [key, item] : object.members())
    if (!keys.insert(key).second) throw Error(object.where(), "the key '" + key + "' stands twice");
}

/// Builds a Value while nlohmann reads the text, so that there is no second tree.
class Builder : public nlohmann::json_sax<Json> {
 public:
  explicit Builder(const std::string& source)
      : source_(std::make_shared<Value::Place>(Value::Place{.name = source})) {}

  bool null() override { return add(Value()); }
  bool boolean(bool value) override { return add(Value(value)); }
  bool number_integer(number_integer_t value) override { return number(value); }
  bool number_unsigned(number_unsigned_t value) override { return number(value); }
  bool number_float(number_float_t value, const string_t&) override { return number(value); }
  bool string(string_t& value) override { return add(Value(std::move(value))); }
  bool binary(binary_t&) override { return false; }
  bool key(string_t& name) override {
    open_.back().key = std::move(name);
    return true;
  }
  bool start_object(std::size_t) override { return start(Value::object()); }
  bool start_array(std::size_t) override { return start(Value::array()); }
  bool end_object() override {
    require_different_keys(open_.back().value);
    return end();
  }
  bool end_array() override { return end(); }
  bool parse_error(std::size_t byte, const std::string&, const Json::exception& error) override {
    const std::string message = error.what();
    const std::size_t detail = message.find("syntax error");
    failed_at = byte;
    failure = detail == std::string::npos ? message : message.substr(detail);
    return false;
  }

  Value result;
  std::size_t failed_at = 0;  ///< byte
  std::string failure;        ///< empty: none

 private:
  /// A list or an object that is being read, with the key of its next member.
  struct Open {
    Value value;
    std::shared_ptr<const Value::Place> place;
    std::string key;
  };

  /// Of the value that comes next.
  std::shared_ptr<const Value::Place> place() const {
    if (open_.empty()) return source_;
    const Open& in = open_.back();
    Value::Place place{.above = in.place};
    if (in.value.kind() == Value::Kind::Array)
      place.item = in.value.items().size();
    else
      place.name = in.key;
    return std::make_shared<Value::Place>(std::move(place));
  }

  template <class Number>
  bool number(Number value) {
    return add(Value(static_cast<double>(value)));
  }

  bool add(Value value) {
    value.set_place(place());
    return put(std::move(value));
  }

  bool put(Value value) {
    if (open_.empty())
      result = std::move(value);
    else if (Open& in = open_.back(); in.value.kind() == Value::Kind::Array)
      in.value.push_back(std::move(value));
    else
      in.value.add(std::move(in.key), std::move(value));
    return true;
  }

  bool start(Value value) {
    std::shared_ptr<const Value::Place> here = place();
    value.set_place(here);
    open_.push_back({std::move(value), std::move(here), {}});
    return true;
  }

  bool end() {
    Value finished = std::move(open_.back().value);
    open_.pop_back();
    return put(std::move(finished));
  }

  std::shared_ptr<const Value::Place> source_;
  std::vector<Open> open_;
};

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

/// Refuses, before anything is kept, a text of too many values or levels.
void require_within_budget(std::string_view text, const std::string& source) {
  int depth = 0;
  std::size_t values = 1;
  bool in_string = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];

    // Signs inside a string do not count; a backslash hides the sign behind it.
    if (in_string) {
      if (c == '\\')
        ++k;
      else if (c == '"')
        in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      ++values;
      if (++depth > kDeepestJson)
        throw Error(source, "is nested more than " + std::to_string(kDeepestJson) + " levels deep");
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == ',') {
      ++values;
    }
  }
  if (values > kMostJsonValues)
    throw Error(source, "has more than " + std::to_string(kMostJsonValues) + " values",
                "divide it into several files");
}

}  // namespace

Value parse_json(std::string_view text, const std::string& source) {
  require_within_budget(text, source);
  Builder builder(source);
  if (!Json::sax_parse(text, &builder))
    throw Error(source + ":" + std::to_string(line_at(text, builder.failed_at)),
                "is not valid JSON: " + builder.failure);
  return std::move(builder.result);
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
