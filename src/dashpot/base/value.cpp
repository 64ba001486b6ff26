#include "dashpot/value.h"

#include <algorithm>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

std::string_view name_of(Value::Kind kind) {
  switch (kind) {
    case Value::Kind::Null:
      return "empty";
    case Value::Kind::Bool:
      return "true or false";
    case Value::Kind::Number:
      return "a number";
    case Value::Kind::String:
      return "text";
    case Value::Kind::Array:
      return "a list";
    case Value::Kind::Object:
      return "a mapping";
  }
  return "";
}

/// `what` names the value where its place does not: "'scale' ".
void require_kind(const Value& value, Value::Kind wanted, const std::string& what = {}) {
  if (value.kind() == wanted) return;
  throw Error(value.where(), what + "is " + std::string(name_of(value.kind())) + ", not " +
                                 std::string(name_of(wanted)));
}

std::string in_quotes(std::string_view key) { return "'" + std::string(key) + "' "; }

double number_of(const Value& value, std::string_view key) {
  require_kind(value, Value::Kind::Number, in_quotes(key));
  return value.as_number();
}

std::string string_of(const Value& value, std::string_view key) {
  require_kind(value, Value::Kind::String, in_quotes(key));
  return value.as_string();
}

}  // namespace

std::string Value::where() const {
  // From the value up to the file, then the other way round.
  std::vector<const Place*> steps;
  for (const Place* step = place_.get(); step; step = step->above.get()) steps.push_back(step);
  if (steps.empty()) return "";

  std::string path;
  for (std::size_t k = steps.size() - 1; k-- > 0;) {
    const auto& [above, name, item] = *steps[k];
    path += item ? '[' + std::to_string(*item) + ']' : path.empty() ? name : '.' + name;
  }
  const std::string& source = steps.back()->name;
  return path.empty() ? source : source + ", " + path;
}

Value Value::array(std::vector<Value> items) {
  Value value;
  value.content_ = std::move(items);
  return value;
}

Value Value::array(const std::vector<double>& numbers) {
  return array(std::vector<Value>(numbers.begin(), numbers.end()));
}

Value Value::array(const std::vector<std::string>& strings) {
  return array(std::vector<Value>(strings.begin(), strings.end()));
}

Value Value::object(std::vector<Member> members) {
  Value value;
  value.content_ = std::move(members);
  return value;
}

bool Value::as_bool() const { return require_kind(*this, Kind::Bool), std::get<bool>(content_); }
double Value::as_number() const {
  return require_kind(*this, Kind::Number), std::get<double>(content_);
}
const std::string& Value::as_string() const {
  return require_kind(*this, Kind::String), std::get<std::string>(content_);
}
const std::vector<Value>& Value::items() const {
  return require_kind(*this, Kind::Array), std::get<std::vector<Value>>(content_);
}
const std::vector<Value::Member>& Value::members() const {
  return require_kind(*this, Kind::Object), std::get<std::vector<Member>>(content_);
}

std::vector<double> Value::as_numbers() const {
  std::vector<double> numbers;
  for (const Value& item : items()) numbers.push_back(item.as_number());
  return numbers;
}

const Value* Value::find(std::string_view key) const {
  for (const Member& member : members())
    if (member.first == key) return &member.second;
  return nullptr;
}

void Value::add(std::string key, Value value) {
  require_kind(*this, Kind::Object);
  std::get<std::vector<Member>>(content_).emplace_back(std::move(key), std::move(value));
}

void Value::push_back(Value value) {
  require_kind(*this, Kind::Array);
  std::get<std::vector<Value>>(content_).push_back(std::move(value));
}

ObjectReader::ObjectReader(const Value& value, std::string what)
    : value_(value), what_(std::move(what)) {
  if (value.kind() != Value::Kind::Object)
    throw Error(value.where(), what_ + " must be a mapping of keys to values, not " +
                                   std::string(name_of(value.kind())));
}

const Value* ObjectReader::optional(std::string_view key) {
  asked_.emplace_back(key);
  const Value* found = value_.find(key);
  return found && found->is_null() ? nullptr : found;
}

const Value& ObjectReader::required(std::string_view key) {
  if (const Value* found = optional(key)) return *found;

  // A key that looks like it, and that nothing else has asked for so far, may be meant by it.
  constexpr std::size_t kShortest = 4;  // of words that can look alike
  std::vector<std::string> others;
  for (const auto& [name, value] : value_.members())
    if (std::ranges::find(asked_, name) == asked_.end()) others.push_back(name);
  const auto near = key.size() < kShortest ? std::nullopt : closest(key, others);
  throw Error(value_.where(), what_ + " needs '" + std::string(key) + "'",
              near ? "did you mean it by '" + *near + "'?" : "");
}

double ObjectReader::number(std::string_view key) { return number_of(required(key), key); }
std::string ObjectReader::string(std::string_view key) { return string_of(required(key), key); }

double ObjectReader::number(std::string_view key, double fallback) {
  const Value* found = optional(key);
  return found ? number_of(*found, key) : fallback;
}

std::string ObjectReader::string(std::string_view key, const std::string& fallback) {
  const Value* found = optional(key);
  return found ? string_of(*found, key) : fallback;
}

bool ObjectReader::boolean(std::string_view key, bool fallback) {
  const Value* found = optional(key);
  if (!found) return fallback;
  require_kind(*found, Value::Kind::Bool, in_quotes(key));
  return found->as_bool();
}

void ObjectReader::finish() const {
  for (const auto& [key, value] : value_.members()) {
    if (std::find(asked_.begin(), asked_.end(), key) != asked_.end()) continue;
    throw Error(value.where(), what_ + " has an unknown key '" + key + "'", suggest(key, asked_));
  }
}

}  // namespace dashpot
