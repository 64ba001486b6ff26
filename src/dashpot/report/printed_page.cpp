#include "dashpot/report/printed_page.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <unistd.h>

#include "dashpot/base/child_process.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

namespace fs = std::filesystem;

/// Browsers that print without a window, as they are called on Linux.
constexpr std::array kBrowsers{"chromium", "chromium-browser", "google-chrome",
                               "google-chrome-stable"};

/// The path of the first one along PATH; empty where there is none.
std::string browser() {
  const char* path = std::getenv("PATH");
  for (const char* name : kBrowsers)
    for (const std::string& folder : split(path ? path : "/usr/bin:/bin", ':')) {
      const fs::path program = fs::path(folder) / name;
      if (!folder.empty() && access(program.c_str(), X_OK) == 0) return program.string();
    }
  return {};
}

/// A folder of its own for the page and for what the browser keeps; removed at the end.
class PrintFolder {
 public:
  PrintFolder() {
    std::string pattern = (fs::temp_directory_path() / "dashpot-print-XXXXXX").string();
    if (!mkdtemp(pattern.data()))
      throw Error(pattern, std::strerror(errno),
                  "a folder for temporary files, as TMPDIR names it");
    path_ = pattern;
  }
  ~PrintFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  PrintFolder(const PrintFolder&) = delete;
  PrintFolder& operator=(const PrintFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

void require_browser() {
  if (browser().empty())
    throw Error("PDF", "needs a browser that prints, and none is installed",
                "Debian's package chromium, or the page itself and the browser of your choice");
}

std::string pdf_of_page(const std::string& html) {
  require_browser();
  const PrintFolder folder;
  const fs::path page = folder.path() / "page.html", pdf = folder.path() / "page.pdf";
  write_file(page, html);

  // No host can be reached, nothing of the user's profile is read, and it ends in time. A sandbox
  // cannot be had by root.
  std::vector<std::string> command{"timeout",
                                   "--kill-after=5",
                                   "120",
                                   browser(),
                                   "--headless",
                                   "--disable-gpu",
                                   "--no-first-run",
                                   "--disable-extensions",
                                   "--disable-background-networking",
                                   "--host-resolver-rules=MAP * ~NOTFOUND",
                                   "--user-data-dir=" + (folder.path() / "profile").string(),
                                   "--virtual-time-budget=10000",
                                   "--print-to-pdf-no-header",
                                   "--no-pdf-header-footer",
                                   "--print-to-pdf=" + pdf.string()};
  if (geteuid() == 0) command.emplace_back("--no-sandbox");
  command.push_back("file://" + page.string());
  const ChildResult result = run_child(command);
  if (!result.succeeded || !fs::exists(pdf))
    throw Error(command[3], "did not print the page: " + std::string(trim(result.printed)),
                "print the page by hand");
  return read_file(pdf);
}

}  // namespace dashpot
