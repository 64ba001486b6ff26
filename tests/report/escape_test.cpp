#include "dashpot/base/escape.h"

#include <limits>

#include "dashpot/report/page.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("text stays text in HTML, scripts, Markdown and CSV") {
  CHECK(html_text("<b a=\"1\" b='2'>&").text() == "&lt;b a=&quot;1&quot; b=&#39;2&#39;&gt;&amp;");
  const std::string name = "</script><script>alert(1)</script><!--";
  const std::string json = script_json(Value::object({{name, name}})).text();
  CHECK(json.find('<') == std::string::npos);
  CHECK(parse_json(json, "").members().front().first == name);
  CHECK(parse_json(json, "").members().front().second.as_string() == name);
  CHECK(markdown_cell("a|b\n<i>*c*") == "a\\|b \\<i\\>\\*c\\*");
  CHECK(csv_field("10 mm, 3 \"Hz\"") == "\"10 mm, 3 \"\"Hz\"\"\"");
  CHECK(csv_field("plain") == "plain");
}

TEST_CASE("a raw string does not become code or markup") {
  CHECK(!std::is_convertible_v<std::string, CText>);
  CHECK(!std::is_convertible_v<const char*, HtmlText>);
  CHECK(!std::is_convertible_v<CText, GnuplotText>);
  CHECK(std::is_convertible_v<const char (&)[4], ModelicaText>);
}

TEST_CASE("a comment of C stays one comment, whatever stands in it") {
  CHECK(c_comment("a */ b /* c").text() == "a * / b / * c");
  CHECK(c_comment("/*/*//*").text() == "/ * / * // *");
  CHECK(c_comment("*?\?/").text() == "*? ?/");
  CHECK(c_comment("two\nlines\r\t").text() == "two lines  ");
  CHECK(c_comment("C:\\folder\\").text() == "C:\\folder\\.");
  CHECK(c_comment("end \\ ").text() == "end \\. ");
  CHECK(c_comment("\xE2\x80\xAE reversed, Dämpfer").text() == "\xEF\xBF\xBD reversed, Dämpfer");
  CHECK(c_comment(std::string("a\0b", 3)).text() == "a b");
}

TEST_CASE("a string of C holds every byte, and no sign that ends it") {
  CHECK(c_string("der(state.x)").text() == "\"der(state.x)\"");
  CHECK(c_string("a\"b\\n?\n1").text() == "\"a\\042b\\134n\\077\\0121\"");
}

TEST_CASE("strings of gnuplot and Modelica, and fields that a spreadsheet would calculate") {
  CHECK(gnuplot_string("'q\n100 %").text() == "' ''q 100 %'");
  CHECK(gnuplot_string("it's").text() == "'it''s'");
  CHECK(gnuplot_string("a''").text() == "'a'' '''");
  CHECK(gnuplot_label("100 %").text() == "'100 %%'");
  CHECK(modelica_markup("\"</html>\"\\").text() == "&quot;&lt;/html&gt;&quot;&#92;");
  CHECK(modelica_comment("a\nb").text() == "a b");
  CHECK(csv_field("=HYPERLINK(1)") == "'=HYPERLINK(1)");
  CHECK(csv_field("@SUM(1)") == "'@SUM(1)");
  CHECK(csv_field("-1+cmd|' /C calc'!A0") == "'-1+cmd|' /C calc'!A0");
  CHECK(csv_field("-1.5") == "-1.5");
  CHECK(csv_field("-") == "-");
  CHECK(xml_text(std::string("a\0\x07\n", 4)) == "a  \n");
}

TEST_CASE("Markdown and YAML keep what they are given in its place") {
  CHECK(markdown_prose("|F| < 5 N, <b>x</b> [a](b) ![c][d]") ==
        "|F| < 5 N, \\<b>x\\</b> [a\\](b) ![c\\][d]");
  CHECK(markdown_code("dashpot rank a") == "`dashpot rank a`");
  CHECK(markdown_code("a `b` c") == "`` a `b` c ``");
  CHECK(markdown_block("a\n```\nb\n") == "````\na\n```\nb\n````\n");
  CHECK(parse_yaml("a: " + yaml_string("x: \"y\"\n# z") + "  # " + yaml_comment("p\nb: 1"), "")
            .find("a")
            ->as_string() == "x: \"y\"\n# z");
}

TEST_CASE("what is filled in is not looked at again") {
  const std::vector<std::pair<std::string, CText>> values{{"a", c_comment("@b@")}, {"b", "2"}};
  CHECK(filled("<@a@|@b@|@c@> 1@", values) == "<@b@|2|@c@> 1@");
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

TEST_CASE("a value as JavaScript is ASCII that neither ends a script nor a line") {
  const Value value = Value::object(
      {{"a", "</script><!-- \" \\ \n \x7F \xC3\xA9 \xE2\x80\xA8 \xF0\x9F\x98\x80 \xFF"},
       {"b", Value::array(std::vector<double>{0.1, -std::numeric_limits<double>::infinity()})}});
  CHECK(
      js_value(value).text() ==
      R"({"a":"\u003c/script>\u003c!-- \" \\ \n \u007f \u00e9 \u2028 \ud83d\ude00 \ufffd","b":[0.1,null]})");
}

TEST_CASE("a template is filled once: what is filled in is not looked at again") {
  CHECK(fill_template("<{{a}}|{{b}}>", {{"a", "{{b}}"}, {"b", "2"}}) == "<{{b}}|2>");
  CHECK(message_of([] { fill_template("{{c}}", {{"a", "1"}}); }) ==
        "page template: nothing is known as 'c'");
}
