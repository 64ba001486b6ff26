#include "dashpot/record/readers/xlsx.h"

#include <cmath>

#include "dashpot/base/file.h"
#include "dashpot/base/random.h"
#include "dashpot/dataset.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/reader.h"
#include "example_workbook.h"
#include "support.h"

using namespace dashpot;

namespace {

std::vector<RawTable> read_workbook_bytes(const std::string& bytes) {
  const TemporaryFolder folder;
  return read_tables(folder.write("run.xlsx", bytes));
}

RawTable read_rows(const std::string& rows, const std::string& strings = "",
                   const std::string& properties = "<workbookPr/>") {
  return read_workbook_bytes(example_workbook({{"run", rows, ""}}, strings, properties)).front();
}

/// The error that a workbook of one sheet is refused with.
std::string refusal(const std::string& rows, const std::string& strings = "") {
  try {
    read_rows(rows, strings);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

const std::string kNames = row_of({text_cell("t"), text_cell("x"), text_cell("F")});

}  // namespace

TEST_CASE("XLSX: names, units, numbers to the last bit, and what stands beside the table") {
  const auto tables = read_workbook_bytes(example_recording_workbook());
  REQUIRE(tables.size() == 1);
  const RawTable& table = tables.front();
  REQUIRE(table.columns.size() == 4);
  CHECK(table.columns[1].name == "displacement");
  CHECK(table.columns[1].unit == "mm");
  CHECK(table.rows() == 40);
  CHECK(table.columns[2].values[5] == 200);
  CHECK(table.where(0).ends_with("run.xlsx, sheet 'run':4"));
  REQUIRE(table.notes.size() == 1);
  CHECK(table.notes[0] == "sheet 'notes' passed over: no table of numbers");

  // Numbers are read as they are written, 17 digits or few.
  const RawTable exact = read_rows(
      kNames +
      row_of({number_cell("0"), number_cell("0.1"), number_cell("-1.2345678901234567E-3")}) +
      row_of({number_cell("1"), number_cell("3.0000000000000004"),
              number_cell("4.9406564584124654E-324")}));
  CHECK(exact.columns[1].values == std::vector<double>{0.1, 3.0000000000000004});
  CHECK(exact.columns[2].values ==
        std::vector<double>{-1.2345678901234567e-3, 4.9406564584124654e-324});
}

TEST_CASE("XLSX: cells that are missing, errors, formulas and booleans") {
  const RawTable table =
      read_rows(kNames + "<row r=\"4\"><c r=\"A4\"><v>0</v></c><c r=\"C4\"><v>7</v></c></row>" +
                "<row r=\"9\"><c r=\"A9\" t=\"e\"><v>#N/A</v></c><c r=\"B9\" t=\"b\"><v>1</v></c>"
                "<c r=\"C9\"><f>A1*2</f></c></row>" +
                row_of({number_cell("2"), "<c><f>1+1</f><v>2</v></c>", number_cell("8")}));
  REQUIRE(table.rows() == 3);
  CHECK(table.columns[1].values[1] == 1);
  CHECK(table.columns[1].values[2] == 2);
  REQUIRE(table.columns[0].bad);
  CHECK(table.columns[0].bad->text == "#N/A");
  REQUIRE(table.columns[1].bad);
  CHECK(table.columns[1].bad->text.empty());
  CHECK(table.where(table.columns[1].bad->row).ends_with(":4"));
  REQUIRE(table.columns[2].bad);
  CHECK(table.columns[2].bad->text == "a formula without a kept value");
  CHECK(table.where(table.columns[2].bad->row).ends_with(":9"));
}

TEST_CASE("XLSX: a cell far beside the table that is only formatted is none") {
  const std::string row = row_of({number_cell("0"), number_cell("1"), number_cell("2")});
  CHECK(read_rows(kNames + row + "<row r=\"3\"><c r=\"CV3\" s=\"1\"/></row>" + row).rows() == 2);
}

TEST_CASE("XLSX: dates and times of day count in seconds; a unit in a format is no date") {
  const auto seconds = [](const std::vector<std::string>& days, int style,
                          const std::string& properties) {
    std::string rows = kNames;
    for (const std::string& day : days)
      rows += row_of({number_cell(day, style), number_cell("1"), number_cell("2")});
    return read_rows(rows, "", properties).columns[0].values;
  };
  // 46349.5 days after 1899-12-30, a quarter of a second, and over midnight.
  CHECK(seconds({"46349.5", "46349.50000289352", "46350.5"}, 1, "<workbookPr/>") ==
        std::vector<double>{0, 0.25, 86400});
  // The 29th of February 1900 that was none lies between these two days.
  CHECK(seconds({"59", "61"}, 1, "<workbookPr/>") == std::vector<double>{0, 86400});
  CHECK(seconds({"59", "61"}, 1, "<workbookPr date1904=\"1\"/>") ==
        std::vector<double>{0, 2 * 86400});
  CHECK(seconds({"0.5", "0.50001157407407407"}, 2, "<workbookPr/>") == std::vector<double>{0, 1});
  CHECK(seconds({"0.5", "0.75"}, 3, "<workbookPr/>") == std::vector<double>{0.5, 0.75});
}

TEST_CASE("XLSX: each sheet with a table is a recording; hidden and short ones are not") {
  const auto sheet = [](double level) {
    std::string rows =
        row_of({text_cell("time [s]"), text_cell("displacement [mm]"), text_cell("force [N]")});
    for (int k = 0; k < 200; ++k)
      rows += row_of({number_cell(std::to_string(0.005 * k)),
                      number_cell(std::to_string(10 * std::sin(0.06 * k))),
                      number_cell(std::to_string(level * std::cos(0.06 * k)))});
    return rows;
  };
  const TemporaryFolder folder;
  const auto path =
      folder.write("day 3.xlsx",
                   example_workbook({{"0.5 A", sheet(500), ""},
                                     {"1 A", sheet(900), ""},
                                     {"old", sheet(9), "hidden"},
                                     {"setup", row_of({number_cell("1"), number_cell("2")}), ""}}));
  LoadOptions options;
  const Dataset dataset = load_dataset({path}, options);
  REQUIRE(dataset.records.size() == 2);
  CHECK(dataset.records[0].name == "day 3, 0.5 A");
  CHECK(dataset.records[1].name == "day 3, 1 A");
  CHECK(dataset.records[1].find("current")->samples[0] == 1);
  const std::string text = describe(dataset);
  CHECK(text.find("'old' passed over: it is hidden") != std::string::npos);
  CHECK(text.find("'setup' passed over") != std::string::npos);
}

TEST_CASE(
    "XLSX: a sheet that is no test is passed over beside others, also where the file is named") {
  std::string test = kNames, notes = row_of({text_cell("shim"), text_cell("count")});
  for (int k = 0; k < 100; ++k) {
    test += row_of({number_cell(std::to_string(0.01 * k)),
                    number_cell(std::to_string(0.01 * std::sin(0.06 * k))),
                    number_cell(std::to_string(500 * std::cos(0.06 * k)))});
    notes += row_of({number_cell(std::to_string(k)), number_cell("2")});
  }
  const TemporaryFolder folder;
  const auto path =
      folder.write("day.xlsx", example_workbook({{"run", test, ""}, {"shims", notes, ""}}));
  for (const auto& pointed : {path, folder.path()}) {
    const Dataset dataset = load_dataset({pointed});
    CHECK(dataset.records.size() == 1);
    REQUIRE(dataset.passed_over.size() == 1);
    CHECK(dataset.passed_over[0].file == "day.xlsx, sheet 'shims'");
    CHECK(dataset.passed_over[0].why.find("no column is displacement") == 0);
  }

  // None that is a test.
  folder.write("day.xlsx", example_workbook({{"a", notes, ""}, {"b", notes, ""}}));
  CHECK(message_of([&] { load_dataset({path}); }).find("day.xlsx, sheet 'a': no column is") !=
        std::string::npos);
}

TEST_CASE("XLSX: notes beside the table hide neither its names nor its rows") {
  const auto cell_h = [](int row, const std::string& value) {
    return "<c r=\"H" + std::to_string(row) + "\"" + value + "</c>";
  };
  const std::string text = " t=\"inlineStr\"><is><t>warm</t></is>", number = "><v>7</v>";
  const std::string row = number_cell("0") + number_cell("1") + number_cell("2");
  for (const std::string& note : {text, number}) {
    const RawTable table =
        read_rows(kNames + "<row>" + row + cell_h(2, note) + "</row>" + row_of({row}) + "<row>" +
                  row + cell_h(4, note) + "</row>" + row_of({row}) + row_of({row}));
    CHECK(table.columns.size() == 3);
    CHECK(table.columns[0].name == "t");
    CHECK(table.rows() == 5);
    REQUIRE(table.notes.size() == 1);
    CHECK(table.notes[0].find("cells beside the table passed over: '") == 0);
    CHECK(table.notes[0].find("sheet 'run':2, and in 1 more row") != std::string::npos);
  }
}

TEST_CASE("XLSX: what is damaged or no recording is refused with place and reason") {
  const std::string row = row_of({number_cell("0"), number_cell("1"), number_cell("2")});
  CHECK(refusal(kNames + row + "<row r=\"3\"><c r=\"BM3\"><v>1</v></c></row>")
            .find("sheet 'run':3: has a cell in column 65") != std::string::npos);
  CHECK(refusal(kNames + row + "<row r=\"3\"><c t=\"s\"><v>7</v></c></row>")
            .find("sheet 'run':3: refers to a text that is not there") != std::string::npos);
  CHECK(refusal(kNames + row + "<row><c></row>").find("of its XML: is damaged") !=
        std::string::npos);
  CHECK(refusal(row_of({text_cell("nothing")})).find("no sheet holds numbers") !=
        std::string::npos);

  // Entities that refer to each other.
  CHECK_THROWS_WITH_AS(read_workbook_bytes(zip_archive({{"xl/workbook.xml", "<workbook/>"}}, 0)),
                       doctest::Contains("no sheet holds numbers"), Error);
  CHECK_THROWS_WITH_AS(
      read_workbook_bytes(zip_archive(
          {{"xl/workbook.xml",
            "<workbook xmlns:r=\"r\"><sheets><sheet name=\"a\" r:id=\"1\"/></sheets></workbook>"},
           {"xl/_rels/workbook.xml.rels",
            "<R><Relationship Id=\"1\" Type=\"x/worksheet\" Target=\"a.xml\"/></R>"},
           {"xl/a.xml", "<!DOCTYPE a [<!ENTITY b \"&b;\">]><a>&b;</a>"}},
          0)),
      doctest::Contains("declares a document type"), Error);
  CHECK_THROWS_WITH_AS(read_workbook_bytes(zip_archive({{"word/document.xml", "<a/>"}}, 0)),
                       doctest::Contains("it is no workbook"), Error);
}

TEST_CASE("XLSX: cut off anywhere it is refused") {
  const std::string whole = example_recording_workbook();
  for (std::size_t size = 5; size < whole.size(); size += 97)
    CHECK_THROWS_AS(read_workbook_bytes(whole.substr(0, size)), Error);
}

TEST_CASE("XLSX: a bomb is refused" * doctest::test_suite("long")) {
  // A hundred and fifty megabytes of rows in less than one, and the same of small sheets.
  std::string rows = kNames;
  const std::string row = row_of({number_cell("0"), number_cell("1"), number_cell("2")});
  while (rows.size() < (std::size_t{150} << 20)) rows += row;
  CHECK(refusal(rows).find("unpacks to far more than a recording") != std::string::npos);
  rows.resize(std::size_t{4} << 20);
  rows.resize(rows.rfind("<row>"));
  const std::vector<ExampleSheet> sheets(40, {"run", rows, ""});
  CHECK_THROWS_WITH_AS(read_workbook_bytes(example_workbook(sheets)),
                       doctest::Contains("unpacks to far more than a recording"), Error);
}

TEST_CASE("XLSX: flipped bytes are read or refused, and nothing else") {
  const std::string whole = example_recording_workbook();
  Random random(7);
  for (int k = 0; k < 300; ++k) {
    std::string bytes = whole;
    for (int flips = 0; flips < 3; ++flips)
      bytes[static_cast<std::size_t>(random.uniform() * double(bytes.size()))] ^=
          static_cast<char>(1 << int(8 * random.uniform()));
    try {
      read_workbook_bytes(bytes);
    } catch (const Error&) {
    }
  }
}
