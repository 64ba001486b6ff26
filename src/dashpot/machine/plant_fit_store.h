#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/base/store.h"
#include "dashpot/machine/in_plant_report.h"
#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/plant_recording.h"

namespace dashpot {

/// Finished fits inside plants in one file, so that an interrupted identification goes on behind
/// its last model. A fit is found again only for the same program, model, plant, recordings and
/// options; fits in different plants may share the file.
class PlantFitStore {
 public:
  static constexpr StoreFormat kFormat{"plant fit", 1, "remove this file: its fits are made again"};

  /// Opens the file or makes it, as Store does. program: differs from one build of the program to
  /// the next.
  PlantFitStore(const std::filesystem::path& path, std::string program);

  /// Everything that a fit is made from.
  struct Request {
    const std::string& model;
    const std::string& along;  ///< the law along which the model learns; empty: it is a law
    const InPlantSetup& setup;
    const std::vector<PlantRecording>& recordings;
    const InPlantOptions& options;
  };
  /// Nothing where there is no such fit, or where what was kept cannot be read: it is made again.
  std::optional<InPlantReport> load(const Request& request) const;
  /// Throws Error where the disk cannot take it. A fit without a model is not kept.
  void save(const Request& request, const InPlantReport& report);
  std::size_t dropped() const { return store_.dropped(); }  ///< as Store has it

 private:
  std::string key_of(const Request& request) const;

  std::string program_;
  Store store_;
};

}  // namespace dashpot
