#include "dashpot/identify/search/trial_store.h"

#include <array>
#include <limits>

#include <SQLiteCpp/SQLiteCpp.h>

namespace dashpot {
namespace {

const ResultKind kKind{
    "search", 1,
    "CREATE TABLE fold_result (design TEXT NOT NULL, share REAL NOT NULL, fold INTEGER NOT NULL,"
    " failure TEXT NOT NULL, parameters INTEGER NOT NULL, samples INTEGER NOT NULL, squared REAL,"
    " absolute REAL, largest REAL, force REAL, force_squared REAL, error REAL, force_min REAL,"
    " force_max REAL, worst_esr REAL, diverged INTEGER NOT NULL, seconds REAL,"
    " finished TEXT NOT NULL DEFAULT CURRENT_TIMESTAMP, PRIMARY KEY (design, share, fold)) "
    "STRICT;"};

constexpr const char* kInsert =
    "INSERT INTO fold_result (design, share, fold, failure, parameters, samples, diverged, "
    "squared, absolute,"
    " largest, force, force_squared, error, force_min, force_max, worst_esr, seconds)"
    " VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)";

constexpr const char* kSelect =
    "SELECT failure, parameters, samples, diverged, squared, absolute, largest, force, "
    "force_squared, error,"
    " force_min, force_max, worst_esr, seconds FROM fold_result WHERE design = ? AND share = ? AND "
    "fold = ?";

/// The figures of a result in the order of their columns.
template <class Result>
auto figures_of(Result& r) {
  return std::array{&r.sums.squared,       &r.sums.absolute, &r.sums.largest,   &r.sums.force,
                    &r.sums.force_squared, &r.sums.error,    &r.sums.force_min, &r.sums.force_max,
                    &r.worst_esr,          &r.seconds};
}

std::int64_t whole(std::size_t count) { return static_cast<std::int64_t>(count); }

std::size_t count_in(const SQLite::Column& column) {
  return static_cast<std::size_t>(column.getInt64());
}

}  // namespace

TrialStore::TrialStore(const std::filesystem::path& path, const NamedTexts& search)
    : file_(path, kKind, search) {}

void TrialStore::remove(const std::filesystem::path& path) { ResultFile::remove(path, kKind); }

std::optional<FoldResult> TrialStore::load(const Key& key) const {
  std::optional<FoldResult> result;
  file_.with([&](SQLite::Database& database) {
    SQLite::Statement select(database, kSelect);
    select.bind(1, key.design);
    select.bind(2, key.share);
    select.bind(3, whole(key.fold));
    if (!select.executeStep()) return;
    int column = 0;
    result.emplace().failure = select.getColumn(column++).getString();
    for (std::size_t* count : {&result->parameters, &result->sums.n, &result->diverged})
      *count = count_in(select.getColumn(column++));
    for (double* figure : figures_of(*result)) {
      const SQLite::Column value = select.getColumn(column++);  // SQLite keeps not-a-number as null
      *figure = value.isNull() ? std::numeric_limits<double>::quiet_NaN() : value.getDouble();
    }
  });
  return result;
}

void TrialStore::save(const Key& key, const FoldResult& result) {
  file_.with([&](SQLite::Database& database) {
    SQLite::Statement insert(database, kInsert);
    int column = 1;
    insert.bind(column++, key.design);
    insert.bind(column++, key.share);
    insert.bind(column++, whole(key.fold));
    insert.bind(column++, result.failure);
    for (const std::size_t count : {result.parameters, result.sums.n, result.diverged})
      insert.bind(column++, whole(count));
    for (const double* figure : figures_of(result)) insert.bind(column++, *figure);
    insert.exec();
  });
}

std::size_t TrialStore::size() const {
  std::size_t count = 0;
  file_.with([&](SQLite::Database& database) {
    count = count_in(database.execAndGet("SELECT count(*) FROM fold_result"));
  });
  return count;
}

}  // namespace dashpot
