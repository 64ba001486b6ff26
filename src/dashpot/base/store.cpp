#include "dashpot/base/store.h"

#include <cstdint>
#include <cstring>
#include <map>
#include <mutex>

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include "dashpot/base/file.h"
#include "dashpot/base/ranks.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr int kApplication = 0x44505348;  // "DPSH": tells our files from other programs'
constexpr int kLayout = 3;                // of the tables below
constexpr int kWithoutChecksums = 2;    // the same but for them; 1: a table of its own per command
constexpr std::size_t kShownText = 60;  // longer texts are not printed when they differ

// Keys of a sweep come in ascending order, so that its rows are appended: hence no row numbers.
constexpr const char* kTables =
    "CREATE TABLE store (format TEXT NOT NULL, version INTEGER NOT NULL) STRICT;"
    "CREATE TABLE basis (name TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;"
    "CREATE TABLE result (key TEXT PRIMARY KEY, bytes BLOB NOT NULL, checksum TEXT NOT NULL "
    "DEFAULT "
    "'') STRICT, WITHOUT ROWID;";

// A write-ahead log takes a result in microseconds and needs no waiting for the disk: a kill loses
// nothing, a power cut the last moments and never the file. At rest the log is gone and the file is
// all there is. The lock is held until then, so that the log needs no index file beside it.
constexpr const char* kLock = "PRAGMA locking_mode = EXCLUSIVE";
constexpr const char* kLog = "PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL;";

/// Of a key and its bytes: what changes either is found.
std::string checksum_of(std::string_view key, std::string_view bytes) {
  constexpr std::size_t kDigits = 16;
  return sha256(std::to_string(key.size()) + ' ' + std::string(key) + std::string(bytes))
      .substr(0, kDigits);
}

std::string_view text_in(const SQLite::Column& column) {
  return {static_cast<const char*>(column.getBlob()), static_cast<std::size_t>(column.size())};
}

std::string another(std::string_view option) { return "give another " + std::string(option); }

Error in_use(const std::string& file, std::string_view option) {
  return {file, "is in use by another process", "wait until that has ended, or " + another(option)};
}

/// An SQLite failure as an Error that says what the user can do.
Error explained(const std::string& file, const StoreFormat& format,
                const SQLite::Exception& failure) {
  const std::string name(format.name), renewal(format.renewal);
  switch (failure.getErrorCode()) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return in_use(file, format.option);
    case SQLITE_NOTADB:
      return {file, "is no file of " + name + " results", another(format.option)};
    case SQLITE_CORRUPT:
    case SQLITE_ERROR:  // a table of ours is missing
      return {file, "is damaged: " + std::string(failure.what()), renewal};
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

/// Texts one after the other, each behind its length.
void pack(std::string& packed, std::string_view text) {
  const std::uint64_t size = text.size();
  packed.append(reinterpret_cast<const char*>(&size), sizeof size).append(text);
}

/// The first of them, taken off.
std::string_view unpack(std::string_view& packed) {
  std::uint64_t size = 0;
  std::memcpy(&size, packed.data(), sizeof size);
  const std::string_view text = packed.substr(sizeof size, size);
  packed.remove_prefix(sizeof size + size);
  return text;
}

std::string identity_of(const StoreFormat& format, const NamedTexts& basis) {
  std::string text = std::string(format.name) + ' ' + std::to_string(format.version);
  for (const auto& [name, value] : basis) text.append("\n").append(name).append("=").append(value);
  return text;
}

}  // namespace

struct Store::Connection {
  Connection(const std::filesystem::path& path, const StoreFormat& of, const NamedTexts& basis)
      : file(path.string()),
        format(of),
        database(file, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE) {
    // Look inside under the lock, and write only where the file is empty or ours.
    database.exec(kLock);
    SQLite::Transaction transaction(database, SQLite::TransactionBehavior::EXCLUSIVE);
    if (is_empty()) {
      fill(basis);
    } else {
      require_same_format();
      require_same_basis(basis);
      if (pragma("user_version") == kWithoutChecksums) add_checksums();
      drop_damaged();
    }
    transaction.commit();
    database.exec(kLog);

    select.emplace(database, "SELECT bytes FROM result WHERE key = ?");
    insert.emplace(database, "INSERT OR REPLACE INTO result VALUES (?, ?, ?)");
  }

  /// Runs one thread at a time; a failure of SQLite becomes an Error that says what to do.
  template <class Task>
  auto run(Task task) {
    const std::lock_guard lock(guard);
    try {
      return task();
    } catch (const SQLite::Exception& failure) {
      throw explained(file, format, failure);
    }
  }

  void write(const std::string& key, std::string_view bytes) {
    insert->tryReset();
    insert->bindNoCopy(1, key);
    insert->bindNoCopy(2, bytes.data(), static_cast<int>(bytes.size()));
    insert->bind(3, checksum_of(key, bytes));
    insert->exec();
    insert->reset();
  }

