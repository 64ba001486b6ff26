#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <functional>
#include <span>
#include <unistd.h>

#include <sanitizer/asan_interface.h>

#include "dashpot/base/file.h"
#include "dashpot/base/random.h"
#include "fuzz.h"

// A target for some seconds with seeds changed by chance: what ./test runs (tests/fuzz/attack),
// since libFuzzer would want another build of the library. What it finds it keeps in a file.

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr unsigned kMostSeconds = 20;  // of one input, with sanitizers on a busy machine
constexpr double kMostInputs = 5000;   // in a second, so that a quicker machine tries nothing new

/// What is being tried, for the moment of death.
struct {
  const FuzzTarget* target = nullptr;
  std::string input, finding;
} now;

void keep_finding() {
  if (!now.target) return;
  std::ofstream(now.finding, std::ios::binary) << now.input;
  const std::string name(now.target->name());
  std::fprintf(stderr, "FINDING in %s: kept in %s\nto repeat it: %s %s %s\n", name.c_str(),
               now.finding.c_str(), program_invocation_name, name.c_str(), now.finding.c_str());
}

/// From an assertion, an exception that nobody caught, or too long a run.
void die_of_signal(int signal) {
  std::fprintf(stderr, signal == SIGALRM ? "too slow\n" : "aborted\n");
  keep_finding();
  _exit(1);
}

/// Changes inputs as files are damaged and people mistype.
class Mutator {
 public:
  Mutator(std::span<const std::string> seeds, std::uint64_t seed) : seeds_(seeds), random_(seed) {}

  std::string next() {
    std::string text = any_seed();
    for (std::size_t changes = 1 + below(4); changes > 0; --changes) change(text);
    constexpr std::size_t kMostBytes = 1 << 16;
    text.resize(std::min(text.size(), kMostBytes));
    return text;
  }

 private:
  static constexpr std::array<std::string_view, 24> kWords{
      "",     "0",    "-1", "1e999", "nan",  "-inf",     "1e-320", "99999999999999999999",
      "null", "true", "\"", "[",     "{",    "[[[[[[",   "}",      ",",
      "=",    ":",    "\n", "\t",    "\xff", "\xc3\xa9", "%s",     "/"};

  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(random_.uniform(0, 1) * static_cast<double>(count));
  }
  const std::string& any_seed() { return seeds_[below(seeds_.size())]; }
  /// A stretch of the text: short mostly.
  std::pair<std::size_t, std::size_t> stretch(const std::string& text) {
    const std::size_t from = below(text.size() + 1);
    const std::size_t most =
        below(4) == 0 ? text.size() - from : std::min<std::size_t>(8, text.size() - from);
    return {from, below(most + 1)};
  }

  void change(std::string& text) {
    const auto [from, count] = stretch(text);
    switch (below(6)) {
      case 0:
        if (!text.empty()) text[std::min(from, text.size() - 1)] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(from, count);
        break;
      case 2:
        text.insert(below(text.size() + 1), text.substr(from, count));
        break;
      case 3:
        text.replace(from, count, kWords[below(kWords.size())]);
        break;
      case 4: {
        const std::string& other = any_seed();
        const auto [begin, length] = stretch(other);
        text.replace(from, count, other.substr(begin, length));
        break;
      }
      default:
        if (below(4) == 0)
          text.resize(from);
        else
          replace_number(text, from);
    }
  }

  /// The number from there on becomes a strange one: what a plain change of bytes seldom makes.
  void replace_number(std::string& text, std::size_t from) {
    constexpr std::string_view kDigits = "0123456789.eE+-";
    const std::size_t begin = text.find_first_of("0123456789", from);
    if (begin == std::string::npos) return;
    const std::size_t end = std::min(text.find_first_not_of(kDigits, begin), text.size());
    text.replace(begin, end - begin, kWords[1 + below(7)]);
  }

  std::span<const std::string> seeds_;
  dashpot::Random random_;
};

void try_input(const FuzzTarget& target, std::string input) {
  now.target = &target;
  now.input = std::move(input);
  alarm(kMostSeconds);
  target.run(now.input);
  alarm(0);
  now.target = nullptr;
}

std::vector<std::string> seeds_of(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> seeds;
  for (const fs::path& file : files) seeds.push_back(dashpot::read_file(file));
  return seeds;
}

/// The same inputs in the same order every time, as far as time or number reach.
void attack(const FuzzTarget& target, const fs::path& seed_folder, double seconds) {
  now.finding = fs::absolute("finding-" + std::string(target.name()));
  const std::vector<std::string> seeds = seeds_of(seed_folder);
  for (const std::string& seed : seeds) try_input(target, seed);
  Mutator mutator(seeds, 1);
  const Clock::time_point end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                   std::chrono::duration<double>(seconds));
  std::size_t tried = 0;
  for (; static_cast<double>(tried) < kMostInputs * seconds && Clock::now() < end; ++tried)
    try_input(target, mutator.next());
  std::printf("%-20s %8zu inputs\n", std::string(target.name()).c_str(), tried);
  std::fflush(stdout);
}

}  // namespace

/// fuzz_attack seeds FOLDER writes what attacks start from; fuzz_attack SECONDS TARGET FOLDER
/// attacks; fuzz_attack TARGET FILE tries what was found; fuzz_attack alone names the targets.
int main(int argc, char** argv) {
  if (argc == 3 && std::string_view(argv[1]) == "seeds") return write_seeds(argv[2]), 0;
  if (argc != 3 && argc != 4) {
    for (const FuzzTarget* target : fuzz_targets())
      std::printf("%s\n", std::string(target->name()).c_str());
    return argc == 1 ? 0 : 2;
  }
  __sanitizer_set_death_callback(keep_finding);
  for (const int signal : {SIGABRT, SIGALRM}) std::signal(signal, die_of_signal);

  const char* name = argv[argc == 3 ? 1 : 2];
  const FuzzTarget* target = find_fuzz_target(name);
  if (!target) return std::fprintf(stderr, "fuzz_attack: no target '%s'\n", name), 2;
  if (argc == 4) return attack(*target, fs::path(argv[3]) / name, std::stod(argv[1])), 0;
  now.finding = fs::absolute("finding-again");
  try_input(*target, dashpot::read_file(argv[2]));
}
