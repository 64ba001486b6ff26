#include "dashpot/base/task_farm.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "dashpot/base/file.h"
#include "dashpot/base/parallel.h"
#include "dashpot/base/ranks.h"
#include "dashpot/base/store.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

using namespace std::chrono_literals;

constexpr const char *kWait = "wait", *kEnd = "end";

/// Rank 0: what workers that have left a farm already say of the next one.
std::vector<Ranks::Message> of_next_farm;

/// What a thread of a worker says where it wants tasks.
struct Ended {
  std::size_t tasks = 0;   ///< those done since it asked last
  std::size_t wanted = 1;  ///< tasks that keep it busy for a while
};

std::string format_ended(const Ended& ended) {
  return std::to_string(ended.tasks) + ' ' + std::to_string(ended.wanted);
}

Ended read_ended(const std::string& text) {
  std::size_t end = 0;
  const std::size_t tasks = std::stoul(text, &end);
  return {tasks, std::stoul(text.substr(end))};
}

int loops_of(int threads) { return threads > 0 ? threads : default_threads(); }

/// What a worker tells of its work, so that rank 0 can refuse another one.
std::string greeting(const Store& store, const std::string& work) {
  return sha256(store.identity() + '\n' + work);
}

/// Rank 0: hands out tasks to itself and the workers, and keeps what they make.
class FarmHost {
 public:
  FarmHost(std::span<const std::size_t> numbers, Store& store, const std::string& work)
      : numbers_(numbers), store_(store), greeting_(greeting(store, work)) {}

  void run(int threads, const std::function<void(std::size_t)>& task) {
    std::jthread server([this] { serve(); });
    const auto loops = static_cast<std::size_t>(loops_of(threads));
    try {
      parallel_for(loops, threads, [&](std::size_t) {
        while (const auto number = claim()) {
          task(*number);
          ++done_;
        }
      });
    } catch (...) {
      stop_ = true;
      throw;
    }
    server.join();
    if (failure_) std::rethrow_exception(failure_);
  }

  /// What workers looked up before they began here: it is no result of an earlier run.
  std::size_t found_before() const { return found_before_; }

 private:
  std::optional<std::size_t> claim() {
    const std::size_t k = next_.fetch_add(1);
    if (k >= numbers_.size()) return std::nullopt;
    return numbers_[k];
  }

  /// The numbers of the next tasks: as many as are wanted, while enough are left for all.
  std::string claim_block(std::size_t wanted) {
    const std::size_t left = numbers_.size() - std::min<std::size_t>(next_, numbers_.size());
    std::string block;
    for (std::size_t k = std::clamp<std::size_t>(left / (4 * ranks().count()), 1, wanted); k; --k)
      if (const auto number = claim()) block += std::to_string(*number) + ' ';
    return block;
  }

  /// Answers the workers until all of them have left. A failure ends the tasks.
  void serve() {
    constexpr auto kLongest = 1ms;
    auto pause = 20us;
    try {
      std::size_t left = 0;
      for (const Ranks::Message& message : std::exchange(of_next_farm, {})) left += take(message);
      while (left + 1 < ranks().count() && !stop_) {
        if (const auto message = ranks().next()) {
          left += take(*message);
          pause = 20us;
          continue;
        }
        std::this_thread::sleep_for(pause);
        if (pause < kLongest) pause *= 2;
      }
    } catch (...) {
      failure_ = std::current_exception();
      next_ = numbers_.size();
    }
  }

  /// Whether a worker leaves with this message. One that has left goes on to the next farm while
  /// slower ones still work here: what it says then is for that one.
  bool take(const Ranks::Message& message) {
    Stage& stage = stages_[message.from];
    if (stage == Stage::Left && message.tag != kFailed) {
      of_next_farm.push_back(message);
      return false;
    }
    if (message.tag == kHello) stage = Stage::Working;
    const bool leaves = answer(message);
    if (leaves) stage = Stage::Left;
    return leaves;
  }

