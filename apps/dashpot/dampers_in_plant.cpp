#include "dampers_in_plant.h"

#include <algorithm>
#include <filesystem>

#include "console.h"
#include "damper_choice.h"
#include "dashpot/base/text.h"
#include "dashpot/machine/found_noise.h"

namespace dashpot::cli {

std::vector<std::string> of_each_damper(const std::string& text, const InPlantSetup& setup,
                                        const std::string& option, const std::string& value) {
  const std::vector<std::string> struts = observer_names(setup).struts;
  if (text.find('=') == std::string::npos) return std::vector<std::string>(struts.size(), text);

  // Each word goes to the dampers of its name.
  std::vector<std::string> values(struts.size());
  for (const std::string& word : split(text, ',')) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || equals + 1 == word.size())
      throw UsageError(option, "'" + word + "' is of no damper",
                       "NAME=" + value + " of each damper");
    const std::string name = word.substr(0, equals);
    const std::vector<std::size_t> places = dampers_named(setup, name);
    if (places.empty())
      throw UsageError(option, "the plant has no damper '" + name + "'",
                       suggest(name, damper_names(setup)));
    for (const std::size_t d : places) {
      if (!values[d].empty())
        throw UsageError(option, "the damper '" + struts[d] + "' has two models",
                         "one of each damper");
      values[d] = word.substr(equals + 1);
    }
  }

  // None is left.
  for (std::size_t d = 0; d < struts.size(); ++d)
    if (values[d].empty())
      throw UsageError(
          option, "the damper '" + struts[d] + "' has no model",
          text + "," + struts[d] + "=" + value + ", or one " + value + " for all dampers");
  return values;
}

Option model_of_each_option(std::string& target) {
  return {.names = "MODEL",
          .target = &target,
          .help =
              "a model file that 'dashpot identify' wrote; of several dampers one for all, or "
              "one each by the names of their struts: front=a.json,rear=b.json",
          .takes = Takes::File,
          .required = true};
}

std::vector<std::string> model_files(const std::string& model, const InPlantSetup& setup) {
  if (model.find('=') == std::string::npos && setup.kinds.size() > 1)
    throw UsageError(
        "MODEL",
        "is one, and the plant has dampers of " + std::to_string(setup.kinds.size()) + " kinds",
        join(setup.kinds.names, "=FILE,") + "=FILE");
  if (std::filesystem::exists(model)) return std::vector<std::string>(setup.dampers(), model);
  return of_each_damper(model, setup, "MODEL", "FILE");
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
