#include "dashpot/export.h"

#include "dashpot/base/file.h"
#include "handles.h"
#include "status.h"
#include "words.h"

using namespace dashpot;
using namespace dashpot::capi;

namespace {

/// All of them are made before the first is written. Their paths.
Value write_files(const ModelFile& file, const ExportWords& words) {
  const ExportedModel exported = exported_model(file);
  std::vector<ExportedFile> files;
  for (const std::string& format : words.formats)
    add_files(find_exporter(format, "options, to").write(exported, words.options), files);
  Value paths = Value::array();
  for (const ExportedFile& made : files) {
    const std::string path = (std::filesystem::path(words.folder) / made.name).string();
    write_file(path, made.content);
    paths.push_back(path);
  }
  return paths;
}

}  // namespace

dashpot_status dashpot_export(const dashpot_model* model, const char* options, char** report) {
  return guarded([&] {
    if (report) *report = nullptr;
    require(model, "model");
    const Value files = write_files(model->file, read_export_options(options));
    if (report) *report = copy_text(format_json(Value::object({{"files", files}})));
  });
}
