#include "dashpot/record/readers/csv.h"

#include <cmath>
#include <zlib.h>

#include "dashpot/base/random.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/csv_dialect.h"
#include "dashpot/record/readers/reader.h"
#include "support.h"

using namespace dashpot;

namespace {

RawTable read_text(const std::string& text) {
  const TemporaryFolder folder;
  return read_csv(folder.write("run.csv", text)).front();
}

std::vector<std::string> names(const RawTable& table) {
  std::vector<std::string> out;
  for (const RawColumn& column : table.columns) out.push_back(column.name);
  return out;
}

}  // namespace

// Expected values are the numbers that the texts show.
TEST_CASE("tables in the shapes that people have") {
  struct Shape {
    const char* what;
    std::string text;
    std::vector<std::string> names;
  };
  const Shape shapes[] = {
      {"plain", "t,x,F\n0,1.5,2\n0.1,2.5,-3\n", {"t", "x", "F"}},
      {"byte order mark, CRLF", "\xEF\xBB\xBFt,x,F\r\n0,1.5,2\r\n0.1,2.5,-3\r\n", {"t", "x", "F"}},
      {"quotes, trailing commas",
       "\"t\",\"x, raw\",\"F\",\n0,1.5,2,\n0.1,2.5,-3,\n",
       {"t", "x, raw", "F"}},
      {"semicolons, decimal commas", "t;x;F\n0;1,5;2\n0,1;2,5;-3\n", {"t", "x", "F"}},
      {"tabs", "t\tx\tF\n0\t1.5\t2\n0.1\t2.5\t-3", {"t", "x", "F"}},
      {"tabs, decimal commas", "t\tx\tF\n0\t1,5\t2\n0,1\t2,5\t-3", {"t", "x", "F"}},
      {"blanks", "  t   x   F\n  0   1.5  2\n 0.1  2.5  -3\n", {"t", "x", "F"}},
      {"blanks, decimal commas", "t x F\n0 1,5 2\n0,1 2,5 -3\n", {"t", "x", "F"}},
      {"junk before",
       "Bench 7\nDate: 3.4.2022\nOperator;none\n\nt,x,F\n0,1.5,2\n0.1,2.5,-3\n",
       {"t", "x", "F"}},
      {"comments", "# bench 7\n# t, x, F\n0, 1.5, 2\n# paused\n0.1, 2.5, -3\n", {"t", "x", "F"}},
      {"no names", "0,1.5,2\n0.1,2.5,-3\n", {"", "", ""}},
      {"signs and exponents", "t,x,F\n0,+1.5,2e0\n1e-1,25E-1,-3\n", {"t", "x", "F"}},
  };
  for (const Shape& shape : shapes) {
    CAPTURE(std::string(shape.what));
    const RawTable table = read_text(shape.text);
    CHECK(names(table) == shape.names);
    REQUIRE(table.rows() == 2);
    CHECK(table.columns[0].values == std::vector<double>{0, 0.1});
    CHECK(table.columns[1].values == std::vector<double>{1.5, 2.5});
    CHECK(table.columns[2].values == std::vector<double>{2, -3});
  }
}

TEST_CASE("a row of units below the names") {
  const RawTable table = read_text("time;disp;force\n[s];(mm);N\n0;1;2\n1;2;3\n");
  CHECK(table.columns[0].unit == "s");
  CHECK(table.columns[1].unit == "mm");
  CHECK(table.columns[2].unit == "N");
  CHECK(table.columns[1].name == "disp");
}

