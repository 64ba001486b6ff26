#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/export/c/c_block.h"
#include "dashpot/export/exported_model.h"

namespace dashpot {

/// One thing that a model can become.
struct Exporter {
  std::string_view name, title;
  std::string_view takes;  ///< which models, in words
  std::string_view files;  ///< what it writes, in words
  /// Throws Error that says why where the model cannot become that.
  std::vector<ExportedFile> (*write)(const ExportedModel& model, const ExportOptions& options);
  /// Null: inverses and controllers cannot.
  std::vector<ExportedFile> (*write_block)(const CBlockMaker& block,
                                           const ExportOptions& options) = nullptr;
};

/// All of them, in alphabetical order.
std::span<const Exporter> exporters();
/// Throws Error "unknown format 'x'; did you mean ...".
const Exporter& find_exporter(std::string_view name, const std::string& where = {});

}  // namespace dashpot
