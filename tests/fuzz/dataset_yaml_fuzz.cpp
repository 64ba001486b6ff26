#include "fuzz.h"

void fuzz(const std::string& input) {
  static const std::filesystem::path data = [] {
    std::string text = "t_s,x_mm,F_N,i_A\n";
    for (int k = 0; k < 40; ++k)
      text += std::to_string(0.01 * k) + "," + std::to_string(k % 10) + "," + std::to_string(k % 7) + ",1\n";
    return fuzz_file("run_0.5A.csv", text);
  }();
  load_fuzzed(data, fuzz_file("dataset.yaml", input).string());
}
