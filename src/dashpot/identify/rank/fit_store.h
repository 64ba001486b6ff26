#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "dashpot/drive.h"
#include "dashpot/identify.h"

namespace dashpot {

/// Finished fits in a folder, one file each, so that an interrupted ranking goes on where it
/// stopped. A fit is found again only for the same program, model, records and options.
class FitStore {
 public:
  /// program: what tells one build of the program from the next.
  FitStore(std::filesystem::path folder, std::string program);

  /// What a fit is made from.
  struct Request {
    const std::string& model;
    const std::vector<Record>& training;
    DriveUnit drive_unit;
    const IdentifyOptions& options;
  };
  /// Nothing when there is no such fit, or when its file cannot be read as one.
  std::optional<FitReport> load(const Request& request) const;
  /// Throws Error when the folder cannot take it. A fit without a model is not kept.
  void save(const Request& request, const FitReport& fit) const;

 private:
  /// All that the fit depends on, as text.
  std::string key_of(const Request& request) const;
  std::filesystem::path file_of(const Request& request, const std::string& key) const;

  std::filesystem::path folder_;
  std::string program_;
};

}  // namespace dashpot
