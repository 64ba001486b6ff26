#include "dashpot/identify/trial_store.h"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include "dashpot/base/error.h"
#include "dashpot/base/text.h"

namespace dashpot {
namespace {

constexpr int kApplication = 0x44505348;  // "DPSH", so that no other program's file is taken for ours
constexpr int kVersion = 1;               // of the tables
constexpr std::size_t kShownText = 60;    // longer texts are not printed when they differ

// A write-ahead log takes a result in microseconds and needs no waiting for the disk: a kill loses nothing, a
// power cut the last moments and never the file. At rest the log is gone and the file is all there is; the
// lock is held until then, so that the log needs no index file beside it.
constexpr const char* kLock = "PRAGMA locking_mode = EXCLUSIVE";
constexpr const char* kLog = "PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL;";

constexpr const char* kTables =
    "CREATE TABLE search (name TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;"
    "CREATE TABLE fold_result (design TEXT NOT NULL, share REAL NOT NULL, fold INTEGER NOT NULL,"
    " failure TEXT NOT NULL, parameters INTEGER NOT NULL, samples INTEGER NOT NULL, squared REAL,"
    " absolute REAL, largest REAL, force REAL, force_squared REAL, error REAL, force_min REAL,"
    " force_max REAL, worst_esr REAL, diverged INTEGER NOT NULL, seconds REAL,"
    " finished TEXT NOT NULL DEFAULT CURRENT_TIMESTAMP, PRIMARY KEY (design, share, fold)) STRICT;";

constexpr const char* kInsert =
    "INSERT INTO fold_result (design, share, fold, failure, parameters, samples, diverged, squared, absolute,"
    " largest, force, force_squared, error, force_min, force_max, worst_esr, seconds)"
    " VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)";

constexpr const char* kSelect =
    "SELECT failure, parameters, samples, diverged, squared, absolute, largest, force, force_squared, error,"
    " force_min, force_max, worst_esr, seconds FROM fold_result WHERE design = ? AND share = ? AND fold = ?";

/// The figures of a result in the order of their columns.
template <class Result>
auto figures_of(Result& r) {
  return std::array{&r.sums.squared,       &r.sums.absolute, &r.sums.largest,   &r.sums.force,
                    &r.sums.force_squared, &r.sums.error,    &r.sums.force_min, &r.sums.force_max,
                    &r.worst_esr,          &r.seconds};
}

std::int64_t whole(std::size_t count) { return static_cast<std::int64_t>(count); }

std::size_t count_in(const SQLite::Column& column) { return static_cast<std::size_t>(column.getInt64()); }

/// What SQLite says, as what can be done about it.
Error explained(const std::string& file, const SQLite::Exception& failure) {
  switch (failure.getErrorCode()) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return {file, "is in use by another search", "wait until it has ended, or give another --output"};
    case SQLITE_NOTADB:
      return {file, "is no file of search results", "give another --output"};
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
    parts.push_back(before.empty() || now.empty() ? "other " + name
                                                  : name + ": " + before + " there, " + now + " here");
  }
  return join(parts, "; ");
}

}  // namespace

struct TrialStore::Connection {
  Connection(const std::filesystem::path& path, const NamedTexts& search)
      : file(path.string()), database(file, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE) {
    database.exec(kLock);
    SQLite::Transaction transaction(database, SQLite::TransactionBehavior::EXCLUSIVE);
    if (is_empty())
      fill(search);
    else
      require_same(search);
    transaction.commit();
    database.exec(kLog);
  }

  int pragma(const std::string& name) { return database.execAndGet("PRAGMA " + name).getInt(); }

  bool is_empty() { return database.execAndGet("SELECT count(*) FROM sqlite_schema").getInt() == 0; }

  void fill(const NamedTexts& search) {
    database.exec(kTables);
    database.exec("PRAGMA application_id = " + std::to_string(kApplication));
    database.exec("PRAGMA user_version = " + std::to_string(kVersion));
    SQLite::Statement insert(database, "INSERT INTO search VALUES (?, ?)");
    for (const auto& [name, value] : search) {
      insert.bind(1, name);
      insert.bind(2, value);
      insert.exec();
      insert.reset();
    }
  }

  void require_same(const NamedTexts& search) {
    if (pragma("application_id") != kApplication)
      throw Error(file, "is a database of another program", "give another --output");
    if (pragma("user_version") != kVersion)
      throw Error(file, "was written by another version of this program", "begin anew with --fresh");
    std::map<std::string, std::string> there;
    SQLite::Statement select(database, "SELECT name, value FROM search");
    while (select.executeStep()) there[select.getColumn(0).getString()] = select.getColumn(1).getString();
    if (const std::string differs = differences(there, search); !differs.empty())
      throw Error(file, "holds another search (" + differs + ")",
                  "give another --output, or --fresh to begin anew");
  }

  std::string file;
  SQLite::Database database;
  std::mutex guard;
};

TrialStore::TrialStore(const std::filesystem::path& path, const NamedTexts& search) {
  try {
    connection_ = std::make_unique<Connection>(path, search);
  } catch (const SQLite::Exception& failure) {
    throw explained(path.string(), failure);
  }
}

TrialStore::~TrialStore() = default;

void TrialStore::remove(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return;
  try {
    SQLite::Database database(path.string(), SQLite::OPEN_READWRITE);
    database.exec(kLock);
    database.exec("BEGIN EXCLUSIVE; ROLLBACK");
  } catch (const SQLite::Exception& failure) {
    if (failure.getErrorCode() == SQLITE_BUSY) throw explained(path.string(), failure);
  }
  for (const char* end : {"", "-wal", "-journal"}) std::filesystem::remove(path.string() + end);
}

std::optional<FoldResult> TrialStore::load(const Key& key) const {
  const std::lock_guard lock(connection_->guard);
  try {
    SQLite::Statement select(connection_->database, kSelect);
    select.bind(1, key.design);
    select.bind(2, key.share);
    select.bind(3, whole(key.fold));
    if (!select.executeStep()) return std::nullopt;
    FoldResult result;
    int column = 0;
    result.failure = select.getColumn(column++).getString();
    for (std::size_t* count : {&result.parameters, &result.sums.n, &result.diverged})
      *count = count_in(select.getColumn(column++));
    for (double* figure : figures_of(result)) {
      const SQLite::Column value = select.getColumn(column++);  // SQLite keeps not-a-number as null
      *figure = value.isNull() ? std::numeric_limits<double>::quiet_NaN() : value.getDouble();
    }
    return result;
  } catch (const SQLite::Exception& failure) {
    throw explained(connection_->file, failure);
  }
}

void TrialStore::save(const Key& key, const FoldResult& result) {
  const std::lock_guard lock(connection_->guard);
  try {
    SQLite::Statement insert(connection_->database, kInsert);
    int column = 1;
    insert.bind(column++, key.design);
    insert.bind(column++, key.share);
    insert.bind(column++, whole(key.fold));
    insert.bind(column++, result.failure);
    for (const std::size_t count : {result.parameters, result.sums.n, result.diverged})
      insert.bind(column++, whole(count));
    for (const double* figure : figures_of(result)) insert.bind(column++, *figure);
    insert.exec();
  } catch (const SQLite::Exception& failure) {
    throw explained(connection_->file, failure);
  }
}

std::size_t TrialStore::size() const {
  const std::lock_guard lock(connection_->guard);
  return count_in(connection_->database.execAndGet("SELECT count(*) FROM fold_result"));
}

}  // namespace dashpot
