// What a task costs rank 0, beside the task itself: mpirun -n 3 host_rate TASKS BYTES
//
// Workers do nothing but what every task does: they ask for a number, look for its result in the
// store and give one of so many bytes. Prints tasks per second and the CPU time of rank 0 for each,
// which is what limits the number of ranks (bench/ranks_simulation).
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <numeric>
#include <optional>
#include <string>
#include <sys/resource.h>
#include <thread>
#include <vector>

#include "dashpot/base/ranks.h"
#include "dashpot/base/store.h"
#include "dashpot/base/task_farm.h"

namespace {

double process_cpu() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace dashpot;
  namespace fs = std::filesystem;
  const std::size_t tasks = argc > 1 ? std::stoul(argv[1]) : 20000,
                    bytes = argc > 2 ? std::stoul(argv[2]) : 500;
  // The library of MPI lies beside the program of the same build.
  if (ranks_started() > 1)
    join_ranks(fs::read_symlink("/proc/self/exe").parent_path().parent_path().string());

  const fs::path file = fs::temp_directory_path() / "dashpot-host-rate.sqlite";
  Store::remove(file);
  std::optional<Store> store(std::in_place, file, StoreFormat{"host rate", 1, "remove this file"});
  std::vector<std::size_t> numbers(tasks);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  const std::string result(bytes, 'x');

  const double cpu = process_cpu();
  const auto begin = std::chrono::steady_clock::now();
  farm_out(numbers, 1, *store, "", [&](std::size_t number) {
    const std::string key = "task " + std::to_string(number);
    if (!store->load(key)) store->save(key, result);
    // Rank 0 leaves the work to the others, and only serves.
    if (!ranks().is_alone() && !ranks().is_worker())
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  });
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!ranks().is_worker())
    std::printf("%zu ranks, results of %zu bytes: %.0f tasks/s; CPU time of rank 0 %.1f us a task\n",
                ranks().count(), bytes, static_cast<double>(tasks) / wall,
                1e6 * (process_cpu() - cpu) / static_cast<double>(tasks));
  store.reset();
  Store::remove(file);
  leave_ranks();
  return 0;
}