TEST_CASE("a row of units above the names, or in a comment beside them") {
  for (const std::string head :
       {"s;mm;kN\ntime;disp;force\n", "# units: s; mm; kN\ntime;disp;force\n",
        "# units: [s]; [mm]; [kN]\n\ntime;disp;force\n----;----;----\n"}) {
    CAPTURE(head);
    const RawTable table = read_text(head + "0;1;2\n1;2;3\n");
    CHECK(names(table) == std::vector<std::string>{"time", "disp", "force"});
    CHECK(table.columns[1].unit == "mm");
    CHECK(table.columns[2].unit == "kN");
  }

  // Names that have units are not given others.
  CHECK(read_text("s;mm;kN\nt [s];x [m];F [N]\n0;1;2\n1;2;3\n").columns[1].unit.empty());
}

TEST_CASE("quoted names keep their line ends and quotes") {
  const RawTable table = read_text(
      "\"Time\n[s]\",\"Displacement\r\n(LVDT)\n[mm]\",\"F \"\"raw\"\" [kN]\",\"\",\"I\"\n"
      "0,1,2,,3\n1,2,3,,4\n");
  CHECK(names(table) == std::vector<std::string>{"Time [s]", "Displacement (LVDT) [mm]",
                                                 "F \"raw\" [kN]", "", "I"});
  CHECK(table.where(1).find(":6") != std::string::npos);

  // A quote that none closes, as of inches, joins nothing: neither names nor rows.
  const RawTable inches = read_text("t,x [\"],note\n0,1,\"\n1,2,\"\n2,3,\"\n");
  CHECK(inches.columns[1].values == std::vector<double>{1, 2, 3});
  CHECK(inches.columns[1].name == "x [\"]");
}

TEST_CASE("names in Latin-1 are told as the text they are") {
  const RawTable table = read_text("t [\xB5s],x [\xB5m],a [m/s\xB2]\n0,1,2\n1,2,3\n");
  CHECK(names(table) == std::vector<std::string>{"t [\u00b5s]", "x [\u00b5m]", "a [m/s\u00b2]"});
}

TEST_CASE("a row with NUL bytes is refused; one of nothing else is a row without numbers") {
  const std::string none(40, '\0');
  CHECK(contains(message_of([&] { read_text("t,x\n0,1\n1,2" + none + "\n2,3\n"); }),
                 "run.csv:3: holds NUL bytes: a part of the row was lost"));
  CHECK(read_text("t,x\n0,1\n1,2\n" + none).columns[0].bad->row == 2);
}

TEST_CASE("blanks part names from their units as well") {
  const RawTable table = read_text("t [s]  x [mm]  F (N)\n0  1  2\n1  2  3\n");
  CHECK(names(table) == std::vector<std::string>{"t [s]", "x [mm]", "F (N)"});
}

TEST_CASE("names that stand again are passed over; other names head another table") {
  const std::string head = "time,disp,force\ns,mm,N\n", rows = "0,1,2\n1,2,3\n";
  const RawTable again = read_text(head + rows + head + "2,3,4\n" + head + "3,4,5\n");
  CHECK(again.columns[0].values == std::vector<double>{0, 1, 2, 3});
  REQUIRE(again.notes.size() == 1);
  CHECK(contains(again.notes[0], "run.csv:5 and once more: passed over"));

  CHECK(contains(message_of([&] { read_text(head + rows + "\ntime,force,disp\ns,N,mm\n2,3,4\n"); }),
                 "run.csv:8: belongs to another table, which line 6 ('time' ...) heads; give each "
                 "table a file of its own"));
  // Words below a table, or in it, head nothing.
  CHECK(read_text(head + rows + "force limit,displacement limit,none\n").rows() == 3);
  CHECK(read_text(head + rows + "paused,force,limit\n2,3,4\n").rows() == 4);
}

