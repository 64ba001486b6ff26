#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Words such as "iso8608,class=C,speed=90km/h": a name, and settings of it after commas.
namespace dashpot {

/// The first name that two of the parts "name=value" state, or nothing. Parts without '=' state
/// nothing.
std::optional<std::string> stated_twice(std::span<const std::string> parts);

/// The name and its settings, trimmed. Throws Error where a setting is stated twice, of which one
/// would count for nothing.
std::vector<std::string> split_words(const std::string& words, const std::string& where);

/// The words without what they state of this setting.
std::string without_setting(const std::string& words, std::string_view name);

/// The words with this setting behind all others, in place of what they state of it.
std::string with_setting(const std::string& words, const std::string& name,
                         const std::string& value);

}  // namespace dashpot
