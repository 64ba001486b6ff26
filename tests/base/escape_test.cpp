#include "dashpot/report/safe_text.h"

#include <limits>

#include "dashpot/report/page.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("text stays text in HTML, scripts, Markdown and CSV") {
  CHECK(escape_html("<b a=\"1\" b='2'>&") == "&lt;b a=&quot;1&quot; b=&#39;2&#39;&gt;&amp;");
  const std::string name = "</script><script>alert(1)</script><!--";
  const std::string json = script_json(Value::object({{name, name}}));
  CHECK(json.find('<') == std::string::npos);
  CHECK(parse_json(json, "").members().front().first == name);
  CHECK(parse_json(json, "").members().front().second.as_string() == name);
  CHECK(markdown_cell("a|b\n<i>*c*") == "a\\|b \\<i\\>\\*c\\*");
  CHECK(csv_field("10 mm, 3 \"Hz\"") == "\"10 mm, 3 \"\"Hz\"\"\"");
  CHECK(csv_field("plain") == "plain");
}

TEST_CASE("bytes that are not UTF-8 become U+FFFD, one each") {
  const std::string bad = "\xEF\xBF\xBD";
  CHECK(valid_utf8("Dämpfer ΔF 😀") == "Dämpfer ΔF 😀");
  CHECK(valid_utf8("D\xE4mpfer") == "D" + bad + "mpfer");          // Latin-1
  CHECK(valid_utf8("\xC0\xAF") == bad + bad);                      // overlong '/'
  CHECK(valid_utf8("\xED\xA0\x80") == bad + bad + bad);            // a surrogate
  CHECK(valid_utf8("\xF4\x90\x80\x80") == bad + bad + bad + bad);  // beyond U+10FFFF
  CHECK(valid_utf8("end \xE2\x82") == "end " + bad + bad);         // cut off
}

TEST_CASE("on a terminal only colours remain of control characters") {
  CHECK(terminal_text("a\tb\n\x1b[1;31mred\x1b[0m ΔF") == "a\tb\n\x1b[1;31mred\x1b[0m ΔF");
  CHECK(terminal_text("\x1b[2J\x1b]0;title\x07\r\x7f") == "?[2J?]0;title???");
  CHECK(terminal_text("\x1b") == "?");
  CHECK(terminal_text("end\x1b[") == "end?[");
}

TEST_CASE("what JSON cannot hold becomes null, however deep") {
  const Value value = Value::object({{"a", Value::array(std::vector<double>{1, std::nan("")})},
                                     {"b", std::numeric_limits<double>::infinity()},
                                     {"c\xFF", "d\xFF"}});
  CHECK(message_of([&] { format_json(value); }) != "");
  CHECK(format_json(presentable(value), false) ==
        "{\"a\":[1,null],\"b\":null,\"c\xEF\xBF\xBD\":\"d\xEF\xBF\xBD\"}");
}

TEST_CASE("a template is filled once: what is filled in is not looked at again") {
  CHECK(fill_template("<{{a}}|{{b}}>", {{"a", "{{b}}"}, {"b", "2"}}) == "<{{b}}|2>");
  CHECK(message_of([] { fill_template("{{c}}", {{"a", "1"}}); }) ==
        "page template: nothing is known as 'c'");
}
