#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace SQLite {
class Database;
}

namespace dashpot {

/// A name for people, and a text that changes with what is named.
using NamedTexts = std::vector<std::pair<std::string, std::string>>;

/// What a file of results is for.
struct ResultKind {
  std::string name;    ///< "search": in messages, and of the table of what the results depend on
  int version = 1;     ///< of its tables
  std::string tables;  ///< SQL that makes them
};

/// An SQLite file of results that are written as they come: what a killed program has finished is
/// there whole, what it had not is not there. One process at a time. Safe from several threads.
class ResultFile {
 public:
  /// Opens the file or makes it. `basis`: all that its results depend on besides their keys. Throws
  /// Error when the file holds results of another basis (naming what differs), is in use, is
  /// something else or is damaged.
  ResultFile(const std::filesystem::path& path, const ResultKind& kind, const NamedTexts& basis);
  ~ResultFile();

  /// Throws away what the file holds, damaged or of another basis. Throws Error when it is in use.
  static void remove(const std::filesystem::path& path, const ResultKind& kind);

  /// One thread at a time; what SQLite complains of becomes an Error that says what to do.
  void with(const std::function<void(SQLite::Database&)>& use) const;

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace dashpot
