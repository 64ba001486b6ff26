#include "jobs.h"

#include <algorithm>
#include <chrono>
#include <csignal>

#include "child.h"
#include "dashpot/base/file.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/csv.h"

namespace fs = std::filesystem;

namespace dashpot::studio {
namespace {

constexpr std::size_t kMostRunning = 4, kMostSteps = 4000;
constexpr int kMostWaiting = 12;  // pages that wait for news at once

/// The rows of a leaderboard that `dashpot rank` wrote; nothing where there is none yet.
Value leaderboard(const fs::path& folder) {
  const fs::path file = folder / "leaderboard.csv";
  std::error_code error;
  if (!fs::exists(file, error)) return {};
  try {
    const TextTable table = read_text_table(file);
    Value rows = Value::array();
    for (const auto& row : table.rows) rows.push_back(Value::array(row));
    return Value::object({{"columns", Value::array(table.names)}, {"rows", std::move(rows)}});
  } catch (const Error&) {
    return {};
  }
}

/// What a studio wrote of a piece of work: what was asked for, and its state.
std::optional<Value> read_asked(const fs::path& folder, std::string& state) {
  const fs::path file = folder / "studio.json";
  if (!fs::exists(file)) return std::nullopt;
  try {
    const Value value = parse_json(read_file(file), file.string());
    Value asked = Value::object();
    for (const auto& [key, member] : value.members())
      key == "state" ? void(state = member.as_string()) : asked.add(key, member);
    return asked;
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

Jobs::Jobs(const Project& project) : project_(project) {
  // Work of earlier studios and of the command line. What ran when its studio ended is stopped.
  for (const JobKind& kind : job_kinds()) {
    std::error_code error;
    for (const fs::directory_entry& entry :
         fs::directory_iterator(project_.folder() / kind.folder, error)) {
      std::error_code none;
      if (!entry.is_directory(none)) continue;
      std::string state = "done";
      const auto asked = read_asked(entry.path(), state);
      if (!asked && !fs::exists(entry.path() / "models") && !fs::exists(entry.path() / kind.result))
        continue;
      Job& job = jobs_.emplace_back();
      job.kind = &kind;
      job.name = entry.path().filename().string();
      job.asked = asked.value_or(Value());
      if (asked) try {
          job.words = words_of(job);
        } catch (const Error&) {  // of a folder from elsewhere: it cannot go on
        }
      job.state = state == "running" ? "stopped" : state;
      job.fraction = job.state == "done" ? 1 : 0;
    }
  }
  jobs_.sort([](const Job& a, const Job& b) { return a.name < b.name; });
}

Jobs::~Jobs() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    for (Job& job : jobs_)
      if (const int pid = job.pid; pid > 0) kill(pid, SIGTERM);
  }
  condition_.notify_all();
  for (Job& job : jobs_)
    if (job.thread.joinable()) job.thread.join();
}

Jobs::Job* Jobs::find(const JobKind& kind, const std::string& name) {
  const auto at = std::ranges::find_if(
      jobs_, [&](const Job& job) { return job.kind == &kind && job.name == name; });
  return at == jobs_.end() ? nullptr : &*at;
}

fs::path Jobs::folder_of(const Job& job) const {
  return project_.folder() / job.kind->folder / job.name;
}

std::vector<std::string> Jobs::words_of(const Job& job) const {
  const fs::path folder = folder_of(job);
  std::vector<std::string> words = job.kind->words(project_, folder, job.asked);
  words.insert(words.end(), {"--output", folder.string()});
  return words;
}

void Jobs::save(const Job& job) const {
  Value value = job.asked;
  value.add("state", job.state);
  write_file(folder_of(job) / "studio.json", format_json(value));
}

void Jobs::start(const JobKind& kind, const std::string& name, const Value& asked) {
  if (!is_plain_name(name))
    throw Error("'" + name + "'", "is no name for a " + std::string(kind.name), kPlainName);

  const std::lock_guard lock(mutex_);
  if (find(kind, name) || fs::exists(project_.folder() / kind.folder / name))
    throw Error("'" + name + "'", "is a " + std::string(kind.name) + " already",
                "give the new one another name");
  Job& job = jobs_.emplace_back();
  job.kind = &kind;
  job.name = name;
  job.asked = asked;
  try {
    begin(job);
  } catch (...) {
    jobs_.pop_back();
    throw;
  }
}

void Jobs::go_on(const JobKind& kind, const std::string& name) {
  const std::lock_guard lock(mutex_);
  Job* job = find(kind, name);
  if (!job || job->asked.is_null())
    throw Error("'" + name + "'", "is no " + std::string(kind.name) + " of the studio");
  if (job->state == "running") throw Error("'" + name + "'", "is running");
  if (kind.continued) job->asked = kind.continued(folder_of(*job), job->asked);
  begin(*job);
}

/// With the lock held.
void Jobs::begin(Job& job) {
  const auto running = std::ranges::count(jobs_, std::string("running"), &Job::state);
  if (ending_ || static_cast<std::size_t>(running) >= kMostRunning)
    throw Error("", std::to_string(running) + " of fits, rides and designs are running",
                "wait for one, or stop one");

  // What can be refused is refused before a folder is made.
  job.words = words_of(job);
  if (job.thread.joinable()) job.thread.join();
  job.state = "running";
  job.stage = job.kind->name == "fit" ? "reading the recordings" : "";
  job.message.clear();
  job.steps.clear();
  job.parameters = {};
  job.judged.clear();
  job.fraction = 0;
  job.stop_asked = false;
  project_.make_result(job.kind->folder, job.name);
  if (job.kind->prepare) job.kind->prepare(project_, folder_of(job), job.asked);
  save(job);
  job.thread = std::jthread([this, &job] { run(job); });
  ++version_;
  condition_.notify_all();
}

void Jobs::stop(const JobKind& kind, const std::string& name) {
  const std::lock_guard lock(mutex_);
  Job* job = find(kind, name);
  if (!job) throw Error("'" + name + "'", "is no " + std::string(kind.name) + " here");
  job->stop_asked = true;
  if (const int pid = job->pid; pid > 0) kill(pid, SIGTERM);
}

/// A line of `--progress json`.
void Jobs::take_line(Job& job, std::string_view line, double seconds) {
  if (!line.starts_with('{')) return;
  Value value;
  try {
    value = parse_json(line, "progress");
  } catch (const Error&) {
    return;
  }

  // Each line has some of these.
  const std::lock_guard lock(mutex_);
  if (const Value* stage = value.find("stage")) job.stage = stage->as_string();
  if (const Value* fraction = value.find("fraction")) job.fraction = fraction->as_number();
  if (const Value* cost = value.find("cost"); cost && job.steps.size() < kMostSteps)
    job.steps.push_back({job.stage, seconds, cost->as_number()});
  if (const Value* parameters = value.find("parameters"))
    job.parameters = Value::object({{"of", job.stage}, {"values", *parameters}});
  if (const Value* row = value.find("judged")) job.judged.push_back(*row);

  // Whoever waits for news is told.
  ++version_;
  condition_.notify_all();
}

void Jobs::run(Job& job) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begun = Clock::now();
  std::vector<std::string> arguments = job.words;
  arguments.insert(arguments.end(), {"--progress", "json"});
  ChildEnd end;
  try {
    end = run_self(
        arguments, project_.folder(), {},
        [&](std::string_view line) {
          take_line(job, line, std::chrono::duration<double>(Clock::now() - begun).count());
        },
        &job.pid);
  } catch (const Error& error) {
    end.err = std::string("error: ") + error.what();
  }

