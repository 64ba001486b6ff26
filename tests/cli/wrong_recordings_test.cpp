#include "wrong_input.h"

using namespace dashpot;

namespace {

std::string cut_mat() {
  // The head of a version 5 file, then an element that promises 4096 bytes and has 8.
  std::string text = "MATLAB 5.0 MAT-file";
  text.resize(124, ' ');
  return text +
         std::string("\x00\x01IM\x0e\x00\x00\x00\x00\x10\x00\x00\x06\x00\x00\x00\x08\x00\x00\x00",
                     20);
}

}  // namespace

TEST_CASE("recordings that cannot be used" * doctest::test_suite("long")) {
  const Wrong table[] = {
      {"a missing column",
       {{"r.csv", csv(drop_force, 300, "t_s,x_mm,i_A\n")}},
       "inspect DIR/r.csv",
       1,
       {"r.csv: no column is force", "'t_s', 'x_mm', 'i_A'", "dataset file"}},
      {"labels that are units of something else",
       {{"r.csv", csv({}, 300, "t_s,displacement_A,force_A,i_A\n")}},
       "inspect DIR/r.csv",
       1,
       {"no column is displacement (or velocity) and force by its name",
        "'force_A' not used: unit 'A' does not fit force", "dataset file"}},
      {"text",
       {{"r.csv", csv(cell(2, "abc"))}},
       "inspect DIR",
       1,
       {"r.csv:102: force (F_N) is 'abc'", "12.5"}},
      {"NaN",
       {{"r.csv", csv(cell(2, "NaN"))}},
       "inspect DIR",
       1,
       {"r.csv:102: force (F_N) is 'NaN'"}},
      {"infinity",
       {{"r.csv", csv(cell(1, "1e999"))}},
       "inspect DIR",
       1,
       {"r.csv:102: displacement"}},
      {"an empty cell",
       {{"r.csv", csv(cell(2, ""))}},
       "inspect DIR",
       1,
       {"r.csv:102: force (F_N) is empty"}},
      {"time backwards",
       {{"r.csv", csv(cell(0, "0.3"))}},
       "inspect DIR",
       1,
       {"r.csv:102: time runs backwards: 0.3 after 0.495", "must increase"}},
      {"a gap in time",
       {{"r.csv", csv([](int k, auto& row) {
           if (k > 99) row[0] = format_number(k * 0.005 + 1, 9);
         })}},
       "inspect DIR",
       0,
       {"r, stretch 2", "nothing is bridged"}},
      {"two units",
       {{"r.csv", csv({}, 300, std::string(kNames) + "s,m,N,A\n")}},
       "inspect DIR",
       1,
       {"column 'x_mm' has two units: 'mm' in its name and 'm' below it"}},
      {"two columns of one name",
       {{"r.csv", csv({}, 300, "t_s,x_mm,x_mm,F_N\n")}},
       "inspect DIR",
       1,
       {"both displacement", "dataset file"}},
      {"0 bytes",
       {{"good_1A.csv", csv()}, {"r.csv", ""}},
       "inspect DIR",
       4,
       {"r.csv: is empty (0 bytes)"}},
      {"one sample",
       {{"r.csv", csv({}, 1)}},
       "inspect DIR",
       1,
       {"r.csv: has 1 sample;", "at least 2"}},
      {"three samples",
       {{"r.csv", csv({}, 3)}},
       "inspect DIR",
       1,
       {"r.csv: velocity", "only 3 samples"}},
      {"UTF-16",
       {{"r.csv", std::string("\xFF\xFEt\0,\0", 6)}},
       "inspect DIR",
       1,
       {"r.csv: it holds no table of numbers"}},
      {"a long line",
       {{"r.csv", std::string(kNames) + std::string(3 << 20, '1')}},
       "inspect DIR",
       1,
       {"r.csv:2: a line of more"}},
      {"a truncated MAT file", {{"r.mat", cut_mat()}}, "inspect DIR", 1, {"r.mat"}},
      {"garbage",
       {{"r.mat", std::string(500, '\xA7')}},
       "inspect DIR/r.mat",
       1,
       {"r.mat: is not a MAT file"}},
      {"force beyond all scales",
       {{"r.csv", csv(scaled(2, 1e300))}},
       "inspect DIR",
       1,
       {"r.csv: force (F_N) reaches", "unit"}},
      {"no files", {}, "inspect DIR", 1, {"the folder holds no files", ".csv"}},
      {"a cut-off too high",
       {{"r.csv", csv()}},
       "inspect DIR --velocity-cutoff 1e6",
       1,
       {"r.csv: low-pass", "100 Hz"}},
  };
  for (const Wrong& wrong : table) check(wrong);
}

TEST_CASE("recordings that are doubtful are read, and the doubt is said" *
          doctest::test_suite("long")) {
  const Wrong table[] = {
      {"kN called N",
       {{"r.csv", csv(scaled(2, 1e-3))}},
       "inspect DIR",
       0,
       {" N: is its unit N right?"}},
      {"other files",
       {{"r.csv", csv()}, {"photo.jpg", "\xFF\xD8"}, {"notes.txt", "hello\n"}},
       "inspect DIR",
       0,
       {"photo.jpg: passed over", "notes.txt: passed over"}},
      {"old line ends",
       {{"r.csv",
         [] {
           std::string text = csv();
           for (char& c : text)
             if (c == '\n') c = '\r';
           return text;
         }()}},
       "inspect DIR",
       0,
       {"300"}},
      {"names that are no UTF-8 and control a terminal",
       {{"r\xFF.csv", csv({}, 300, "t_s,x_mm,F_N,\x1b[2Jred\n")}},
       "inspect DIR",
       0,
       {"?[2Jred", "r\xEF\xBF\xBD"}},
      {"quotes and blanks in a name",
       {{"a 'b' \"c\"; $d.csv", csv()}},
       "inspect DIR",
       0,
       {"a 'b' \"c\"; $d"}},
  };
  for (const Wrong& wrong : table) check(wrong);
}
