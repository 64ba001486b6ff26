// Layer: base
#pragma once

// A tree of JSON or YAML, and the reading of its objects key by key with errors that name file and
// key. Values own their contents.

#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace dashpot {

/// A node of a JSON or YAML document. Objects keep the order of their keys.
class Value {
 public:
  enum class Kind { Null, Bool, Number, String, Array, Object };
  using Member = std::pair<std::string, Value>;

  Value() = default;
  /// By assignment: g++ 12 destroys a variant whose copy construction threw although nothing was
  /// constructed in it.
  Value(const Value& other) : place_(other.place_) { content_ = other.content_; }
  Value(Value&&) noexcept = default;
  Value& operator=(const Value&) = default;
  Value& operator=(Value&&) noexcept = default;
  ~Value() = default;
  // Written like JSON, so converting: NOLINTBEGIN(google-explicit-constructor)
  Value(bool value) : content_(value) {}
  Value(double value) : content_(value) {}
  Value(int value) : Value(static_cast<double>(value)) {}
  Value(std::size_t value) : Value(static_cast<double>(value)) {}
  Value(std::string value) : content_(std::move(value)) {}
  Value(std::string_view value) : Value(std::string(value)) {}
  Value(const char* value) : Value(std::string(value)) {}
  // NOLINTEND(google-explicit-constructor)

  static Value array(std::vector<Value> items = {});
  static Value array(const std::vector<double>& numbers);
  static Value array(const std::vector<std::string>& strings);
  static Value object(std::vector<Member> members = {});

  Kind kind() const { return static_cast<Kind>(content_.index()); }
  bool is_null() const { return kind() == Kind::Null; }

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

  /// Where a value was read: a step from the place of what holds it. Values share the places above
  /// theirs, so that a long key over many values is kept once.
  struct Place {
    std::shared_ptr<const Place> above = nullptr;  ///< null: `name` is all, as "file.yaml:12"
    std::string name = {};                         ///< the key in an object
    std::optional<std::size_t> item = {};          ///< in place of a key: which of a list
  };

  /// "file.yaml:12" or "model.json, parameters.c0"; empty for a value that was not read.
  std::string where() const;
  void set_place(std::shared_ptr<const Place> place) { place_ = std::move(place); }

 private:
  /// In the order of Kind.
  std::variant<std::monostate, bool, double, std::string, std::vector<Value>, std::vector<Member>>
      content_;
  std::shared_ptr<const Place> place_;
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
/// where(). Numbers keep all their digits; NaN and infinities cannot be written and throw. A text
/// of more values or of deeper nesting than any file of Dashpot's, and a key that stands twice in
/// an object, throw Error.
Value parse_json(std::string_view text, const std::string& source);
Value parse_yaml(std::string_view text, const std::string& source);
std::string format_json(const Value& value, bool pretty = true);

}  // namespace dashpot