  // How it ended: of itself, by a hand, with the studio, or by a fault.
  const std::lock_guard lock(mutex_);
  const bool has_result = fs::exists(folder_of(job) / job.kind->result);
  constexpr int kNotUsable = 3, kFilesUnread = 4;
  if (job.stop_asked || ending_) {
    job.state = "stopped";
  } else if ((end.exit_code == 0 || end.exit_code == kNotUsable || end.exit_code == kFilesUnread) &&
             has_result) {
    job.state = "done";
    job.fraction = 1;
  } else {
    job.state = "failed";
    job.message = project_.without_folder(error_of(end));
  }
  try {
    save(job);
  } catch (const Error& error) {
    job.message = error.what();
  }
  ++version_;
  condition_.notify_all();
}

Value Jobs::list(const JobKind& kind) const {
  const std::lock_guard lock(mutex_);
  Value list = Value::array();
  for (const Job& job : jobs_) {
    if (job.kind != &kind) continue;

    // How far it has come: the error of each model over the time, as it reported it.
    Value steps = Value::array();
    for (const Job::Step& step : job.steps)
      steps.push_back(Value::array({Value(step.what), Value(step.seconds), Value(step.cost)}));

    const fs::path folder = folder_of(job);
    list.push_back(Value::object({{"name", job.name},
                                  {"asked", job.asked},
                                  {"state", job.state},
                                  {"stage", job.stage},
                                  {"fraction", job.fraction},
                                  {"message", job.message},
                                  {"steps", std::move(steps)},
                                  {"parameters", job.parameters},
                                  {"judged", Value::array(job.judged)},
                                  {"arguments", Value::array(job.words)},
                                  {"has_report", fs::exists(folder / kind.result)},
                                  {"leaderboard", leaderboard(folder)}}));
  }
  return list;
}

std::size_t Jobs::wait(std::size_t seen) {
  using namespace std::chrono_literals;
  std::unique_lock lock(mutex_);
  if (waiting_ >= kMostWaiting) return version_;
  ++waiting_;
  condition_.wait_for(lock, 20s, [&] { return ending_ || version_ > seen; });
  --waiting_;
  return version_;
}

void Jobs::changed() {
  const std::lock_guard lock(mutex_);
  ++version_;
  condition_.notify_all();
}

}  // namespace dashpot::studio
