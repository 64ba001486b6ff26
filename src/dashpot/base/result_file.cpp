#include "dashpot/base/result_file.h"

#include <map>
#include <mutex>

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr int kApplication =
    0x44505348;                         // "DPSH", so that no other program's file is taken for ours
constexpr std::size_t kShownText = 60;  // longer texts are not printed when they differ

// A write-ahead log takes a result in microseconds and needs no waiting for the disk: a kill loses
// nothing, a power cut the last moments and never the file. At rest the log is gone and the file is
// all there is; the lock is held until then, so that the log needs no index file beside it.
constexpr const char* kLock = "PRAGMA locking_mode = EXCLUSIVE";
constexpr const char* kLog = "PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL;";

/// What SQLite says, as what can be done about it.
Error explained(const std::string& file, const ResultKind& kind, const SQLite::Exception& failure) {
  switch (failure.getErrorCode()) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return {file, "is in use by another " + kind.name,
              "wait until it has ended, or give another --output"};
    case SQLITE_NOTADB:
      return {file, "is no file of " + kind.name + " results", "give another --output"};
    case SQLITE_CORRUPT:
      return {file, "is damaged: " + std::string(failure.what()), "begin anew with --fresh"};
    case SQLITE_FULL:
      return {file, "the disk is full", "make room; what was finished before is kept"};
    case SQLITE_CANTOPEN:
    case SQLITE_READONLY:
      return {file, "cannot be written: " + std::string(failure.what()),
              "give a folder of your own with --output"};
    default:
      return {file, failure.what()};
  }
}

std::string shown(const std::string& text) {
  return text.empty() ? "nothing" : text.size() <= kShownText ? "'" + text + "'" : "";
}

/// "seed: '1' there, '2' here; other data"
std::string differences(const std::map<std::string, std::string>& there, const NamedTexts& here) {
  std::vector<std::string> parts;
  for (const auto& [name, value] : here) {
    const auto found = there.find(name);
    const std::string old = found == there.end() ? std::string() : found->second;
    if (old == value) continue;
    const std::string before = shown(old), now = shown(value);
    parts.push_back(before.empty() || now.empty()
                        ? "other " + name
                        : name + ": " + before + " there, " + now + " here");
  }
  return join(parts, "; ");
}

}  // namespace

struct ResultFile::Connection {
  Connection(const std::filesystem::path& path, ResultKind of, const NamedTexts& basis)
      : file(path.string()),
        kind(std::move(of)),
        database(file, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE) {
    database.exec(kLock);
    SQLite::Transaction transaction(database, SQLite::TransactionBehavior::EXCLUSIVE);
    if (is_empty())
      fill(basis);
    else
      require_same(basis);
    transaction.commit();
    database.exec(kLog);
  }

  int pragma(const std::string& name) { return database.execAndGet("PRAGMA " + name).getInt(); }

  bool is_empty() {
    return database.execAndGet("SELECT count(*) FROM sqlite_schema").getInt() == 0;
  }

  void fill(const NamedTexts& basis) {
    database.exec("CREATE TABLE " + kind.name +
                  " (name TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT");
    database.exec(kind.tables);
    database.exec("PRAGMA application_id = " + std::to_string(kApplication));
    database.exec("PRAGMA user_version = " + std::to_string(kind.version));
    SQLite::Statement insert(database, "INSERT INTO " + kind.name + " VALUES (?, ?)");
    for (const auto& [name, value] : basis) {
      insert.bind(1, name);
      insert.bind(2, value);
      insert.exec();
      insert.reset();
    }
  }

  void require_same(const NamedTexts& basis) {
    if (pragma("application_id") != kApplication)
      throw Error(file, "is a database of another program", "give another --output");
    if (!database.tableExists(kind.name))
      throw Error(file, "holds no results of a " + kind.name, "give another --output");
    if (pragma("user_version") != kind.version)
      throw Error(file, "was written by another version of this program",
                  "begin anew with --fresh");
    std::map<std::string, std::string> there;
    SQLite::Statement select(database, "SELECT name, value FROM " + kind.name);
    while (select.executeStep())
      there[select.getColumn(0).getString()] = select.getColumn(1).getString();
    if (const std::string differs = differences(there, basis); !differs.empty())
      throw Error(file, "holds another " + kind.name + " (" + differs + ")",
                  "give another --output, or --fresh to begin anew");
  }

  std::string file;
  ResultKind kind;
  SQLite::Database database;
  std::mutex guard;
};

ResultFile::ResultFile(const std::filesystem::path& path, const ResultKind& kind,
                       const NamedTexts& basis) {
  try {
    connection_ = std::make_unique<Connection>(path, kind, basis);
  } catch (const SQLite::Exception& failure) {
    throw explained(path.string(), kind, failure);
  }
}

ResultFile::~ResultFile() = default;

void ResultFile::remove(const std::filesystem::path& path, const ResultKind& kind) {
  if (!std::filesystem::exists(path)) return;
  try {
    SQLite::Database database(path.string(), SQLite::OPEN_READWRITE);
    database.exec(kLock);
    database.exec("BEGIN EXCLUSIVE; ROLLBACK");
  } catch (const SQLite::Exception& failure) {
    if (failure.getErrorCode() == SQLITE_BUSY) throw explained(path.string(), kind, failure);
  }
  for (const char* end : {"", "-wal", "-journal"}) std::filesystem::remove(path.string() + end);
}

void ResultFile::with(const std::function<void(SQLite::Database&)>& use) const {
  const std::lock_guard lock(connection_->guard);
  try {
    use(connection_->database);
  } catch (const SQLite::Exception& failure) {
    throw explained(connection_->file, connection_->kind, failure);
  }
}

}  // namespace dashpot
