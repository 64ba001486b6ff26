#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "dashpot/base/store.h"
#include "dashpot/drive.h"
#include "dashpot/identify.h"

namespace dashpot {

/// Finished fits in one file, so that an interrupted ranking or study goes on where it stopped. A
/// fit is found again only for the same program, model, records and options; fits of different data
/// may share the file. Safe from several threads.
class FitStore {
 public:
  static constexpr StoreFormat kFormat{"fit", 2, "remove this file: its fits are made again"};

  /// Opens the file or makes it, as Store does. program: differs from one build of the program to
  /// the next.
  FitStore(const std::filesystem::path& path, std::string program);

  /// Everything that a fit is made from.
  struct Request {
    const std::string& model;
    const std::vector<Record>& training;
    DriveUnit drive_unit;
    const IdentifyOptions& options;
  };
  /// Nothing when there is no such fit, or when what was kept cannot be read: it is made again.
  std::optional<FitReport> load(const Request& request) const;
  /// Throws Error when the disk cannot take it. A fit without a model is not kept.
  void save(const Request& request, const FitReport& fit);
  std::size_t dropped() const { return store_.dropped(); }  ///< as Store has it
  Store& store() { return store_; }                         ///< for farm_out()
  const std::string& program() const { return program_; }

 private:
  std::string key_of(const Request& request) const;

  std::string program_;
  Store store_;
};

}  // namespace dashpot