TEST_CASE("times of a clock in the ways that loggers write them") {
  for (const auto& [first, second] :
       {std::pair{"2026-11-23T10:05:07.25", "2026-11-23T10:05:07.75"},
        std::pair{"2026-11-23 10:05:07.25+01:00", "2026-11-23 10:05:07.75+01:00"},
        std::pair{"23.11.2026 10:05:07.25", "23.11.2026 10:05:07.75"},
        std::pair{"23.11.26 10:05:07.25", "23.11.26 10:05:07.75"},
        std::pair{"5/6/2026 10:05:07.25", "5/6/2026 10:05:07.75"},
        std::pair{"11/23/2026 11:59:59.25 AM", "11/23/2026 11:59:59.75 AM"},
        std::pair{"12:00:07.25 AM", "12:00:07.75 AM"}, std::pair{"10:05:07:250", "10:05:07:750"}}) {
    CAPTURE(std::string(first));
    const RawTable table =
        read_text("time;x\n" + std::string(first) + ";1\n" + std::string(second) + ";2\n");
    CHECK(table.columns[0].unit == "s");
    CHECK(table.columns[0].values == std::vector<double>{0.25, 0.75});
  }

  // From noon to one o'clock, and over midnight, whatever the date's order.
  const auto stamps = [](const std::string& first, const std::string& second) {
    return read_text("time;x\n" + first + ";1\n" + second + ";2\n").columns[0].values;
  };
  CHECK(stamps("12:59:59 PM", "1:00:00 PM") == std::vector<double>{0, 1});
  CHECK(stamps("5/6/2026 23:59:59", "5/7/2026 00:00:01") == std::vector<double>{0, 2});
  for (const std::string none : {"10:05", "13:00:00 PM", "10:05:07:25", "10:05:07 CET"})
    CHECK(read_text("time;x\n" + none + ";1\n" + none + ";2\n").columns[0].bad);
}

TEST_CASE("a column without a name, which counts the rows, moves no other") {
  const std::string rows = "0\t0.0\t1.5\n1\t0.1\t2.5\n2\t0.2\t3.5\n";
  for (const std::string head : {"\tt\tx\n", "t\tx\n"}) {
    const RawTable table = read_text(head + rows);
    CHECK(names(table) == std::vector<std::string>{"", "t", "x"});
    CHECK(table.notes.size() == (head.front() == 't' ? 1 : 0));  // what is guessed is told
    CHECK(table.columns[2].values == std::vector<double>{1.5, 2.5, 3.5});
  }

  // Rows that begin elsewhere are counted where a time stands beside them.
  const RawTable later = read_text("t;x\n4000;0.5;7\n4001;0.6;8\n4002;0.7;6\n");
  CHECK(names(later) == std::vector<std::string>{"", "t", "x"});
  CHECK(later.notes.size() == 1);
  CHECK(names(read_text("t;x\n4000;5;7\n4001;7;8\n4002;4;6\n")).front() == "t");

  // Numbers that count beside separators at the end are a time.
  const RawTable ended = read_text("t;x;F\n0;1.5;2;\n1;2.5;3;\n2;3.5;4;\n");
  CHECK(names(ended) == std::vector<std::string>{"t", "x", "F"});

  // A first unit that is empty moves none either.
  const RawTable table = read_text("n\tt\tx\n\ts\tmm\n" + rows);
  CHECK(table.columns[1].unit == "s");
  CHECK(table.columns[2].unit == "mm");
}

TEST_CASE("whole numbers in groups of three are no decimals") {
  const RawTable table = read_text("t\tF\n0\t987\n1\t1,124\n2\t-1,093\n");
  CHECK(table.columns[1].values == std::vector<double>{987, 1124, -1093});
  CHECK(table.notes.front().starts_with("numbers are read with ',' between thousands"));
  CHECK(read_text("t;F\n0;987\n1;1.124\n2;-1.093\n").columns[1].values[1] == 1124);

  // What is no whole number tells nothing of them.
  for (const std::string none : {"nan", "inf", "1e5"})
    CHECK(read_text("t;F\n0;" + none + "\n1;1.124\n").columns[1].values[1] == 1.124);

  // One number that is no group tells that they are decimals.
  CHECK(read_text("t\tF\n0\t987\n1\t1,124\n2\t1,09\n").columns[1].values[1] == 1.124);
  CHECK(read_text("t;F\n0,005;987\n0,010;1,124\n").columns[1].values[1] == 1.124);
}

