#include "dashpot/report/page.h"

#include <algorithm>

#include "dashpot/error.h"

namespace dashpot {

std::string fill_template(std::string_view text,
                          const std::vector<std::pair<std::string_view, HtmlText>>& values) {
  std::string result;
  std::size_t at = 0;
  for (std::size_t open; (open = text.find("{{", at)) != std::string_view::npos;) {
    // Text that is filled in is behind `at` and never looked at again.
    const std::size_t close = text.find("}}", open);
    if (close == std::string_view::npos) break;
    const std::string_view name = text.substr(open + 2, close - open - 2);
    const auto value =
        std::ranges::find(values, name, &std::pair<std::string_view, HtmlText>::first);
    if (value == values.end())
      throw Error("page template", "nothing is known as '" + std::string(name) + "'");
    result.append(text.substr(at, open - at)).append(value->second.text());
    at = close + 2;
  }
  return result.append(text.substr(at));
}

std::string make_page(const std::string& title, const std::string& summary, const Value& data,
                      const std::vector<JsText>& programs) {
  std::string functions;
  for (const JsText& program : programs) functions += "() => " + program.text() + ",\n";
  std::vector<std::pair<std::string_view, HtmlText>> values{
      {"title", html_text(title)},
      {"summary", html_text(summary)},
      {"data", script_json(data)},
      {"programs", HtmlText::own(std::move(functions))}};
  const auto assets = page_assets();
  for (const auto& [name, text] : assets)
    values.emplace_back(name, HtmlText::own(std::string(text)));
  const auto page =
      std::ranges::find(assets, "page.html", &std::pair<std::string_view, std::string_view>::first);
  return fill_template(page->second, values);
}

}  // namespace dashpot
