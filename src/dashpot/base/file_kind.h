#pragma once
#include <string>
#include <string_view>

#include "dashpot/value.h"

// What a file of Dashpot's own is by what it says, for messages about one of the wrong kind.
namespace dashpot {

/// "a model file", "a report", "a plant" ...; empty: a document of none of the kinds.
std::string file_kind(const Value& document);

/// Throws Error where the document is a file of another kind than `what`, "a model file".
void refuse_other_kind(const Value& document, const std::string& what);

/// The JSON of a file that should be `what`. A text that does not begin as JSON does is refused
/// with what it is, as far as it can be told.
Value parse_json_of(std::string_view text, const std::string& source, const std::string& what);

}  // namespace dashpot
