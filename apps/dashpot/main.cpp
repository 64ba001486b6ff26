#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <malloc.h>
#include <new>
#include <unistd.h>

#include <sys/time.h>

#include "arguments.h"
#include "commands.h"
#include "console.h"
#include "dashpot/base/ranks.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/nets/kernel.h"
#include "help.h"

namespace dashpot::cli {
namespace {

std::atomic<bool> stop_asked = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler writes it");
std::atomic<int> stop_signal = 0;
std::atomic<bool> speaks = true;  // rank 0 of mpirun does so for the others

constexpr std::string_view kOutOfMemory = "error: out of memory\n";
constexpr std::string_view kInterrupted =
    "interrupted; files that were being written stand as they were before";

/// Without memory or locks, for where neither may be had.
void write_to_stderr(std::initializer_list<std::string_view> parts) noexcept {
  for (const std::string_view part : parts)
    if (write(STDERR_FILENO, part.data(), part.size()) < 0) return;
}

/// The first signal asks work to end in order. Where it has not within a moment, the program ends:
/// files are renamed when they are whole, and what is kept is kept piece by piece. Other signals
/// within that moment are the first again: `timeout` and shells send one to the program and one to
/// its group.
void on_signal(int number) {
#ifdef __SANITIZE_ADDRESS__
  constexpr timeval kMoment{.tv_sec = 8, .tv_usec = 0};  // where all work is many times slower
#else
  constexpr timeval kMoment{.tv_sec = 0, .tv_usec = 250'000};
#endif
  if (stop_asked.exchange(true)) return;
  stop_signal = number;
  const itimerval moment{.it_interval = {}, .it_value = kMoment};
  setitimer(ITIMER_REAL, &moment, nullptr);
}

void on_moment_over(int) {
  constexpr std::string_view kBegin = "\nerror: ",
                             kEnd = "; where work is kept, the same command goes on from there\n";
  if (speaks) write_to_stderr({kBegin, kInterrupted, kEnd});
  _exit(128 + stop_signal);
}

void catch_signals() {
  struct sigaction action{};
  action.sa_handler = on_signal;
  for (const int number : {SIGINT, SIGTERM}) sigaction(number, &action, nullptr);
  action.sa_handler = on_moment_over;
  sigaction(SIGALRM, &action, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on file size is then an error with a message
  std::signal(SIGPIPE, SIG_IGN);  // results are written although nobody reads the table
}

/// Where memory runs out within a library that promised not to throw, the program ends as it does
/// elsewhere: files are whole, since each is renamed when it is. All else is a fault of ours.
[[noreturn]] void on_terminate() noexcept {
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    write_to_stderr({kOutOfMemory});
    _exit(kUnusableInput);
  } catch (const std::exception& error) {
    write_to_stderr({"error: unexpected: ", error.what(), "\n"});
  } catch (...) {
    write_to_stderr({"error: unexpected\n"});
  }
  std::abort();
}

/// Memory once had is kept for what comes next: to get a page from the system costs several times
/// what it costs to fill it, above all on virtual machines.
void keep_memory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

/// A file opened later must not become a closed standard stream: the table would end up in the
/// report. Opened for the wrong direction, so that using the stream is an error still.
void hold_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(descriptor, F_GETFD) < 0)
      open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

/// The command that the first words name; what is left are its arguments.
Command named_command(std::vector<std::string>& words) {
  Command command;
  command.subcommands = all_commands();
  while (!command.subcommands.empty() && !words.empty() &&
         (command.name.empty() || !words.front().starts_with('-'))) {
    command = Command(find_command(command.subcommands, words.front()));
    words.erase(words.begin());
  }
  return command;
}

/// Enters the job of mpirun, if there is one. Rank 0 alone speaks.
void join_job(const Command& command, Console& console) {
  if (ranks_started() == 1) return;
  join_ranks(std::filesystem::read_symlink("/proc/self/exe").parent_path().string());
  if (ranks().is_worker()) {
    speaks = false;
    console.quiet = true;
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    close(nowhere);
  }
  if (!command.over_ranks)
    throw UsageError(command.name, "does not share its work among the processes of mpirun",
                     "start it alone; rank, search, sweep and identify-many share theirs");
}

/// What `--help` is to print: the command's own text, or that on the word behind it. Empty where
/// nobody asks.
std::string asked_help(const std::vector<std::string>& words, const Command& command,
                       const std::vector<Option>& common, const Console& console) {
  const auto asked =
      std::ranges::find_if(words, [](const auto& w) { return w == "--help" || w == "-h"; });
  if (asked == words.end()) return {};
  const auto on = std::next(asked);
  return on == words.end() ? command_help(command, common, console)
                           : help_on(*on, command, common, console);
}

int run_command(std::vector<std::string> words, Console& console) {
  const Command command = named_command(words);
  join_job(command, console);
  const std::vector<Option> common = common_options(console);
  std::vector<Option> options = command.options;
  append(options, common);
  // Help prints the defaults, so it is written before anything is parsed into them.
  const std::string help = asked_help(words, command, common, console);
  if (!parse_arguments(command.name, options, words)) {
    console.json = false;
    console.print(help);
    return kDone;
  }
  if (!command.run) {
    std::vector<std::string> known;
    for (const Command& one : command.subcommands) known.push_back(one.last_word());
    throw UsageError(command.name, "the subcommand is missing", "known: " + join(known, ", "));
  }
  return command.run(console);
}

/// DASHPOT_SIMD stands for --simd in every command, also in those that have no such option.
void settle_instructions() {
  const char* level = std::getenv("DASHPOT_SIMD");
  if (level && *level) use_simd(level, "the environment's DASHPOT_SIMD");
}

/// Who set DASHPOT_DATA to what is no folder can still ask for help, and for the version.
void settle_data(const std::vector<std::string>& words, Console& console) {
  const char* stated = std::getenv("DASHPOT_DATA");
  if (std::error_code none; !stated || !*stated || std::filesystem::is_directory(stated, none))
    return;
  constexpr std::array kAnywhere = {"help", "version", "--version", "--help-markdown"};
  const auto asks = [](const std::string& word) { return word == "--help" || word == "-h"; };
  if (!words.empty() && std::ranges::find(kAnywhere, words.front()) == kAnywhere.end() &&
      std::ranges::none_of(words, asks))
    return;
  console.warn(std::string("DASHPOT_DATA: '") + stated + "' is no folder; passed over here");
  unsetenv("DASHPOT_DATA");
}

int run_words(const std::vector<std::string>& words, Console& console) {
  if (words.empty() || words.front() == "--help" || words.front() == "-h") {
    console.print(overview(all_commands(), console));
    return kDone;
  }

  // 'dashpot help rank' is 'dashpot rank --help', and 'dashpot help rank laws' a part of it.
  if (words.front() == "help") {
    std::vector<std::string> on(words.begin() + 1, words.end());
    if (on.empty()) return run_words({}, console);
    const Command command = named_command(on);
    const std::vector<Option> common = common_options(console);
    console.print(on.empty() ? command_help(command, common, console)
                             : help_on(on.front(), command, common, console));
    return kDone;
  }

  if (words.front() == "--help-markdown") {
    console.print(help_markdown(all_commands(), common_options(console)));
    return kDone;
  }

  if (words.front() == "--version") return run_command({"version"}, console);
  return run_command(words, console);
}

/// The command line that explains what went wrong on this one.
std::string help_for(const std::vector<std::string>& words) {
  std::vector<Command> commands = all_commands();
  std::string name, called;
  for (const std::string& word : words) {
    name += (name.empty() ? "" : " ") + word;
    const auto command = std::ranges::find(commands, name, &Command::name);
    if (command == commands.end()) break;
    called += ' ' + word;
    commands = std::vector<Command>(command->subcommands);
  }
  return "dashpot" + called + " --help";
}

/// What went wrong, told by rank 0 also where it went wrong in another process of mpirun.
void explain(std::string_view message, Console& console) {
  if (ranks().is_worker()) fail_rank(std::string(message));
  console.error(message);
}

int run_and_explain(const std::vector<std::string>& words, Console& console) {
  try {
    settle_instructions();
    settle_data(words, console);
    const int code = run_words(words, console);
    console.finish();
    leave_ranks();
    return code == kDone && console.files_unread ? static_cast<int>(kFilesUnread) : code;
  } catch (const ReaderGone&) {
    // Nothing went wrong with the work: its reader has left, or below, the user stopped it.
    return 128 + SIGPIPE;
  } catch (const Interrupted&) {
    explain(kInterrupted, console);
    return 128 + stop_signal;
  } catch (const UsageError& error) {
    // A UsageError is an Error too, but one that the help can answer.
    explain(error.what(), console);
    console.talk("'" + help_for(words) + "' explains.\n");
    return kUsage;
  } catch (const Error& error) {
    // From here on the input cannot be used, or the machine cannot do it.
    explain(error.what(), console);
  } catch (const std::bad_alloc&) {
    explain("out of memory; fewer records at once need less", console);
  } catch (const std::exception& error) {
    explain(std::string("unexpected: ") + error.what(), console);
  }
  return kUnusableInput;
}

}  // namespace
}  // namespace dashpot::cli

int main(int argc, char** argv) {
  using namespace dashpot::cli;
  keep_memory();
  hold_standard_streams();
  catch_signals();
  std::set_terminate(on_terminate);
  try {
    const std::vector<std::string> words(argv + 1, argv + argc);
    std::string line = "dashpot";
    for (const std::string& word : words) line += ' ' + shell_quoted(word);
    Console console(line, stop_asked);
    const int code = run_and_explain(words, console);
    dashpot::end_ranks(code);
    return code;
  } catch (const std::bad_alloc&) {
    // Not even the message of an error has room.
    write_to_stderr({kOutOfMemory});
    return kUnusableInput;
  }
}