TEST_CASE("decimal commas in quotes are none that separate") {
  const RawTable table = read_text("t [s],F [N]\n\"0,005\",\"1,2\"\n\"0,010\",\"-3,5\"\n");
  CHECK(table.columns[0].values == std::vector<double>{0.005, 0.01});
  CHECK(table.columns[1].values == std::vector<double>{1.2, -3.5});
  CHECK(read_text("t,F\n0,\"1,093.60\"\n1,\"2.5\"\n").columns[1].values[0] == 1093.6);
}

TEST_CASE("an apostrophe or a blank that breaks no line stands between thousands alone") {
  for (const std::string mark : {"'", "\u2019", "\u202F", "\u00A0", "\x92", "\xA0"}) {
    const RawTable table =
        read_text("t;F\n0;987.5\n1;1" + mark + "124.25\n2;-12" + mark + "345" + mark + "678\n");
    CHECK(table.columns[1].values == std::vector<double>{987.5, 1124.25, -12345678});
    CHECK(table.notes.front().ends_with("between thousands"));
  }
  CHECK(read_text("t;F\n0;1'234,5\n1;2,5\n").columns[1].values[0] == 1234.5);
  CHECK(std::isnan(read_text("t;F\n0;1\n1;12'34.5\n").columns[1].values[1]));
}

TEST_CASE("columns of fixed width that touch are refused, and dates are none") {
  for (const std::string line : {"0.06100.66  636.7", "0.06 100.66-636.70", "0.06-100.66 -636.7"})
    CHECK_THROWS_WITH_AS(
        read_text("t x F\n0.00  0.00 1500.0\n0.01 21.46 1490.0\n" + line + "\n0.07 106.4 353.5\n"),
        doctest::Contains("run.csv:4: '"), Error);
  CHECK(read_text("t x F d\n0.00 0.00 1500.0 29.11.2026\n0.01 1.00 1500.0 29.11.2026\n").rows() ==
        2);
}

TEST_CASE("numbers in groups of which the first lines do not tell are refused") {
  std::string text = "t;F\n";
  for (int k = 0; k < 400; ++k) text += std::to_string(k) + ";1.124\n";
  CHECK(read_text(text).columns[1].values.back() == 1.124);
  CHECK(contains(message_of([&] { read_text(text + "400;987\n"); }),
                 "run.csv:2: '1.124' may be in thousands or have decimals"));
  // One number with decimals tells, wherever it stands.
  CHECK(read_text(text + "400;987\n401;0.5\n").columns[1].values.back() == 0.5);
}

TEST_CASE("an error of a sheet at the start of a row is no comment") {
  for (const std::string error : {"#N/A", "#DIV/0!", "#NV"}) {
    const RawTable table = read_text("F,x\n1,2\n" + error + ",3\n4,5\n");
    REQUIRE(table.columns[0].bad);
    CHECK(table.columns[0].bad->text == error);
  }
  CHECK(read_text("F,x\n1,2\n#NVH, paused\n4,5\n").rows() == 2);
}

TEST_CASE("cells that are no numbers keep their place") {
  const RawTable table = read_text("t,x,comment\n0,1,start\n1,abc,go\n2,,go\n3,4,end\n");
  REQUIRE(table.columns[1].bad);
  CHECK(table.columns[1].bad->text == "abc");
  CHECK(table.where(table.columns[1].bad->row).find("run.csv:3") != std::string::npos);
}

TEST_CASE("lines are counted through comments and blank lines") {
  const RawTable table = read_text("t,x\n\n0,1\n# pause\n\n1,2\n2,3\n");
  CHECK(table.where(0).find(":3") != std::string::npos);
  CHECK(table.where(1).find(":6") != std::string::npos);
  CHECK(table.where(2).find(":7") != std::string::npos);
}

