#include "dashpot/report/page.h"

#include <algorithm>

#include "dashpot/error.h"
#include "dashpot/report/safe_text.h"

namespace dashpot {

std::string fill_template(
    std::string_view text,
    const std::vector<std::pair<std::string_view, std::string_view>>& values) {
  std::string result;
  std::size_t at = 0;
  for (std::size_t open; (open = text.find("{{", at)) != std::string_view::npos;) {
    const std::size_t close = text.find("}}", open);
    if (close == std::string_view::npos) break;
    const std::string_view name = text.substr(open + 2, close - open - 2);
    const auto value =
        std::ranges::find(values, name, &std::pair<std::string_view, std::string_view>::first);
    if (value == values.end())
      throw Error("page template", "nothing is known as '" + std::string(name) + "'");
    result.append(text.substr(at, open - at)).append(value->second);
    at = close + 2;
  }
  return result.append(text.substr(at));
}

std::string make_page(const std::string& title, const std::string& summary, const Value& data) {
  auto values = page_assets();
  const std::string safe_title = escape_html(title), safe_summary = escape_html(summary);
  const std::string safe_data = script_json(data);
  values.insert(values.end(),
                {{"title", safe_title}, {"summary", safe_summary}, {"data", safe_data}});
  const auto page =
      std::ranges::find(values, "page.html", &std::pair<std::string_view, std::string_view>::first);
  return fill_template(page->second, values);
}

}  // namespace dashpot