  bool answer(const Ranks::Message& message) {
    const auto& [from, tag, bytes] = message;
    switch (tag) {
      case kHello:
        if (bytes != greeting_)
          throw Error("rank " + std::to_string(from),
                      "has other recordings, options, instructions or another program than rank 0",
                      "let all machines see the same files, install one build, and give --simd "
                      "avx2 where processors differ");
        return false;
      case kNext: {
        const Ended ended = read_ended(bytes);
        done_ += ended.tasks;
        const std::string block = claim_block(ended.wanted);
        // Whoever finds no task waits for the last ones: what they make is needed by all.
        ranks().send(from, kTask, !block.empty() ? block : done_ < numbers_.size() ? kWait : kEnd);
        return false;
      }
      case kSave:
        store_.save_packed(bytes);
        return false;
      case kLoad: {
        const auto found = store_.load(bytes);
        if (found && stages_[from] == Stage::Before) ++found_before_;
        ranks().send(from, kLoaded, found ? '1' + *found : std::string());
        return false;
      }
      case kFailed: {
        const std::size_t end = bytes.find('\n');
        throw Error(bytes.substr(0, end), bytes.substr(end + 1));
      }
      default:
        return tag == kLeft;
    }
  }

  std::span<const std::size_t> numbers_;
  Store& store_;
  const std::string greeting_;
  std::atomic<std::size_t> next_ = 0, done_ = 0;
  enum class Stage { Before, Working, Left };
  std::vector<Stage> stages_ = std::vector<Stage>(ranks().count());
  std::size_t found_before_ = 0;
  std::atomic<bool> stop_ = false;
  std::exception_ptr failure_;
};

/// How many tasks fill the time after which a worker may ask again, after a block that took this
/// long: a message costs a millisecond, which tasks of a few would feel.
std::size_t wanted_after(std::size_t tasks, std::chrono::duration<double> duration) {
  constexpr std::chrono::duration<double> kBlock = 50ms;
  constexpr double kMost = 64;
  return static_cast<std::size_t>(
      std::clamp(static_cast<double>(tasks) * (kBlock / duration), 1.0, kMost));
}

/// A worker: asks rank 0 for one block of tasks after the other.
void work_for_host(int threads, const Store& store, const std::string& work,
                   const std::function<void(std::size_t)>& task) {
  constexpr auto kShortest = 5ms, kLongest = 200ms;
  ranks().tell(kHello, greeting(store, work));
  parallel_for(static_cast<std::size_t>(loops_of(threads)), threads, [&](std::size_t) {
    auto pause = kShortest;
    for (Ended ended;;) {
      const std::string answer = ranks().ask(kNext, format_ended(ended));
      ended.tasks = 0;
      if (answer == kEnd) break;
      if (answer == kWait) {
        std::this_thread::sleep_for(pause);
        pause = std::min(kLongest, 2 * pause);
        continue;
      }

      const auto begin = std::chrono::steady_clock::now();
      std::istringstream block(answer);
      for (std::size_t number = 0; block >> number; ++ended.tasks) task(number);
      ended.wanted = wanted_after(ended.tasks, std::chrono::steady_clock::now() - begin);
    }
  });
  ranks().tell(kLeft, {});
}

}  // namespace

FarmReport farm_out(std::span<const std::size_t> numbers, int threads, Store& store,
                    const std::string& work, const std::function<void(std::size_t)>& task) {
  std::size_t found = store.found();
  const auto begin = std::chrono::steady_clock::now();
  if (ranks().is_alone())
    parallel_for(numbers.size(), threads, [&](std::size_t k) { task(numbers[k]); });
  else if (ranks().is_worker())
    work_for_host(threads, store, work, task);
  else {
    FarmHost host(numbers, store, work);
    host.run(threads, task);
    found += host.found_before();
  }
  return {.found = store.found() - found,
          .wall_seconds =
              std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()};
}

}  // namespace dashpot