TEST_CASE("names of the first columns are names, and texts beside a table are passed over") {
  const RawTable table = read_text("time;x;force\n0;1;2;3;4;begin\n1;2;3;4;5\n2;3;4;5;6\n");
  CHECK(names(table) == std::vector<std::string>{"time", "x", "force", "", ""});
  CHECK(table.rows() == 3);
  REQUIRE(table.notes.size() == 1);
  CHECK(table.notes[0].find("passed over: 'begin' at ") != std::string::npos);

  // Where commas separate, numbers without a name may be decimals.
  CHECK(message_of([] {
          read_text("time,x,force\n0,1,1,5,2,5\n1,2,2,5,3,5\n2,2,3,5,4,5\n");
        }).find("names for 3 fewer: a comma within the numbers?") != std::string::npos);
}

TEST_CASE("too many cells and texts without numbers are refused") {
  CHECK(message_of([] {
          read_text("t,x\n0,1\n1,2,3\n2,3\n");
        }).find("run.csv:3: has 3 cells, the table has 2") != std::string::npos);
  CHECK(message_of([] { read_text("just words\nand more\n"); }).find("no line holds numbers") !=
        std::string::npos);
}

TEST_CASE("gzip is read as the text it holds, and a cut gzip is refused") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "run.csv.gz";
  gzFile file = gzopen(path.c_str(), "wb");
  for (int k = 0; k < 2000; ++k) gzprintf(file, "%d,%d.5\n", k, k * k);
  gzclose(file);
  const RawTable table = read_tables(path).front();
  REQUIRE(table.rows() == 2000);
  CHECK(table.columns[1].values[30] == 900.5);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  CHECK(message_of([&] { read_tables(path); }).find("cannot be read") != std::string::npos);
}

TEST_CASE("a file longer than the read block keeps every row") {
  const TemporaryFolder folder;
  std::string text = "t,x\n";
  for (int k = 0; k < 200000; ++k) text += std::to_string(k) + "," + std::to_string(-k) + "\n";
  const RawTable table = read_csv(folder.write("long.csv", text)).front();
  REQUIRE(table.rows() == 200000);
  for (std::size_t k = 0; k < table.rows(); ++k) {
    if (table.columns[0].values[k] != static_cast<double>(k)) FAIL("row " << k);
    if (table.columns[1].values[k] != -static_cast<double>(k)) FAIL("row " << k);
  }
}

