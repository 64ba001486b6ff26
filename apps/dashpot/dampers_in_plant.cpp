#include "dampers_in_plant.h"

#include <algorithm>
#include <filesystem>

#include "console.h"
#include "damper_choice.h"
#include "dashpot/base/text.h"
#include "dashpot/machine/found_noise.h"

namespace dashpot::cli {

std::vector<std::string> model_files(const std::string& model,
                                     const std::vector<std::string>& struts) {
  if (model.find('=') == std::string::npos || std::filesystem::exists(model))
    return std::vector<std::string>(struts.size(), model);
  std::vector<std::string> files(struts.size());
  for (const std::string& word : split(model, ',')) {
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals);
    const auto strut = std::ranges::find(struts, name);
    if (equals == std::string::npos || equals + 1 == word.size())
      throw UsageError("MODEL", "'" + word + "' is of no damper", "NAME=FILE of each damper");
    if (strut == struts.end())
      throw UsageError("MODEL", "the plant has no damper '" + name + "'", suggest(name, struts));
    std::string& file = files[static_cast<std::size_t>(strut - struts.begin())];
    if (!file.empty())
      throw UsageError("MODEL", "the damper '" + name + "' has two models", "one of each damper");
    file = word.substr(equals + 1);
  }
  for (std::size_t d = 0; d < struts.size(); ++d)
    if (files[d].empty())
      throw UsageError("MODEL", "the damper '" + struts[d] + "' has no model",
                       model + "," + struts[d] + "=FILE, or one FILE for all dampers");
  return files;
}

ObservedDampers load_dampers(const std::vector<std::string>& files, const std::string& command,
                             InPlantSetup& setup, Console& console) {
  ObservedDampers dampers;
  for (std::size_t d = 0; d < files.size(); ++d) {
    const auto same = std::ranges::find(files, files[d]) - files.begin();
    if (static_cast<std::size_t>(same) < d) {
      dampers.push_back(dampers[static_cast<std::size_t>(same)]);
      continue;
    }
    refuse_published(files[d], command, "a model file that 'dashpot identify --in' wrote");
    ModelFile file = load_damper_file({.model = files[d], .parameters = {}}, command, console);
    require_plant_drive(setup, file, files[d]);
    setup = with_identified_noise(std::move(setup), file, files[d]);
    dampers.push_back({std::move(file.model), file.domain});
  }
  return dampers;
}

}  // namespace dashpot::cli