  int pragma(const std::string& name) { return database.execAndGet("PRAGMA " + name).getInt(); }

  bool is_empty() {
    return database.execAndGet("SELECT count(*) FROM sqlite_schema").getInt() == 0;
  }

  void fill(const NamedTexts& basis) {
    database.exec(kTables);
    database.exec("PRAGMA application_id = " + std::to_string(kApplication));
    database.exec("PRAGMA user_version = " + std::to_string(kLayout));

    SQLite::Statement mark(database, "INSERT INTO store VALUES (?, ?)");
    mark.bind(1, std::string(format.name));
    mark.bind(2, format.version);
    mark.exec();

    SQLite::Statement row(database, "INSERT INTO basis VALUES (?, ?)");
    for (const auto& [name, value] : basis) {
      row.bind(1, name);
      row.bind(2, value);
      row.exec();
      row.reset();
    }
  }

  void require_same_format() {
    if (pragma("application_id") != kApplication)
      throw Error(file, "is a database of another program", another(format.option));
    const int layout = pragma("user_version");
    if (layout != kLayout && layout != kWithoutChecksums) refuse_version(layout < kLayout);

    SQLite::Statement mark(database, "SELECT format, version FROM store");
    if (!mark.executeStep())
      throw Error(file, "is damaged: it does not say what it holds", std::string(format.renewal));
    const std::string name = mark.getColumn(0).getString();
    const int version = mark.getColumn(1).getInt();
    if (name != format.name)
      throw Error(file, "holds " + name + " results, no " + std::string(format.name) + " results",
                  another(format.option));
    if (version != format.version) refuse_version(version < format.version);
  }

  [[noreturn]] void refuse_version(bool is_older) const {
    throw Error(file,
                std::string("was written by ") + (is_older ? "an older" : "a newer") +
                    " version of Dashpot, which this one cannot read",
                another_or_anew());
  }

  void require_same_basis(const NamedTexts& basis) {
    std::map<std::string, std::string> there;
    SQLite::Statement row(database, "SELECT name, value FROM basis");
    while (row.executeStep()) there[row.getColumn(0).getString()] = row.getColumn(1).getString();

    if (const std::string differs = differences(there, basis); !differs.empty())
      throw Error(file, "holds another " + std::string(format.name) + " (" + differs + ")",
                  another_or_anew());
  }

  /// The keys of all results whose checksum, or what it says of them, is not `right`.
  template <class Right>
  std::vector<std::string> keys_without(Right right) {
    std::vector<std::string> keys;
    SQLite::Statement row(database, "SELECT key, bytes, checksum FROM result");
    while (row.executeStep()) {
      const std::string_view key = text_in(row.getColumn(0));
      if (!right(key, text_in(row.getColumn(1)), text_in(row.getColumn(2)))) keys.emplace_back(key);
    }
    return keys;
  }

  /// Results of a version that kept none are taken as they are, and guarded from here on.
  void add_checksums() {
    database.exec("ALTER TABLE result ADD COLUMN checksum TEXT NOT NULL DEFAULT ''");
    database.exec("PRAGMA user_version = " + std::to_string(kLayout));
    SQLite::Statement read(database, "SELECT bytes FROM result WHERE key = ?"),
        mark(database, "UPDATE result SET checksum = ? WHERE key = ?");
    for (const std::string& key : keys_without([](auto, auto, auto) { return false; })) {
      read.bindNoCopy(1, key);
      if (read.executeStep()) mark.bind(1, checksum_of(key, text_in(read.getColumn(0))));
      read.reset();
      mark.bindNoCopy(2, key);
      mark.exec();
      mark.reset();
    }
  }

  void drop_damaged() {
    // Again and again: a key that was changed may now be that of two results.
    const auto damaged = [this] {
      return keys_without(
          [](std::string_view key, std::string_view bytes, std::string_view checksum) {
            return checksum == checksum_of(key, bytes);
          });
    };
    SQLite::Statement drop(database, "DELETE FROM result WHERE key = ?");
    for (auto keys = damaged(); !keys.empty(); keys = damaged())
      for (const std::string& key : keys) {
        drop.bindNoCopy(1, key);
        if (drop.exec() == 0)
          throw Error(file, "is damaged: a result cannot be removed", std::string(format.renewal));
        drop.reset();
        ++dropped;
      }
  }

  std::string another_or_anew() const {
    return another(format.option) + ", or " + std::string(format.renewal);
  }

  std::string file;
  StoreFormat format;
  SQLite::Database database;
  std::optional<SQLite::Statement> select, insert;
  std::size_t dropped = 0, found = 0;
  std::mutex guard;
};

