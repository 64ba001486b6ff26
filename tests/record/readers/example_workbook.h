#pragma once
#include <string>
#include <vector>

#include "dashpot/export/fmu/fmu.h"

// A small writer of workbooks, for tests and as seeds of fuzzing.

struct ExampleSheet {
  std::string name;
  std::string rows;   ///< as XML: <row><c>...</c></row>...
  std::string state;  ///< "" or "hidden"
};

/// A cell with a number, and one with an inline text.
inline std::string number_cell(const std::string& number, int style = 0) {
  return "<c s=\"" + std::to_string(style) + "\"><v>" + number + "</v></c>";
}
inline std::string text_cell(const std::string& text) {
  return "<c t=\"inlineStr\"><is><t>" + text + "</t></is></c>";
}
inline std::string row_of(const std::vector<std::string>& cells) {
  std::string row = "<row>";
  for (const std::string& cell : cells) row += cell;
  return row + "</row>";
}

/// The bytes of a workbook. `strings` are the shared ones, as XML: <si>...</si>; style 1 shows
/// "yyyy-mm-dd hh:mm:ss", style 2 is the built-in h:mm:ss, style 3 shows "0.00 "days"".
inline std::string example_workbook(const std::vector<ExampleSheet>& sheets,
                                    const std::string& strings = "",
                                    const std::string& properties = "<workbookPr/>") {
  const std::string head = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  const std::string space = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
  const std::string kind = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";

  std::string book = head + "<workbook xmlns=\"" + space + "\" xmlns:r=\"" + kind + "\">" +
                     properties + "<sheets>";
  std::string relations =
      head +
      "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">";
  std::vector<dashpot::ExportedFile> files;
  for (std::size_t k = 0; k < sheets.size(); ++k) {
    const std::string number = std::to_string(k + 1);
    book += "<sheet name=\"" + sheets[k].name + "\" sheetId=\"" + number + "\" r:id=\"rId" +
            number + "\"" + (sheets[k].state.empty() ? "" : " state=\"" + sheets[k].state + "\"") +
            "/>";
    relations += "<Relationship Id=\"rId" + number + "\" Type=\"" + kind +
                 "/worksheet\" Target=\"worksheets/sheet" + number + ".xml\"/>";
    files.push_back({"xl/worksheets/sheet" + number + ".xml",
                     head + "<worksheet xmlns=\"" + space + "\"><sheetData>" + sheets[k].rows +
                         "</sheetData></worksheet>"});
  }

  files.push_back({"xl/workbook.xml", book + "</sheets></workbook>"});
  files.push_back({"xl/_rels/workbook.xml.rels", relations + "</Relationships>"});
  files.push_back({"xl/styles.xml",
                   head + "<styleSheet xmlns=\"" + space +
                       "\"><numFmts><numFmt numFmtId=\"164\" formatCode=\"yyyy\\-mm\\-dd "
                       "hh:mm:ss\"/><numFmt numFmtId=\"165\" formatCode=\"0.00&quot;days&quot;\"/>"
                       "</numFmts><cellXfs><xf numFmtId=\"0\"/><xf numFmtId=\"164\"/>"
                       "<xf numFmtId=\"21\"/><xf numFmtId=\"165\"/></cellXfs></styleSheet>"});
  if (!strings.empty())
    files.push_back(
        {"xl/sharedStrings.xml", head + "<sst xmlns=\"" + space + "\">" + strings + "</sst>"});
  return dashpot::zip_archive(files, 1'000'000'000);
}

/// Sheets of a short test, with shared and inline names, units, a date and a gap.
inline std::string example_recording_workbook() {
  std::string rows = "<row r=\"1\"><c r=\"A1\" t=\"inlineStr\"><is><t>Bench 7</t></is></c></row>" +
                     row_of({text_cell("time"), "<c t=\"s\"><v>0</v></c>", text_cell("force"),
                             text_cell("current")}) +
                     row_of({text_cell("s"), text_cell("mm"), text_cell("N"), text_cell("A")});
  for (int k = 0; k < 40; ++k)
    rows += row_of({number_cell(std::to_string(0.01 * k)), number_cell(std::to_string(k % 10)),
                    number_cell(std::to_string(100 * (k % 7) - 300)), number_cell("0.5")});
  return example_workbook({{"run", rows, ""}, {"notes", row_of({text_cell("none")}), ""}},
                          "<si><r><t>displace</t></r><r><t>ment</t></r></si>");
}
