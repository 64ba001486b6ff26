// Layer: base
#pragma once

// A tree of JSON or YAML, and the reading of its objects key by key with errors that name file and
// key. Values own their contents.

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dashpot {

/// A node of a JSON or YAML document. Objects keep the order of their keys.
class Value {
 public:
  enum class Kind { Null, Bool, Number, String, Array, Object };
  using Member = std::pair<std::string, Value>;

  Value() = default;
  // Written like JSON, so converting: NOLINTBEGIN(google-explicit-constructor)
  Value(bool value) : kind_(Kind::Bool), bool_(value) {}
  Value(double value) : kind_(Kind::Number), number_(value) {}
  Value(int value) : Value(static_cast<double>(value)) {}
  Value(std::size_t value) : Value(static_cast<double>(value)) {}
  Value(std::string value) : kind_(Kind::String), string_(std::move(value)) {}
  Value(std::string_view value) : Value(std::string(value)) {}
  Value(const char* value) : Value(std::string(value)) {}
  // NOLINTEND(google-explicit-constructor)

  static Value array(std::vector<Value> items = {});
  static Value array(const std::vector<double>& numbers);
  static Value array(const std::vector<std::string>& strings);
  static Value object(std::vector<Member> members = {});

  Kind kind() const { return kind_; }
  bool is_null() const { return kind_ == Kind::Null; }

  /// Typed access; throws Error(where(), "is a string, not a number") when the kind is another.
  bool as_bool() const;
  double as_number() const;
  const std::string& as_string() const;
  const std::vector<Value>& items() const;
  const std::vector<Member>& members() const;
  std::vector<double> as_numbers() const;

  const Value* find(std::string_view key) const;  ///< nullptr when absent
  void add(std::string key, Value value);         ///< appends to an object
  void push_back(Value value);                    ///< appends to an array

  /// "file.yaml:12" or "model.json, parameters.c0"; empty for a value that was not read.
  const std::string& where() const { return where_; }
  void set_where(std::string where) { where_ = std::move(where); }

 private:
  Kind kind_ = Kind::Null;
  bool bool_ = false;
  double number_ = 0;
  std::string string_;
  std::vector<Value> items_;
  std::vector<Member> members_;
  std::string where_;
};

/// Reads an object key by key and, in finish(), refuses the keys that nobody asked for.
class ObjectReader {
 public:
  /// Throws when `value` is not an object. `what` names it in messages: "a model file".
  ObjectReader(const Value& value, std::string what);

  const Value* optional(std::string_view key);  ///< nullptr when absent or null
  const Value& required(std::string_view key);  ///< throws when absent
  double number(std::string_view key, double fallback);
  double number(std::string_view key);
  std::string string(std::string_view key, const std::string& fallback);
  std::string string(std::string_view key);
  bool boolean(std::string_view key, bool fallback);

  /// Throws Error naming the first unknown key, with the known ones.
  void finish() const;

 private:
  const Value& value_;
  std::string what_;
  std::vector<std::string> asked_;
};

/// JSON and YAML text to a Value and back. `source` (a file name) stands in messages and in
/// where(). Numbers keep all their digits; NaN and infinities cannot be written and throw.
Value parse_json(std::string_view text, const std::string& source);
Value parse_yaml(std::string_view text, const std::string& source);
std::string format_json(const Value& value, bool pretty = true);

}  // namespace dashpot
