#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dashpot {

/// A name for people, and a text that changes with what is named.
using NamedTexts = std::vector<std::pair<std::string, std::string>>;

/// The kind of results that a store holds: a constant of the program.
struct StoreFormat {
  std::string_view name;     ///< in messages and in the file: "search", "fit"
  int version = 0;           ///< of the bytes of a result; a file of another version is refused
  std::string_view renewal;  ///< how the user begins anew: "begin anew with --fresh"
  std::string_view option = "--output";  ///< by which the user names the file or its folder
};

/// What a store says of itself.
struct StoreMark {
  std::string format;
  int version = 0;
  NamedTexts basis;  ///< by name
};
/// Throws Error where the file is missing, in use, or no store.
StoreMark store_mark(const std::filesystem::path& path);

/// Finished results of long work in one file, so that an interrupted command goes on where it
/// stopped. A result is some bytes under a key. The key, together with the basis that all results
/// of the file share, says everything that the result depends on: whoever finds it need not make
/// it.
///
/// A result that was saved is there whole after the program is killed, and one that was not saved
/// is not there at all; a power cut can cost the last moments, never the file. One process at a
/// time has the file open; its threads may all use the store at once.
///
/// Each result carries a checksum of its key and bytes. Results that a disk or a hand has changed
/// are found when the file is opened, and dropped: to the caller they are not there, so that they
/// are made again.
///
/// Under mpirun the file is open in rank 0 alone. In a worker a Store is a hand that reaches into
/// that of rank 0 while a farm_out() runs there: load and save do what they do, by a message each,
/// and the others find nothing.
///
/// The file is an SQLite database, at rest a single file: `store` holds the format and its version,
/// `basis` the basis, `result` the keys, bytes and checksums.
class Store {
 public:
  struct Result {
    std::string key;
    std::string bytes;
  };

  /// Opens the file, or makes it in a folder that is there. Throws Error, and leaves the file as it
  /// was found, when it holds results of another format, version or basis (naming what differs),
  /// when it is something else, is damaged, cannot be written or is open in another process.
  Store(const std::filesystem::path& path, const StoreFormat& format, const NamedTexts& basis = {});
  ~Store();

  /// Removes the file, whatever it holds, damaged or of another basis. Throws Error when another
  /// process has it open.
  static void remove(const std::filesystem::path& path);

  /// The bytes under this key; nothing when there are none.
  std::optional<std::string> load(const std::string& key) const;

  /// Keeps a result, in the place of an earlier one with this key. Throws Error when the disk
  /// cannot take it.
  void save(const std::string& key, std::string_view bytes);
  /// Keeps all of these results or, when it throws, none: many times faster than one by one.
  void save(std::span<const Result> results);
  /// The same results as a worker sends them.
  void save_packed(std::string_view packed);

  /// Calls `use` with each key and its bytes, in the order of the keys as bytes; with `end`, only
  /// keys that are less. `use` must not call this store.
  using Use = std::function<void(std::string_view key, std::string_view bytes)>;
  void for_each(const Use& use, const std::optional<std::string>& end = std::nullopt) const;

  std::size_t size() const;     ///< results
  std::size_t dropped() const;  ///< results that were damaged when the file was opened
  /// Loads so far that have found a result, those of workers among them.
  std::size_t found() const;
  /// Format and basis: what all of its results depend on.
  const std::string& identity() const { return identity_; }

 private:
  struct Connection;
  std::string identity_;
  std::unique_ptr<Connection> connection_;  ///< none in a worker
};

}  // namespace dashpot
