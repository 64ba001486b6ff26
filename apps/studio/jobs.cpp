#include "jobs.h"

#include <algorithm>
#include <chrono>
#include <csignal>

#include "child.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/registry.h"
#include "dashpot/dataset.h"
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

/// What a studio wrote of a fit.
std::optional<FitRequest> read_request(const fs::path& folder, std::string& state) {
  const fs::path file = folder / "studio.json";
  if (!fs::exists(file)) return std::nullopt;
  try {
    const Value value = parse_json(read_file(file), file.string());
    ObjectReader reader(value, "a fit");
    FitRequest request{folder.filename().string(), {}, reader.string("leave_out", "")};
    for (const Value& model : reader.required("models").items())
      request.models.push_back(model.as_string());
    state = reader.string("state", "stopped");
    return request;
  } catch (const Error&) {
    return std::nullopt;
  }
}

void require_models(const std::vector<std::string>& models) {
  std::vector<std::string> known = model_names();
  for (const std::string& more : more_model_names()) known.push_back(more);
  known.insert(known.end(), {"usual", "all", "family"});
  if (models.empty()) throw Error("models", "none is chosen");
  for (const std::string& model : models)
    if (std::ranges::find(known, model) == known.end())
      throw Error("'" + model + "'", "is no model", suggest(model, known));
}

}  // namespace

Jobs::Jobs(const Project& project) : project_(project) {
  // Fits of earlier studios and of the command line. One that ran when its studio ended is stopped.
  std::error_code error;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(project_.folder() / "fits", error)) {
    if (!entry.is_directory(error)) continue;
    std::string state = "done";
    const auto request = read_request(entry.path(), state);
    if (!request && !fs::exists(entry.path() / "models")) continue;
    Job& job = jobs_.emplace_back();
    job.request = request.value_or(FitRequest{entry.path().filename().string(), {}, ""});
    job.state = state == "running" ? "stopped" : state;
    job.fraction = job.state == "done" ? 1 : 0;
  }
  jobs_.sort([](const Job& a, const Job& b) { return a.request.name < b.request.name; });
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

Jobs::Job* Jobs::find(const std::string& name) {
  const auto at = std::ranges::find_if(jobs_, [&](const Job& j) { return j.request.name == name; });
  return at == jobs_.end() ? nullptr : &*at;
}

std::vector<std::string> Jobs::arguments(const FitRequest& request) const {
  std::vector<std::string> words{"rank",     project_.folder().string(),
                                 "--models", join(request.models, ","),
                                 "--output", (project_.folder() / "fits" / request.name).string()};
  if (!request.leave_out.empty()) words.insert(words.end(), {"--leave-out", request.leave_out});
  return words;
}

void Jobs::save(const Job& job) const {
  write_file(project_.folder() / "fits" / job.request.name / "studio.json",
             format_json(Value::object({{"models", Value::array(job.request.models)},
                                        {"leave_out", job.request.leave_out},
                                        {"state", job.state}})));
}

void Jobs::start(const FitRequest& request) {
  // What can be refused is refused before a folder is made.
  if (!is_plain_name(request.name)) throw Error("'" + request.name + "'", "is no name for a fit");
  require_models(request.models);
  if (!request.leave_out.empty()) parse_leave_out(request.leave_out);

  const std::lock_guard lock(mutex_);
  if (find(request.name) || fs::exists(project_.folder() / "fits" / request.name))
    throw Error("'" + request.name + "'", "is a fit already", "give the new one another name");
  Job& job = jobs_.emplace_back();
  job.request = request;
  try {
    begin(job);
  } catch (...) {
    jobs_.pop_back();
    throw;
  }
}

void Jobs::go_on(const std::string& name) {
  const std::lock_guard lock(mutex_);
  Job* job = find(name);
  if (!job || job->request.models.empty()) throw Error("'" + name + "'", "is no fit of the studio");
  if (job->state == "running") throw Error("'" + name + "'", "is running");
  begin(*job);
}

/// With the lock held.
void Jobs::begin(Job& job) {
  const auto running = std::ranges::count(jobs_, std::string("running"), &Job::state);
  if (ending_ || static_cast<std::size_t>(running) >= kMostRunning)
    throw Error("", std::to_string(running) + " fits are running", "wait for one, or stop one");
  if (job.thread.joinable()) job.thread.join();
  job.state = "running";
  job.stage = "reading the recordings";
  job.message.clear();
  job.steps.clear();
  job.fraction = 0;
  job.stop_asked = false;
  make_folder(project_.folder() / "fits" / job.request.name);
  save(job);
  job.thread = std::jthread([this, &job] { run(job); });
  ++version_;
  condition_.notify_all();
}

void Jobs::stop(const std::string& name) {
  const std::lock_guard lock(mutex_);
  Job* job = find(name);
  if (!job) throw Error("'" + name + "'", "is no fit here");
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
  const std::lock_guard lock(mutex_);
  if (const Value* stage = value.find("stage")) job.stage = stage->as_string();
  if (const Value* fraction = value.find("fraction")) job.fraction = fraction->as_number();
  if (const Value* cost = value.find("cost"); cost && job.steps.size() < kMostSteps)
    job.steps.push_back({job.stage, seconds, cost->as_number()});
  ++version_;
  condition_.notify_all();
}

void Jobs::run(Job& job) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begun = Clock::now();
  std::vector<std::string> words = arguments(job.request);
  words.insert(words.end(), {"--progress", "json"});
  ChildEnd end;
  try {
    end = run_self(
        words, project_.folder(), {},
        [&](std::string_view line) {
          take_line(job, line, std::chrono::duration<double>(Clock::now() - begun).count());
        },
        &job.pid);
  } catch (const Error& error) {
    end.err = std::string("error: ") + error.what();
  }

  // How it ended: of itself, by a hand, with the studio, or by a fault.
  const std::lock_guard lock(mutex_);
  const bool has_result = fs::exists(project_.folder() / "fits" / job.request.name / "report.html");
  constexpr int kNotUsable = 3, kFilesUnread = 4;
  if (job.stop_asked || ending_) {
    job.state = "stopped";
  } else if ((end.exit_code == 0 || end.exit_code == kNotUsable || end.exit_code == kFilesUnread) &&
             has_result) {
    job.state = "done";
    job.fraction = 1;
  } else {
    job.state = "failed";
    const std::size_t at = end.err.rfind("error: ");
    job.message = at == std::string::npos ? "it ended with " + std::to_string(end.exit_code)
                                          : end.err.substr(at + 7);
  }
  try {
    save(job);
  } catch (const Error& error) {
    job.message = error.what();
  }
  ++version_;
  condition_.notify_all();
}

Value Jobs::list() const {
  const std::lock_guard lock(mutex_);
  Value list = Value::array();
  for (const Job& job : jobs_) {
    // How far it has come: the error of each model over the time, as it reported it.
    Value steps = Value::array();
    for (const Job::Step& step : job.steps)
      steps.push_back(Value::array({Value(step.what), Value(step.seconds), Value(step.cost)}));

    const fs::path folder = project_.folder() / "fits" / job.request.name;
    const std::vector<std::string> words = arguments(job.request);
    list.push_back(Value::object({{"name", job.request.name},
                                  {"models", Value::array(job.request.models)},
                                  {"state", job.state},
                                  {"stage", job.stage},
                                  {"fraction", job.fraction},
                                  {"message", job.message},
                                  {"steps", std::move(steps)},
                                  {"arguments", Value::array(words)},
                                  {"has_report", fs::exists(folder / "report.html")},
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
