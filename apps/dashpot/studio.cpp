#include "studio/studio.h"

#include <memory>
#include <spawn.h>
#include <unistd.h>

#include "commands.h"
#include "console.h"

namespace dashpot::cli {
namespace {

struct StudioSettings {
  studio::StudioOptions options;
  bool open = true;
};

constexpr std::string_view kStudioExample =
    "# See the recordings of a folder, fit models and compare them, in the browser:\n"
    "dashpot studio recordings/\n"
    "\n"
    "# On another machine: the same port on both sides of a tunnel, then open the address there\n"
    "ssh -L 8642:127.0.0.1:8642 bench dashpot studio --no-open --port 8642 recordings/";

/// Hands the address to the desktop's own way of opening one, where there is a desktop.
void open_in_browser(std::string address) {
  if (!getenv("DISPLAY") && !getenv("WAYLAND_DISPLAY")) return;
  std::string program = "xdg-open";
  char* const arguments[] = {program.data(), address.data(), nullptr};
  pid_t child = 0;
  posix_spawnp(&child, program.c_str(), nullptr, nullptr, arguments, environ);
}

int run(const StudioSettings& settings, Console& console) {
  constexpr int kGreatestPort = 65535;
  if (settings.options.port > kGreatestPort)
    throw UsageError("--port", std::to_string(settings.options.port) + " is no port",
                     "give at most " + std::to_string(kGreatestPort) + ", or 0 for a free one");
  const Monitor monitor = console.monitor();
  studio::run_studio(
      settings.options,
      [&](const std::string& address) {
        console.print("The studio of " + settings.options.folder + " is open at\n  " + address +
                      "\nfor one browser on this machine, until Ctrl-C ends it.\n");
        std::fflush(stdout);
        if (settings.open) open_in_browser(address);
      },
      [&] { return monitor.stop->load(); });
  return kDone;
}

}  // namespace

Command studio_command() {
  auto settings = std::make_shared<StudioSettings>();
  return {.name = "studio",
          .title = "See recordings, watch fits and compare models in the browser",
          .description =
              "Serves a page to this machine alone and prints its address, which one browser can "
              "use once. FOLDER holds the recordings; what is corrected becomes its dataset.yaml, "
              "fits, rides, designs and exports go to folders of their own in it: all are those of "
              "the command line, and the page says the command for everything that it does. Docs: "
              "docs/studio.md.",
          .options = {{.names = "FOLDER",
                       .target = &settings->options.folder,
                       .help = "the project: a folder with recordings, or an empty one",
                       .takes = Takes::Folder},
                      {.names = "--port",
                       .target = &settings->options.port,
                       .help = "the port to answer at",
                       .value = "N",
                       .minimum = 0,
                       .default_text = "a free one"},
                      {.names = "--no-open",
                       .target = &settings->open,
                       .help = "print the address only, and open no browser"}},
          .example = std::string(kStudioExample),
          .run = [settings](Console& console) { return run(*settings, console); }};
}

}  // namespace dashpot::cli
