#include "answers.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot::studio {
namespace {

constexpr std::size_t kMostBody = 1 << 16;

constexpr const char* kReportPolicy =
    "sandbox allow-scripts; default-src 'none'; style-src 'unsafe-inline'; "
    "script-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'";

/// Numbers as a plot needs them: seven digits.
std::string numbers(const std::vector<double>& values) {
  std::string text = "[";
  for (const double value : values)
    text += (text.size() > 1 ? "," : "") +
            (std::isfinite(value) ? fmt::format("{:.7g}", value) : std::string("null"));
  return text + "]";
}

}  // namespace

void answer(httplib::Response& response, const Value& value, int status) {
  response.status = status;
  response.set_content(format_json(value, false), "application/json");
}

void refuse(httplib::Response& response, int status, const std::string& why) {
  answer(response, Value::object({{"error", why}}), status);
}

Value body_of(const httplib::Request& request) {
  if (request.body.size() > kMostBody) throw Error("", "the request is too long");
  return parse_json(request.body, "request");
}

double number_of(const httplib::Request& request, const char* name, double fallback) {
  if (!request.has_param(name)) return fallback;
  const auto number = parse_number(request.get_param_value(name));
  if (!number || !std::isfinite(*number)) throw Error(name, "is no number");
  return *number;
}

void draw(const SampleView& view, const httplib::Request& request, httplib::Response& response) {
  constexpr double kWidest = 4000;
  const auto record =
      request.has_param("name")
          ? view.place_of(request.get_param_value("name"))
          : static_cast<std::size_t>(std::max(0.0, number_of(request, "record", 0)));
  const std::string x_name = request.get_param_value("x"), y_name = request.get_param_value("y");
  const auto width =
      static_cast<std::size_t>(std::clamp(number_of(request, "width", 800), 10.0, kWidest));
  const auto time = view.column(record, "time"), x = view.column(record, x_name),
             y = view.column(record, y_name);
  if (x.empty() || y.empty() || time.empty())
    return answer(response, Value::object({{"x", Value::array()}, {"y", Value::array()}}));

  // The part of it that is looked at, as few points as it takes.
  const auto [first, last] = window_of(time, number_of(request, "from", time.front()),
                                       number_of(request, "to", time.back()));
  const auto part = [&](std::span<const double> all) { return all.subspan(first, last - first); };
  const Curve curve = x_name == "time" ? thin_in_time(part(x), part(y), width)
                                       : thin_along_arc(part(x), part(y), width);
  response.set_content(
      fmt::format(R"({{"x":{},"y":{},"samples":{},"first":{:.9g},"last":{:.9g}}})",
                  numbers(curve.x), numbers(curve.y), last - first, time.front(), time.back()),
      "application/json");
}

void answer_report(httplib::Response& response, const std::filesystem::path& page) {
  const std::string text = read_file(page);
  response.set_header("Content-Security-Policy", kReportPolicy);
  response.set_content(text, "text/html; charset=utf-8");
}

}  // namespace dashpot::studio
