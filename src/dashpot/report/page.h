#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dashpot/base/escape.h"
#include "dashpot/value.h"

namespace dashpot {

/// The page's own files, by name, embedded when the library is built (page/embed.cmake).
std::vector<std::pair<std::string_view, std::string_view>> page_assets();

/// One self-contained page. `summary`: what a reader without JavaScript sees. `data`: what
/// page/start.js reads. `programs`: expressions that the page computes when it wants them.
std::string make_page(const std::string& title, const std::string& summary, const Value& data,
                      const std::vector<JsText>& programs = {});

/// Replaces every {{name}} of the template once; what is filled in is not looked at again.
/// Throws Error on a name that is not among `values`.
std::string fill_template(std::string_view text,
                          const std::vector<std::pair<std::string_view, HtmlText>>& values);

}  // namespace dashpot