// Longer than what is read at once, on however many cores.
TEST_CASE("odd lines among very many plain ones stay where they are") {
  const auto text_with = [](const std::string& odd, int at) {
    std::string text = "t,x,note\n";
    for (int k = 0; k < 600'000; ++k) {
      if (k == at) text += odd;
      text += std::to_string(k) + "," + std::to_string(-k) + ",1.5\n";
    }
    return text;
  };
  constexpr int kAt = 450'000;
  const TemporaryFolder folder;
  const auto read = [&](const std::string& odd) {
    return read_csv(folder.write("long.csv", text_with(odd, kAt))).front();
  };

  // A comment and the names once more are no rows; cells that are no numbers keep their place.
  const RawTable table = read("# paused\nt,x,note\n\n");
  REQUIRE(table.rows() == 600'000);
  for (std::size_t k = 0; k < table.rows(); ++k)
    if (table.columns[1].values[k] != -static_cast<double>(k)) FAIL("row " << k);
  CHECK(table.lines == std::vector<std::pair<std::size_t, std::size_t>>{{0, 2}, {kAt, kAt + 5}});
  CHECK(table.notes.back().ends_with("long.csv:450003: passed over, the rows below go on"));
  const RawTable bad = read("7,stuck,1.5\n8,,\n");
  REQUIRE(bad.rows() == 600'002);
  CHECK(bad.columns[1].bad->row == kAt);
  CHECK(bad.columns[1].bad->text == "stuck");
  CHECK(bad.columns[2].bad->row == kAt + 1);
  CHECK(bad.columns[0].values[kAt + 1] == 8);
  CHECK(bad.columns[0].values[kAt + 2] == kAt);

  // What is wrong is told of its line, and of the first such line.
  const auto message = [&](const std::string& odd) { return message_of([&] { read(odd); }); };
  CHECK(message("1,2,3,4\n1,2,3,4,5\n").find("long.csv:450002: has 4 cells") != std::string::npos);
  CHECK(message(std::string("1,2,3\0\n", 7)).find("long.csv:450002: holds NUL bytes") !=
        std::string::npos);
  const std::string too_long = '"' + std::string(2 << 20, 'x') + "\n";
  CHECK(message(too_long).find("long.csv:450002: a line of more") != std::string::npos);
  CHECK(message("1,2,3,4\n1,2,3\n" + too_long).find("long.csv:450002: has 4 cells") !=
        std::string::npos);
}

TEST_CASE("lines of up to 1 MiB are read, in UTF-16 as well") {
  const TemporaryFolder folder;
  for (const bool wide : {false, true}) {
    const auto file_of = [&](std::size_t longest) {
      const std::string text = "# " + std::string(longest, 'x') + "\nt_s,F_N\n0,1\n0.1,2\n";
      std::string bytes = wide ? "\xFF\xFE" : "";
      for (const char c : text) bytes += wide ? std::string{c, '\0'} : std::string{c};
      return folder.write("long.csv", bytes);
    };
    for (const std::size_t longest : {65'000, 65'534, 300'000, 1'000'000})
      CHECK(read_csv(file_of(longest)).front().columns[1].values == std::vector<double>{1, 2});
    CHECK_THROWS_WITH_AS(read_csv(file_of(1 << 20)), doctest::Contains("more than 1 MiB"), Error);
  }
}

TEST_CASE("0 bytes") {
  const TemporaryFolder folder;
  const auto path = folder.write("empty.csv", "");
  CHECK(message_of([&] { read_tables(path); }).find("empty.csv: is empty (0 bytes)") !=
        std::string::npos);
}

TEST_CASE("UTF-16 without a byte order mark is known by its zeros") {
  const TemporaryFolder folder;
  for (const bool little : {true, false}) {
    std::string bytes;
    for (const char c : std::string("t (s);F (N);T (\xB0") + "C)\n0;1;20\n0.1;2;20\n0.2;3;20\n")
      bytes += little ? std::string{c, '\0'} : std::string{'\0', c};
    const RawTable table = read_tables(folder.write("wide.csv", bytes)).front();
    CHECK(table.columns[1].values == std::vector<double>{1, 2, 3});
  }

  // Other bytes with zeros among them are no text.
  const std::string words("\x01\0\x02\0\x03\0\x04\0\x05\0\x06\0\x07\0\x08\0\x09\0", 18);
  CHECK(message_of([&] {
          read_tables(folder.write("words.dat", words));
        }).find("is not a recording") != std::string::npos);
}

// The sanitizers judge this test; any Error is a right answer.
TEST_CASE("arbitrary bytes never crash the text readers") {
  const TemporaryFolder folder;
  Random random(7);
  const std::string alphabet = "0123456789.,;\t\n\r \"#-+eE[]()tF\xC3\xA9";
  for (int round = 0; round < 400; ++round) {
    std::string text =
        round % 3 == 0 ? "Header Size:  7\nSampling Interval: 0.1\na, b, Events\n" : "";
    for (std::size_t k = random.index(400); k > 0; --k)
      text += round % 5 == 0 ? static_cast<char>(random.next())
                             : alphabet[random.index(alphabet.size())];
    const auto path = folder.write("bytes.csv", text);
    try {
      read_tables(path);
    } catch (const Error&) {
    }
  }
}
