#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace dashpot {

/// The processes that work on one command under mpirun, "ranks" as MPI calls them; without it, this
/// one alone. Rank 0 hands out tasks and alone writes results; the others, the workers, run the
/// same command up to its tasks, do those they are given, and leave.
///
/// Calls come from one thread at a time, but for those of a worker to rank 0 (ask, tell), which
/// take turns by themselves.
class Ranks {
 public:
  std::size_t number() const { return number_; }  ///< of this process, from 0 on
  std::size_t count() const { return count_; }
  bool is_alone() const { return count_ == 1; }
  bool is_worker() const { return number_ > 0; }

  struct Message {
    std::size_t from = 0;
    int tag = 0;
    std::string bytes;
  };
  /// Rank 0: the next message, where there is one.
  std::optional<Message> next();
  void send(std::size_t to, int tag, std::string_view bytes);

  /// A worker gives rank 0 bytes; and waits for its answer.
  void tell(int tag, std::string_view bytes);
  std::string ask(int tag, std::string_view bytes);

 private:
  friend void join_ranks(const std::string& program_folder);
  std::size_t number_ = 0, count_ = 1;
};

Ranks& ranks();

/// How many processes mpirun or srun has started with this one, by what they tell it; 1 without.
std::size_t ranks_started();

/// Enters the job of mpirun, through dashpot-mpi.so in the program's folder or in lib/dashpot
/// beside it. Throws Error where that is missing or cannot be used. From here on default_threads()
/// is this process's share of the machine's cores, where mpirun has not bound it to some.
void join_ranks(const std::string& program_folder);

/// Leaves the job in order, when all others do.
void leave_ranks();
/// Ends all of the job, unless this process has left it or is alone.
void end_ranks(int code);

/// A worker that cannot go on says why to rank 0, which prints it and ends the job.
[[noreturn]] void fail_rank(const std::string& why);

/// Tags of messages to and from rank 0.
enum RankTag : int {
  kHello = 1,  ///< a worker begins a piece of work: a hash of what that is
  kNext,       ///< wants tasks: how many it has ended since it asked last, and how many it wants
  kTask,       ///< the answer: numbers, "wait" or "end"
  kSave,       ///< results for the store, kept before what this rank says next is answered
  kLoad,       ///< a key of the store
  kLoaded,     ///< the answer: "1" and the bytes, or nothing
  kLeft,       ///< a worker has no more to do in this piece of work
  kFailed,     ///< why a worker cannot go on
  kFarewell    ///< to a worker: the command is done
};

}  // namespace dashpot