StoreMark store_mark(const std::filesystem::path& path) {
  const std::string file = path.string();
  if (!std::filesystem::is_regular_file(path)) throw Error(file, "there is no such file");
  constexpr StoreFormat kAny{"Dashpot's", 0, "leave it out"};
  try {
    SQLite::Database database(file, SQLite::OPEN_READWRITE);
    database.exec(kLock);
    if (database.execAndGet("PRAGMA application_id").getInt() != kApplication)
      throw Error(file, "holds no results of Dashpot",
                  "give files such as fits.sqlite, search.sqlite or sweep.sqlite");

    StoreMark mark;
    SQLite::Statement format(database, "SELECT format, version FROM store");
    if (!format.executeStep())
      throw Error(file, "is damaged: it does not say what it holds", std::string(kAny.renewal));
    mark.format = format.getColumn(0).getString();
    mark.version = format.getColumn(1).getInt();
    SQLite::Statement row(database, "SELECT name, value FROM basis ORDER BY name");
    while (row.executeStep())
      mark.basis.emplace_back(row.getColumn(0).getString(), row.getColumn(1).getString());
    return mark;
  } catch (const SQLite::Exception& failure) {
    throw explained(file, kAny, failure);
  }
}

Store::Store(const std::filesystem::path& path, const StoreFormat& format, const NamedTexts& basis)
    : identity_(identity_of(format, basis)) {
  if (ranks().is_worker()) return;
  try {
    connection_ = std::make_unique<Connection>(path, format, basis);
  } catch (const SQLite::Exception& failure) {
    throw explained(path.string(), format, failure);
  }
}

Store::~Store() = default;

void Store::remove(const std::filesystem::path& path) {
  if (ranks().is_worker() || !std::filesystem::exists(path)) return;

  // Another process that has it open holds the lock. A file that is damaged or no database cannot
  // be locked and goes as well.
  try {
    SQLite::Database database(path.string(), SQLite::OPEN_READWRITE);
    database.exec(kLock);
    database.exec("BEGIN EXCLUSIVE; ROLLBACK");
  } catch (const SQLite::Exception& failure) {
    if (failure.getErrorCode() == SQLITE_BUSY) throw in_use(path.string(), StoreFormat{}.option);
  }

  for (const char* end : {"", "-wal", "-journal"}) std::filesystem::remove(path.string() + end);
}

std::optional<std::string> Store::load(const std::string& key) const {
  if (!connection_) {
    const std::string answer = ranks().ask(kLoad, key);
    return answer.empty() ? std::nullopt : std::optional(answer.substr(1));
  }
  Connection& open = *connection_;
  return open.run([&] {
    open.select->tryReset();
    open.select->bindNoCopy(1, key);
    std::optional<std::string> bytes;
    if (open.select->executeStep()) bytes = open.select->getColumn(0).getString();
    open.select->reset();
    open.found += bytes.has_value();
    return bytes;
  });
}

void Store::save(const std::string& key, std::string_view bytes) {
  if (!connection_) return save(std::array{Result{key, std::string(bytes)}});
  Connection& open = *connection_;
  open.run([&] { open.write(key, bytes); });
}

void Store::save(std::span<const Result> results) {
  if (!connection_) {
    std::string packed;
    for (const auto& [key, bytes] : results) {
      pack(packed, key);
      pack(packed, bytes);
    }
    ranks().tell(kSave, packed);
    return;
  }
  Connection& open = *connection_;
  open.run([&] {
    SQLite::Transaction transaction(open.database);
    for (const auto& [key, bytes] : results) open.write(key, bytes);
    transaction.commit();
  });
}

void Store::save_packed(std::string_view packed) {
  std::vector<Result> results;
  while (!packed.empty()) {
    const std::string_view key = unpack(packed), bytes = unpack(packed);
    results.push_back({std::string(key), std::string(bytes)});
  }
  save(results);
}

void Store::for_each(const Use& use, const std::optional<std::string>& end) const {
  if (!connection_) return;
  Connection& open = *connection_;
  open.run([&] {
    SQLite::Statement select(open.database, std::string("SELECT key, bytes FROM result ") +
                                                (end ? "WHERE key < ? " : "") + "ORDER BY key");
    if (end) select.bindNoCopy(1, *end);
    while (select.executeStep()) {
      const SQLite::Column key = select.getColumn(0), bytes = select.getColumn(1);
      use({key.getText(), static_cast<std::size_t>(key.size())},
          {static_cast<const char*>(bytes.getBlob()), static_cast<std::size_t>(bytes.size())});
    }
  });
}

std::size_t Store::size() const {
  if (!connection_) return 0;
  Connection& open = *connection_;
  return open.run([&] {
    return static_cast<std::size_t>(
        open.database.execAndGet("SELECT count(*) FROM result").getInt64());
  });
}

std::size_t Store::dropped() const { return connection_ ? connection_->dropped : 0; }

std::size_t Store::found() const {
  if (!connection_) return 0;
  Connection& open = *connection_;
  return open.run([&] { return open.found; });
}

}  // namespace dashpot
