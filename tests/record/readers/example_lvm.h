#pragma once
#include <cstdio>
#include <string>
#include <string_view>

/// A LabVIEW measurement of displacement and force, 400 samples at 200 Hz in two segments, as
/// LabVIEW writes it where each channel has an X, all have one, or none ("Multi", "One", "No").
inline std::string example_lvm(std::string_view x_columns, char separator = '\t',
                               char decimal = '.') {
  const bool multi = x_columns == "Multi", none = x_columns == "No";
  const auto row = [&](std::string_view line) {  // of '|' between cells
    std::string text(line);
    for (char& c : text)
      if (c == '|')
        c = separator;
      else if (c == '.')
        c = decimal;
    return text + "\r\n";
  };
  std::string text = row("LabVIEW Measurement|") + row("Writer_Version|2") +
                     row(separator == '\t' ? "Separator|Tab" : "Separator|Comma") +
                     "Decimal_Separator" + separator + decimal + "\r\n" +
                     row("Multi_Headings|Yes") + row("X_Columns|" + std::string(x_columns)) +
                     row("Time_Pref|Relative") + row("***End_of_Header***|") + row("|");

  constexpr int kRows = 200;
  const std::string gap = multi ? "||" : "|";
  for (int segment = 0; segment < 2; ++segment) {
    text += row("Channels|2||") + row("Samples|200" + gap + "200|") +
            row("Y_Unit_Label|mm" + gap + "N|") + row("X_Dimension|Time" + gap + "Time|") +
            row("X0|" + std::to_string(segment) + gap + std::to_string(segment) + "|") +
            row("Delta_X|0.005" + gap + "0.005|") + row("***End_of_Header***||") +
            row(multi ? "X_Value|Displacement|X_Value|Force|Comment"
                      : "X_Value|Displacement|Force|Comment");
    for (int k = 0; k < kRows; ++k) {
      const double t = segment + 0.005 * k;
      char cells[120];
      const std::string time = none ? "" : std::to_string(t);
      std::snprintf(cells, sizeof cells, "%s|%.3f%s%s|%.2f", time.c_str(), k % 80 - 40.,
                    multi ? "|" : "", multi ? time.c_str() : "", 3. * (k % 50) - 70);
      text += row(cells);
    }
    text += row("");
  }
  return text;
}
