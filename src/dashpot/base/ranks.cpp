#include "dashpot/base/ranks.h"

#include <chrono>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <mutex>
#include <thread>
#include <unistd.h>
#include <utility>

#include "dashpot/base/parallel.h"
#include "dashpot/base/ranks_plugin.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr const char* kLibrary = "dashpot-mpi.so";

const dashpot_mpi_functions* mpi = nullptr;
std::mutex turn;  // of a worker's threads

std::size_t number_in(const char* variable) {
  const char* text = std::getenv(variable);
  const auto number = text ? parse_number(text) : std::nullopt;
  return number && *number >= 1 ? static_cast<std::size_t>(*number) : 0;
}

std::optional<Ranks::Message> next_message() {
  int from = 0, tag = 0, size = 0;
  if (!mpi->arrived(&from, &tag, &size)) return std::nullopt;
  Ranks::Message message{static_cast<std::size_t>(from), tag,
                         std::string(static_cast<std::size_t>(size), '\0')};
  mpi->receive(from, tag, message.bytes.data(), size);
  return message;
}

/// Waits for a message without keeping a core busy: an answer comes at once, or after a task.
Ranks::Message awaited() {
  constexpr auto kLongest = 2ms;
  auto pause = 10us;
  for (;;) {
    if (auto message = next_message()) return *std::move(message);
    std::this_thread::sleep_for(pause);
    if (pause < kLongest) pause *= 2;
  }
}

}  // namespace

Ranks& ranks() {
  static Ranks all;
  return all;
}

std::optional<Ranks::Message> Ranks::next() { return next_message(); }

void Ranks::send(std::size_t to, int tag, std::string_view bytes) {
  mpi->send(static_cast<int>(to), tag, bytes.data(), static_cast<int>(bytes.size()));
}

void Ranks::tell(int tag, std::string_view bytes) {
  const std::lock_guard lock(turn);
  send(0, tag, bytes);
}

std::string Ranks::ask(int tag, std::string_view bytes) {
  const std::lock_guard lock(turn);
  send(0, tag, bytes);
  return awaited().bytes;
}

std::size_t ranks_started() {
  // Open MPI's mpirun says how many; Slurm's srun with --mpi=pmix says that there is a job.
  if (const std::size_t count = number_in("OMPI_COMM_WORLD_SIZE")) return count;
  if (std::getenv("PMIX_RANK"))
    if (const std::size_t count = number_in("SLURM_NTASKS")) return count;
  return 1;
}

void join_ranks(const std::string& program_folder) {
  // The library lies beside the program in the build, in lib/dashpot where it is installed.
  const fs::path folder = program_folder;
  fs::path library = folder / kLibrary;
  if (!fs::exists(library)) library = folder / "../lib/dashpot" / kLibrary;
  if (!fs::exists(library))
    throw Error("mpirun", "this Dashpot was built without Open MPI",
                "install libopenmpi-dev and build it again, or share the work with --part");

  // Its symbols are seen by all, which Open MPI's own plugins need.
  void* const loaded = dlopen(library.c_str(), RTLD_NOW | RTLD_GLOBAL);
  void* const entry = loaded ? dlsym(loaded, DASHPOT_MPI_ENTRY) : nullptr;
  if (!entry)
    throw Error(library.string(), "cannot be used: " + std::string(dlerror()),
                "install openmpi-bin, or share the work with --part");
  mpi = reinterpret_cast<dashpot_mpi_entry>(entry)();

  int number = 0, count = 1, here = 1;
  if (mpi->join(&number, &count, &here) != 0)
    throw Error("mpirun", "this MPI does not allow threads", "share the work with --part");
  ranks().number_ = static_cast<std::size_t>(number);
  ranks().count_ = static_cast<std::size_t>(count);
  share_cores(static_cast<std::size_t>(here));
}

void leave_ranks() {
  if (!mpi) return;

  // Workers sleep until rank 0 has done the rest: MPI would have them wait at full speed.
  if (ranks().is_worker()) {
    while (awaited().tag != kFarewell) continue;
  } else {
    for (std::size_t k = 1; k < ranks().count(); ++k) ranks().send(k, kFarewell, {});
  }
  std::exchange(mpi, nullptr)->leave();
}

void end_ranks(int code) {
  if (mpi) mpi->end(code);
}

void fail_rank(const std::string& why) {
  char machine[256] = "?";
  gethostname(machine, sizeof machine - 1);
  ranks().tell(kFailed, "rank " + std::to_string(ranks().number()) + " on " + machine + '\n' + why);
  for (;;) std::this_thread::sleep_for(1s);  // rank 0 ends the job
}

}  // namespace dashpot
