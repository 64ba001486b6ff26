#include <filesystem>

#include "dashpot/base/file.h"
#include "program.h"

using namespace dashpot;

TEST_CASE("--report FILE.pdf and --pdf: refused before the work where no browser prints") {
  const TemporaryFolder folder;
  const std::string nowhere = "COLUMNS=100 PATH=" + folder.path().string();
  const ProgramResult sheet = run_dashpot("characterise " + small_campaign().string() +
                                              " --report " + (folder.path() / "a.pdf").string(),
                                          nowhere);
  CHECK(sheet.exit_code == 1);
  CHECK(contains(sheet.output, "PDF: needs a browser that prints, and none is installed"));
  CHECK(!contains(sheet.output, "mm/s"));
  const ProgramResult fit =
      run_dashpot("identify " + small_campaign().string() + " --models bingham --pdf --output " +
                      (folder.path() / "out").string(),
                  nowhere);
  CHECK(fit.exit_code == 1);
  CHECK(contains(fit.output, "Debian's package chromium"));
}

TEST_CASE("--report FILE.pdf: the page, printed" * doctest::test_suite("long")) {
  if (run_program("command -v chromium").exit_code != 0) {
    MESSAGE("skipped: chromium is not installed");
    return;
  }
  const TemporaryFolder folder;
  const std::filesystem::path pdf = folder.path() / "sheet.pdf";
  const ProgramResult sheet =
      run_dashpot("characterise " + small_campaign().string() + " --report " + pdf.string());
  CAPTURE(sheet.output);
  CHECK(sheet.exit_code == 0);
  const std::string bytes = read_file(pdf);
  CHECK(bytes.starts_with("%PDF-"));
  CHECK(bytes.size() > 20000);
}
